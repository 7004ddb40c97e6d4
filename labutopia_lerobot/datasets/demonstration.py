"""One demonstration: the expert plays an episode, and everything a policy needs is kept."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import state_keys
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.task import SUCCESS

Pictures = Mapping[str, NDArray[np.uint8]]
"""Camera -> picture, shape (height, width, 3)."""


@dataclass(frozen=True)
class Demonstration:
    """What happened in one episode of the expert.

    Attributes:
        outcome: The environment's outcome, or "expert failed".
        cause: Why it is no success, or None.
        columns: Feature key -> values, shape (frames, elements), float32. Row k holds the
            observation before action k, and the action that acted.
        phases: Label of each phase of the expert and the frame in which it began.
        drawn: Axis -> what the episode drew on it.
    """

    outcome: str
    cause: str | None
    columns: dict[str, NDArray[np.float32]]
    phases: tuple[tuple[str, int], ...]
    drawn: dict[str, Value]

    @property
    def frames(self) -> int:
        """Number of frames."""
        return len(self.columns[ACTION])


def demonstrate(env: LabEnv, seed: int, film: Callable[[Pictures], None]) -> Demonstration:
    """Let the expert play the episode of this seed.

    Args:
        env: Where to play.
        seed: The episode to play.
        film: Gets the pictures of each frame with `obs="pixels"`.
    """
    keys = state_keys(env.setting.obs)
    rows: dict[str, list[NDArray[np.float32]]] = {key: [] for key in keys.values()}
    actions: list[NDArray[np.float32]] = []
    phases: list[tuple[str, int]] = []
    observation, info = env.reset(seed=seed)
    expert = env.expert()
    expert.start()
    over = False
    while not over:
        action = expert.act()
        if expert.failure is not None:
            break
        if not phases or phases[-1][0] != expert.label:
            phases.append((expert.label, len(actions)))
        rows[keys["agent_pos"]].append(observation["agent_pos"])
        rows[keys["environment_state"]].append(env.environment_state())
        if env.setting.obs == "pixels":
            film(observation["pixels"])
        observation, _, terminated, truncated, info = env.step(action)
        actions.append(info["applied_action"])
        over = terminated or truncated
    rows[ACTION] = actions
    outcome = "expert failed" if expert.failure else info["outcome"]
    return Demonstration(
        outcome=outcome,
        cause=None if outcome == SUCCESS else expert.failure or outcome,
        columns={key: np.array(values, dtype=np.float32) for key, values in rows.items()},
        phases=tuple(phases),
        drawn=info["drawn"],
    )
