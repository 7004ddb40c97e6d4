"""The columns of an episode, collected frame by frame; recording and replaying share them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import (
    COMMAND,
    DONE,
    PHASE,
    REWARD,
    STATE,
    STEP,
    SUBSTEP,
    SUCCEEDED,
    privileged_state,
)
from labutopia_lerobot.env import Info, LabEnv, Observation
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.setting import NUMBERS

Columns = dict[str, NDArray[Any]]
"""Feature key -> values, shape (frames, elements), or (frames,) where there is one element."""


class Frames:
    """The columns of each frame of a dataset, without its pictures.

    Row k holds the observation before action k, the action that acted, and what came of it.

    Args:
        env: Where the episode is played.
        obs: The kind of observation that the dataset has.
    """

    def __init__(self, env: LabEnv, obs: str) -> None:
        self._env, self._obs = env, obs
        self._rows: list[dict[str, Any]] = []

    def __len__(self) -> int:
        return len(self._rows)

    def begin(self, observation: Observation, phase: str = "") -> None:
        """Note a frame before its action.

        Args:
            observation: What the environment shows.
            phase: What the expert is about.
        """
        progress = self._env.workcell.progress
        latched = [name for name, time in progress.substeps.items() if time is not None]
        key, state = privileged_state(self._env.environment_state(), self._obs)
        self._rows.append(
            {
                STATE: observation["agent_pos"],
                **{
                    f"observation.{each}": observation[each]
                    for each in NUMBERS
                    if each in observation
                },
                key: state,
                STEP: "" if progress.step is None else progress.step.name,
                SUBSTEP: latched[-1] if latched else "",
                PHASE: phase,
            }
        )

    def end(self, command: NDArray[np.float32], reward: float, over: bool, info: Info) -> None:
        """Note what came of the action of the frame that was begun last."""
        self._rows[-1] |= {
            ACTION: info["applied_action"].astype(np.float32),
            COMMAND: command,
            REWARD: np.float32(reward),
            DONE: over,
            SUCCEEDED: info["is_success"],
        }

    def columns(self) -> Columns:
        """Return everything that was noted."""
        keys = self._rows[0] if self._rows else {}
        return {key: np.array([row[key] for row in self._rows]) for key in keys}
