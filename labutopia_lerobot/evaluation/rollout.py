"""Playing one episode."""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, LabEnv
from labutopia_lerobot.evaluation.policies import Policy, PolicyMaker
from labutopia_lerobot.features import CAMERAS, IMAGE_SIZE
from labutopia_lerobot.registry import load_task
from labutopia_lerobot.sim.renderer import opengl_renderer_name
from labutopia_lerobot.world import CONTROL_HZ

PLAY = "single"
"""How sequences are played: one policy from beginning to end."""


@dataclass(frozen=True)
class Pairing:
    """One policy in one task and split: whatever an episode depends on beside its seed.

    Attributes:
        task: Task id, such as `level1/pick`.
        split: `train` or `id`.
        policy: What the policy is called.
        make_policy: Makes it.
        obs: `pixels` or `state`.
        cameras: Which cameras `pixels` has.
        width: Width of the pictures [pixels].
        height: Height of the pictures [pixels].
        tasks_dir: A further folder of tasks.
        liquid: `on`, or `off` for empty vessels.
    """

    task: str
    split: str
    policy: str
    make_policy: PolicyMaker
    obs: str = "state"
    cameras: tuple[str, ...] = CAMERAS
    width: int = IMAGE_SIZE
    height: int = IMAGE_SIZE
    tasks_dir: str | None = None
    liquid: str = "on"

    def make_env(self) -> LabEnv:
        """Return the environment that the policy plays in; nothing is compiled yet."""
        return LabEnv(
            self.task,
            self.obs,
            self.cameras,
            self.width,
            self.height,
            self.split,
            self.tasks_dir,
            self.liquid,
        )


@dataclass(frozen=True)
class Row:
    """What became of one episode: one row of a result file.

    Attributes:
        task: Task id.
        split: `train` or `id`.
        policy: What the policy is called.
        play: How the sequence was played.
        obs: `pixels` or `state`.
        seed: What the environment was reset with.
        success: Whether the goal held for as long as it must.
        ever_success: Whether the goal held at any instant.
        outcome: How it ended.
        steps: Control steps played.
        seconds: The same in simulated time [s].
        substeps: Sub-step -> time at which it latched [s], or None.
        facts: Every predicate of the task, as it was at the end.
        liquid: `on` or `off`; None for a task whose vessels are empty anyway.
        ml_total: Liquid in the scene [ml], the sum of the next five; None without liquid.
        ml_poured: Liquid at the end in other vessels than it was filled into [ml].
        ml_retained: Liquid in the vessels that it was filled into [ml].
        ml_spilled: Liquid on something that can never move, as the bench [ml].
        ml_clinging: Liquid outside on a vessel, or on something that can move [ml].
        ml_in_flight: Liquid outside all vessels that touches nothing [ml].
        clipped_actions: Actions beyond a limit of position or velocity.
        nonfinite_actions: Actions with an infinite or undefined element.
    """

    task: str
    split: str
    policy: str
    play: str
    obs: str
    seed: int
    success: bool
    ever_success: bool
    outcome: str
    steps: int
    seconds: float
    substeps: dict[str, float | None]
    facts: dict[str, bool]
    liquid: str | None
    ml_total: float | None
    ml_poured: float | None
    ml_retained: float | None
    ml_spilled: float | None
    ml_clinging: float | None
    ml_in_flight: float | None
    clipped_actions: int
    nonfinite_actions: int


@dataclass(frozen=True)
class Episode:
    """A played episode.

    Attributes:
        pairing: What was played.
        row: What became of it.
        actions: Everything that the policy commanded, shape (steps, 8).
        renderer: What drew the pictures that the policy saw, or None.
    """

    pairing: Pairing
    row: Row
    actions: NDArray[np.float32]
    renderer: str | None


def play(pairing: Pairing, seed: int) -> Episode:
    """Play the episode of a seed. Errors are not caught: a bug is not a failed episode."""
    env, policy = _prepare(pairing)
    observation, info = env.reset(seed=seed)
    policy.start(env, seed)
    actions: list[NDArray[np.float32]] = []
    over = False
    while not over:
        action = policy.act(observation)
        actions.append(action)
        observation, _, terminated, truncated, info = env.step(action)
        over = terminated or truncated
    return Episode(
        pairing,
        _row(pairing, seed, len(actions), info),
        np.array(actions, dtype=np.float32),
        opengl_renderer_name(env.renderer) if pairing.obs == "pixels" else None,
    )


@lru_cache(maxsize=1)
def _prepare(pairing: Pairing) -> tuple[LabEnv, Policy]:
    """Compile the scene and load the policy once per process, not once per episode."""
    return pairing.make_env(), pairing.make_policy()


def _row(pairing: Pairing, seed: int, steps: int, info: Info) -> Row:
    latched: dict[str, Any] = info["substeps"]
    return Row(
        task=pairing.task,
        split=pairing.split,
        policy=pairing.policy,
        play=PLAY,
        obs=pairing.obs,
        seed=seed,
        success=info["is_success"],
        ever_success=info["ever_success"],
        outcome=info["outcome"],
        steps=steps,
        seconds=round(steps / CONTROL_HZ, 3),
        substeps={
            name: round(float(time), 3) if np.isfinite(time) else None
            for name, time in latched.items()
        },
        facts=info["facts"],
        liquid=pairing.liquid if load_task(pairing.task, pairing.tasks_dir).contents else None,
        ml_total=_millilitres(info.get("ml_total")),
        ml_poured=_millilitres(info.get("ml_poured")),
        ml_retained=_millilitres(info.get("ml_retained")),
        ml_spilled=_millilitres(info.get("ml_spilled")),
        ml_clinging=_millilitres(info.get("ml_clinging")),
        ml_in_flight=_millilitres(info.get("ml_in_flight")),
        clipped_actions=info["clipped_actions"],
        nonfinite_actions=info["nonfinite_actions"],
    )


def _millilitres(volume: float | None) -> float | None:
    return None if volume is None else round(volume, 3)
