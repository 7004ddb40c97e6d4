"""One demonstration: the expert plays an episode, and everything a policy needs is kept."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from labutopia_lerobot.datasets.frames import Columns, Frames
from labutopia_lerobot.datasets.replanning import routes_of
from labutopia_lerobot.datasets.routes import Routes
from labutopia_lerobot.env import Info, LabEnv
from labutopia_lerobot.features import observed_pictures
from labutopia_lerobot.task import SUCCESS

Pictures = Mapping[str, NDArray[Any]]
"""Name -> picture, shape (height, width, channels)."""

EXPERT_FAILED = "expert failed"
"""Outcome where the expert gave up before the episode was over."""


@dataclass(frozen=True)
class Demonstration:
    """Record of one episode of the expert.

    Attributes:
        outcome: The environment's outcome, or "expert failed".
        cause: Why it is no success; empty for a success.
        columns: Feature key -> values, one row per frame (see `Frames`).
        frames: Number of frames.
        info: The environment's last info.
        routes: Map and planned paths; None where nobody drives.
    """

    outcome: str
    cause: str
    columns: Columns
    frames: int
    info: Info
    routes: Routes | None


def demonstrate(
    env: LabEnv, seed: int, film: Callable[[Pictures], None], pace: float = 1.0
) -> Demonstration:
    """Let the expert play the episode of this seed.

    Args:
        env: Where to play.
        seed: The episode to play.
        film: Gets the pictures of each frame with `obs="pixels"`.
        pace: How fast the expert's hand moves, as a share of its usual speeds.
    """
    observation, info = env.reset(seed=seed)
    frames = Frames(env, env.setting.obs)
    expert = env.expert(pace)
    expert.start()
    over = False
    while not over:
        command = expert.act()
        if expert.failure is not None:
            break
        frames.begin(observation, expert.label)
        if env.setting.obs == "pixels":
            film(observed_pictures(observation))
        observation, reward, terminated, truncated, info = env.step(command)
        over = terminated or truncated
        frames.end(command, reward, over, info)
    outcome = EXPERT_FAILED if expert.failure else info["outcome"]
    return Demonstration(
        outcome=outcome,
        cause="" if outcome == SUCCESS else expert.failure or outcome,
        columns=frames.columns(),
        frames=len(frames),
        info=info,
        routes=routes_of(env, expert.routes),
    )
