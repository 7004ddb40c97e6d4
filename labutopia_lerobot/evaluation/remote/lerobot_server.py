"""LeRobot's policy server (`python -m lerobot.async_inference.policy_server`), over gRPC.

It loads the checkpoint that a client names, keeps one observation for all clients, and
answers an observation with a chunk of actions; nothing where its policy raised. Its answers are
pickles, and LeRobot unpickles whatever comes. Here only the names of which a list of `TimedAction`
consists are looked up, and the numbers of tensors are read by the restricted loader of torch.
"""

import io
import math
import pickle
import time
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import grpc
import numpy as np
import torch
from lerobot.async_inference.helpers import RemotePolicyConfig, TimedAction, TimedObservation
from lerobot.transport import services_pb2, services_pb2_grpc
from lerobot.transport.utils import grpc_channel_options, send_bytes_in_chunks
from numpy.typing import NDArray

from labutopia_lerobot.evaluation.policies import PolicyServerError
from labutopia_lerobot.foreign_files import printable


def _load_storage(content: bytes) -> Any:
    return torch.load(io.BytesIO(content), map_location="cpu", weights_only=True)


def _rebuild_tensor(storage: Any, offset: int, size: Any, stride: Any, *others: Any) -> Any:
    """Rebuild a tensor as torch does, if its storage has all of its elements."""
    spans = (max(count - 1, 0) * step for count, step in zip(size, stride, strict=True))
    last, stored = offset + sum(spans), storage._untyped_storage.nbytes() // storage.dtype.itemsize
    if min(offset, *size, *stride) < 0 or last >= stored or math.prod(size) > _MOST_NUMBERS:
        raise ValueError(f"a tensor of {tuple(size)} in {stored} numbers")
    rebuild: Any = torch._utils._rebuild_tensor_v2
    return rebuild(storage, offset, size, stride, *others)


_MOST_NUMBERS = 1_000_000
"""Most numbers in a tensor of actions: 10,000 of them have at most 100 elements."""

_UNREADABLE = (
    pickle.UnpicklingError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    OverflowError,
    RuntimeError,
    TypeError,
    ValueError,
)
"""Exceptions that damaged or hostile pickles raise."""

_KNOWN = {
    (TimedAction.__module__, TimedAction.__name__): TimedAction,
    ("torch._utils", "_rebuild_tensor_v2"): _rebuild_tensor,
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
    except _UNREADABLE:
        raise PolicyServerError("The server's answer is no list of actions") from None


_IMAGES = "observation.images."
_MOST_ACTIONS = 10_000
"""More than any policy answers with: the server cuts its chunks there."""


@dataclass(frozen=True)
class ServedCheckpoint:
    """The policy that LeRobot's server is to load.

    Attributes:
        path: Where the server finds it: a folder of its machine, or a Hub id.
        type: LeRobot's name of the policy.
        device: Device of torch on the server.
    """

    path: str
    type: str
    device: str


class LeRobotServer:
    """A client of the server.

    Args:
        address: Host and port.
        checkpoint: What it is to play.
    """

    def __init__(self, address: str, checkpoint: ServedCheckpoint) -> None:
        self._address, self._checkpoint = address, checkpoint
        self._channel: Any = None
        self._asked = 0

    def ask(
        self, observation: Mapping[str, NDArray[Any]], instruction: str, timeout_s: float
    ) -> NDArray[np.float32]:
        """Return the next actions; see `Server`."""
        deadline = time.monotonic() + timeout_s
        try:
            stub = self._connected(observation, deadline)
            self._asked += 1
            sent = TimedObservation(
                timestamp=time.time(),
                timestep=self._asked,
                observation=_raw(observation, instruction),
                must_go=True,
            )
            message = send_bytes_in_chunks(pickle.dumps(sent), services_pb2.Observation)
            stub.SendObservations(message, timeout=_left(deadline))
            answer = stub.GetActions(services_pb2.Empty(), timeout=_left(deadline))
        except grpc.RpcError as error:
            self._close()
            raise _meaning(error, self._address) from None
        if not answer.data:
            raise PolicyServerError(
                f"The policy raised in the server at {self._address}, which says why in its log"
            )
        return read_actions(answer.data)

    def _connected(self, observation: Mapping[str, NDArray[Any]], deadline: float) -> Any:
        """Return the server's methods; a server that was restarted is sent the checkpoint again."""
        if self._channel is not None:
            return services_pb2_grpc.AsyncInferenceStub(self._channel)
        options = grpc_channel_options(enable_retries=False)
        self._channel = grpc.insecure_channel(self._address, options)
        stub = services_pb2_grpc.AsyncInferenceStub(self._channel)
        stub.Ready(services_pb2.Empty(), timeout=_left(deadline))
        instructions = RemotePolicyConfig(
            policy_type=self._checkpoint.type,
            pretrained_name_or_path=self._checkpoint.path,
            lerobot_features={key: _feature(key, array) for key, array in observation.items()},
            actions_per_chunk=_MOST_ACTIONS,
            device=self._checkpoint.device,
        )
        setup = services_pb2.PolicySetup(data=pickle.dumps(instructions))
        stub.SendPolicyInstructions(setup, timeout=_left(deadline))
        return stub

    def _close(self) -> None:
        if self._channel is not None:
            self._channel.close()
        self._channel = None


def _left(deadline: float) -> float:
    return max(deadline - time.monotonic(), 0.01)


def _feature(key: str, array: NDArray[Any]) -> dict[str, Any]:
    """Declare an array as LeRobot's datasets do."""
    if key.startswith(_IMAGES):
        return {"dtype": "image", "shape": array.shape, "names": ["height", "width", "channels"]}
    return {"dtype": "float32", "shape": array.shape, "names": _names(key, array)}


def _names(key: str, array: NDArray[Any]) -> list[str]:
    return [f"{key}.{index}" for index in range(array.size)]


def _raw(observation: Mapping[str, NDArray[Any]], instruction: str) -> dict[str, Any]:
    """Return an observation as a robot of LeRobot gives it: numbers one by one, pictures whole."""
    raw: dict[str, Any] = {"task": instruction}
    for key, array in observation.items():
        if key.startswith(_IMAGES):
            raw[key.removeprefix(_IMAGES)] = array
        else:
            raw |= dict(zip(_names(key, array), array.tolist(), strict=True))
    return raw


def _meaning(error: grpc.RpcError, address: str) -> Exception:
    code, details = error.code(), error.details()
    if code == grpc.StatusCode.DEADLINE_EXCEEDED:
        return TimeoutError(f"{address} does not answer")
    if code in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.CANCELLED):
        return ConnectionError(f"{address} cannot be reached: {printable(str(details))}")
    return PolicyServerError(f"The server at {address} refuses: {printable(str(details))}")
