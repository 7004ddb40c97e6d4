"""Successes per task in Weights & Biases, where LeRobot logs to it.

LeRobot logs the mean over all tasks that it evaluates along a training (`lerobot_train`, and
`WandBLogger.log_dict`, which leaves nested results aside). Where a run is open in this process, the
environments add their own line: `eval/<task>/pc_success` and `eval/<task>/episodes`.
"""

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, Observation
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.vector import Actions, Flags, LabVectorEnv


class LoggedVectorEnv(LabVectorEnv):
    """Environments that log, when they are closed, how often their task was done.

    Args:
        setting: As of `LabVectorEnv`.
        num_envs: As of `LabVectorEnv`.
        asynchronous: As of `LabVectorEnv`.
    """

    def __init__(self, setting: Setting, num_envs: int, asynchronous: bool = True) -> None:
        super().__init__(setting, num_envs, asynchronous)
        self._task = setting.task
        self._episodes = self._successes = 0

    def step(self, actions: Actions) -> tuple[Observation, NDArray[Any], Flags, Flags, Info]:
        """Step, and count the episodes that end with it."""
        over = self._terminated | self._truncated
        observation, reward, terminated, truncated, info = super().step(actions)
        ended = (terminated | truncated) & ~over
        self._episodes += int(np.sum(ended))
        self._successes += int(np.sum(ended & np.asarray(info["is_success"], dtype=bool)))
        return observation, reward, terminated, truncated, info

    def close(self, **kwargs: Any) -> None:
        """End the workers, and log what they have played since the last time."""
        super().close(**kwargs)
        log = _log_of_open_run()
        if log is not None and self._episodes:
            counted = {
                "pc_success": 100.0 * self._successes / self._episodes,
                "episodes": self._episodes,
            }
            # LeRobot's own line of this evaluation follows, and commits both.
            log({f"eval/{self._task}/{name}": n for name, n in counted.items()}, commit=False)
        self._episodes = self._successes = 0


def _log_of_open_run() -> Callable[..., None] | None:
    """Return `log` of the run of Weights & Biases in this process; None if there is none."""
    wandb = sys.modules.get("wandb")  # imported where somebody logs
    run = getattr(wandb, "run", None)
    log: Callable[..., None] | None = getattr(run, "log", None)
    return log
