"""Playing one episode."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, LabEnv
from labutopia_lerobot.evaluation.policies import Policy, PolicyMaker
from labutopia_lerobot.progress import History
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.renderer import opengl_renderer_name
from labutopia_lerobot.world import CONTROL_HZ

PLAY = "single"
"""How sequences are played: one policy from beginning to end."""


@dataclass(frozen=True)
class Pairing:
    """One policy in one setting: whatever an episode depends on beside its seed.

    Attributes:
        setting: What is played and observed.
        policy: What the policy is called.
        make_policy: Makes it.
    """

    setting: Setting
    policy: str
    make_policy: PolicyMaker


@dataclass(frozen=True)
class Row:
    """What became of one episode: one row of a result file.

    Attributes:
        task: Task id.
        split: `train`, `id` or `ood`.
        axes: Axes that were to vary, or with `ood` to be shifted, beside the task's own.
        drawn: Axis -> what the episode drew on it.
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
        history: Predicate -> when it first and last held [s], and how often it came to hold.
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
    axes: list[str]
    drawn: dict[str, Value]
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
    history: dict[str, dict[str, float | int | None]]
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
        _row(pairing, seed, len(actions), info, env.workcell.progress.history),
        np.array(actions, dtype=np.float32),
        opengl_renderer_name() if pairing.setting.obs == "pixels" else None,
    )


@lru_cache(maxsize=1)
def _prepare(pairing: Pairing) -> tuple[LabEnv, Policy]:
    """Compile the scene and load the policy once per process, not once per episode."""
    return LabEnv(pairing.setting), pairing.make_policy()


def _row(
    pairing: Pairing, seed: int, steps: int, info: Info, history: Mapping[str, History]
) -> Row:
    setting, latched = pairing.setting, info["substeps"]
    filled = canonical_task(replace(setting, liquid="on")).contents
    return Row(
        task=setting.task,
        split=setting.split,
        axes=list(setting.axes),
        drawn=info["drawn"],
        policy=pairing.policy,
        play=PLAY,
        obs=setting.obs,
        seed=seed,
        success=info["is_success"],
        ever_success=info["ever_success"],
        outcome=info["outcome"],
        steps=steps,
        seconds=round(steps / CONTROL_HZ, 3),
        substeps={
            name: _time(time if np.isfinite(time) else None) for name, time in latched.items()
        },
        facts=info["facts"],
        history={
            name: {"first": _time(fact.first), "last": _time(fact.last), "times": fact.times}
            for name, fact in history.items()
        },
        liquid=setting.liquid if filled else None,
        ml_total=_millilitres(info.get("ml_total")),
        ml_poured=_millilitres(info.get("ml_poured")),
        ml_retained=_millilitres(info.get("ml_retained")),
        ml_spilled=_millilitres(info.get("ml_spilled")),
        ml_clinging=_millilitres(info.get("ml_clinging")),
        ml_in_flight=_millilitres(info.get("ml_in_flight")),
        clipped_actions=info["clipped_actions"],
        nonfinite_actions=info["nonfinite_actions"],
    )


def _time(seconds: float | None) -> float | None:
    return None if seconds is None else round(float(seconds), 3)


def _millilitres(volume: float | None) -> float | None:
    return None if volume is None else round(volume, 3)
