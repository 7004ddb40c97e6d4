"""Actions as LeRobot's policy server pickles them, read without running what else a pickle says.

LeRobot unpickles whatever comes. Here only the names that a list of `TimedAction` consists of are
looked up, and the numbers of tensors are read by torch's own restricted loader.
"""

import io
import pickle
from collections import OrderedDict
from typing import Any

import numpy as np
import torch
from lerobot.async_inference.helpers import TimedAction
from numpy.typing import NDArray

from labutopia_lerobot.evaluation.remote.server import PolicyServerError


def _load_storage(content: bytes) -> Any:
    return torch.load(io.BytesIO(content), map_location="cpu", weights_only=True)


_KNOWN = {
    (TimedAction.__module__, TimedAction.__name__): TimedAction,
    ("torch._utils", "_rebuild_tensor_v2"): torch._utils._rebuild_tensor_v2,
    ("torch.storage", "_load_from_bytes"): _load_storage,
    ("collections", "OrderedDict"): OrderedDict,
}


class _ActionUnpickler(pickle.Unpickler):
    def find_class(self, module_name: str, global_name: str) -> Any:
        try:
            return _KNOWN[module_name, global_name]
        except KeyError:
            raise PolicyServerError(
                f"The server's answer is refused: it names {module_name}.{global_name}, which is "
                "no part of a list of actions and could run any code"
            ) from None


def read_actions(content: bytes) -> NDArray[np.float32]:
    """Return pickled actions, shape (actions, elements).

    Raises:
        PolicyServerError: If it is no list of `TimedAction`, or names anything else.
    """
    try:
        answer = _ActionUnpickler(io.BytesIO(content)).load()
        rows = [np.asarray(timed.action, np.float32) for timed in answer]
        return np.stack(rows)
    except (pickle.UnpicklingError, AttributeError, EOFError, RuntimeError, TypeError, ValueError):
        raise PolicyServerError("The server's answer is no list of actions") from None
