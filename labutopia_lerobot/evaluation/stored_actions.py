"""Actions of an episode in JSON, and the policy that plays them again.

Bytes of the same significance stand together before they are compressed: those of neighbouring
actions are alike.
"""

import base64
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv, Observation
from labutopia_lerobot.evaluation.policies import Action, PolicyUnreachable

_FLOAT = np.dtype("<f4")
_LARGEST = 100_000_000
"""More bytes than the actions of any episode take."""


def encode(actions: NDArray[np.float32]) -> dict[str, Any]:
    """Return actions, shape (steps, elements), as JSON."""
    planes = np.ascontiguousarray(actions, _FLOAT).reshape(-1).view(np.uint8)
    content = zlib.compress(planes.reshape(-1, _FLOAT.itemsize).T.tobytes(), 9)
    return {"shape": list(actions.shape), "zlib": base64.b64encode(content).decode()}


def decode(stored: Mapping[str, Any]) -> NDArray[np.float32]:
    """Return the actions that `encode` wrote, shape (steps, elements), to the bit.

    Raises:
        ValueError: If it is nothing that `encode` writes.
    """
    try:
        inflating = zlib.decompressobj()
        content = inflating.decompress(base64.b64decode(stored["zlib"]), _LARGEST)
        planes = np.frombuffer(content, np.uint8).reshape(_FLOAT.itemsize, -1).T
        steps, elements = stored["shape"]
        return planes.copy().view(_FLOAT).reshape(steps, elements)
    except (KeyError, TypeError, zlib.error) as error:
        raise ValueError(f"no stored actions: {error}") from None


@dataclass(frozen=True)
class StoredActions:
    """Makes a policy that plays actions again, whatever it observes.

    Attributes:
        content: The actions, as float32 one after the other.
        elements: Numbers of an action.
    """

    content: bytes
    elements: int

    def __call__(self) -> "StoredPolicy":
        """Make the policy."""
        actions = np.frombuffer(self.content, _FLOAT).reshape(-1, self.elements)
        return StoredPolicy(actions)


class StoredPolicy:
    """Plays actions again, and is not there any more when they are all played.

    Args:
        actions: Shape (steps, elements).
    """

    def __init__(self, actions: NDArray[np.float32]) -> None:
        self._actions = actions

    def start(self, env: LabEnv, seed: int) -> None:
        """Begin with the first action."""
        self._left = iter(self._actions)

    def act(self, observation: Observation) -> Action:
        """Return the next action.

        Raises:
            PolicyUnreachable: If there is none left.
        """
        action: Action | None = next(self._left, None)
        if action is None:
            raise PolicyUnreachable("all stored actions are played")
        return action.copy()
