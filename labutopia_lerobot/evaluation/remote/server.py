"""What a server of a policy is to whoever asks it, and what can go wrong."""

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Observation
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import observation_features
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting


class PolicyServerError(UserError):
    """A server that cannot be used, or whose policy raised; the message has its own words."""


class Server(Protocol):
    """Answers observations with actions. It may connect when it is first asked."""

    def ask(
        self, observation: Mapping[str, NDArray[Any]], instruction: str, timeout_s: float
    ) -> NDArray[np.float32]:
        """Return the next actions, shape (actions, elements).

        Args:
            observation: What the policy calls it -> the array.
            instruction: What to do, in words.
            timeout_s: For how long to wait [s].

        Raises:
            ConnectionError: If the server is not there, or went away.
            TimeoutError: If it does not answer in time.
            PolicyServerError: If it answers that something is wrong.
        """
        ...


def named(
    setting: Setting, names: Mapping[str, str], observation: Observation
) -> dict[str, NDArray[Any]]:
    """Return what is observed under the names that a policy uses.

    Args:
        setting: What is observed.
        names: Our key, as in datasets -> what the policy calls it; others keep their key.
        observation: From the environment.
    """
    features = observation_features(setting, lambda: canonical_task(setting))
    return {
        names.get(feature.key, feature.key): _at(observation, path)
        for path, feature in features.items()
    }


def _at(observation: Observation, path: str) -> NDArray[Any]:
    found: Any = observation
    for part in path.split("/"):
        found = found[part]
    array: NDArray[Any] = found
    return array
