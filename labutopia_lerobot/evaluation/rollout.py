"""Playing one episode."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.env import Info, LabEnv
from labutopia_lerobot.evaluation.causes import cause_of
from labutopia_lerobot.evaluation.policies import Policy, PolicyMaker, PolicyUnreachable
from labutopia_lerobot.evaluation.precision import Precision
from labutopia_lerobot.evaluation.row import SINGLE, Row, Series
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.renderers import renderer_name
from labutopia_lerobot.sim.workcell import Workcell
from labutopia_lerobot.task import POLICY_UNREACHABLE
from labutopia_lerobot.world import CONTROL_HZ


@dataclass(frozen=True)
class Pairing:
    """One policy in one setting: whatever an episode depends on beside its seed.

    Attributes:
        setting: What is played and observed.
        policy: What the policy is called.
        make_policy: Makes it.
        play: How it plays the steps, `single` or `staged`.
    """

    setting: Setting
    policy: str
    make_policy: PolicyMaker
    play: str = SINGLE

    @property
    def series(self) -> Series:
        """Task, split and way of playing."""
        return self.setting.task, self.setting.split, self.play


@dataclass(frozen=True)
class Episode:
    """A played episode.

    Attributes:
        pairing: What was played.
        row: What became of it.
        actions: Everything that the policy commanded, shape (steps, elements).
    """

    pairing: Pairing
    row: Row
    actions: NDArray[np.float32]


def play(pairing: Pairing, seed: int) -> Episode:
    """Play the episode of a seed.

    Raises:
        Exception: Whatever a policy or a task raises, with a note that names the episode: a bug is
            not a failed episode. Only a policy elsewhere that cannot be asked any more ends it.
    """
    try:
        return _play(pairing, seed)
    except Exception as error:
        setting = pairing.setting
        error.add_note(
            f"In the episode of {setting.task}, split {setting.split}, seed {seed}, played by "
            f"{pairing.policy}, {pairing.play}"
        )
        raise


def _play(pairing: Pairing, seed: int) -> Episode:
    env, policy = _prepare(pairing)
    observation, info = env.reset(seed=seed)
    policy.start(env, seed)
    actions: list[NDArray[np.float32]] = []
    precision = Precision(env.workcell.task, env.workcell.world)
    over = False
    while not over:
        try:
            action = policy.act(observation)
        except PolicyUnreachable:
            info = info | {"outcome": POLICY_UNREACHABLE}
            break
        actions.append(action)
        observation, _, terminated, truncated, info = env.step(action)
        precision.note(info["substeps"])
        over = terminated or truncated
    row = _row(pairing, seed, len(actions), info, env.workcell)
    row = replace(
        row,
        **precision.columns,
        expert_failure=getattr(policy, "failure", None),
        cause=cause_of(row),
        device=getattr(policy, "device", None),
        renderer=_seen_through(pairing.setting),
    )
    elements = env.workcell.simulation.command.size
    commanded = np.array(actions, dtype=np.float32).reshape(len(actions), elements)
    return Episode(pairing, row, commanded)


def _seen_through(setting: Setting) -> str | None:
    return renderer_name(setting.renderer) if setting.obs == "pixels" else None


@lru_cache(maxsize=1)
def _prepare(pairing: Pairing) -> tuple[LabEnv, Policy]:
    """Compile the scene and load the policy once per process, not once per episode."""
    return LabEnv(pairing.setting), pairing.make_policy()


def _row(pairing: Pairing, seed: int, steps: int, info: Info, workcell: Workcell) -> Row:
    setting = pairing.setting
    latched = {name: _time(time) for name, time in info["substeps"].items()}
    return Row(
        task=setting.task,
        split=setting.split,
        axes=list(setting.axes),
        drawn=info["drawn"],
        policy=pairing.policy,
        play=pairing.play,
        obs=setting.obs,
        robot=setting.robot,
        room=setting.room,
        step=setting.step,
        seed=seed,
        success=info["is_success"],
        ever_success=info["ever_success"],
        outcome=info["outcome"],
        steps=steps,
        seconds=round(steps / CONTROL_HZ, 3),
        substeps={m.name: latched[m.name] for step in workcell.steps for m in step.milestones},
        step_times={step.name: latched[step.milestones[-1].name] for step in workcell.steps},
        facts=info["facts"],
        history={
            name: {"first": _time(fact.first), "last": _time(fact.last), "times": fact.times}
            for name, fact in workcell.progress.history.items()
        },
        liquid=setting.liquid if _holds_liquid(setting) else None,
        ml_total=_millilitres(info.get("ml_total")),
        ml_poured=_millilitres(info.get("ml_poured")),
        ml_retained=_millilitres(info.get("ml_retained")),
        ml_spilled=_millilitres(info.get("ml_spilled")),
        ml_clinging=_millilitres(info.get("ml_clinging")),
        ml_in_flight=_millilitres(info.get("ml_in_flight")),
        clipped_actions=info["clipped_actions"],
        nonfinite_actions=info["nonfinite_actions"],
        prelude_failures=info["prelude_failures"],
    )


@lru_cache(maxsize=1)
def _holds_liquid(setting: Setting) -> bool:
    """Tell whether the vessels of the task hold something, also where it is left out."""
    return bool(canonical_task(replace(setting, liquid="on")).contents)


def _time(seconds: float | None) -> float | None:
    return None if seconds is None or np.isinf(seconds) else round(float(seconds), 3)


def _millilitres(volume: float | None) -> float | None:
    return None if volume is None else round(volume, 3)
