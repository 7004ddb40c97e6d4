"""Checks of who judges a task: what is no success, and what has not failed yet."""

from dataclasses import replace
from functools import cache

import numpy as np

from labutopia_lerobot.checks.playing import Player, play, random_walk, start, still
from labutopia_lerobot.checks.require import require
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario import canonical_task


def the_goal_is_false_at_the_start(env: LabEnv) -> None:
    """Nobody succeeds by being there.

    Where things end as they began, the substeps are missing: of several, the first alone may hold.
    """
    begun = start(env, 0)
    info = begun.info
    require(not info["is_success"], "the episode begins with a success")
    latched = [name for name, time in info["substeps"].items() if np.isfinite(time)]
    require(
        not begun.goal or len(latched) < min(2, len(info["substeps"])),
        f"the whole goal holds at the start, and these have latched: {', '.join(latched)}",
    )


def nothing_forbidden_has_happened_at_the_start(env: LabEnv) -> None:
    """No episode is over before it begins."""
    for seed in range(3):
        outcome = start(env, seed).info["outcome"]
        require(outcome == "running", f"seed {seed} begins with {outcome}")


def reading_facts_changes_nothing(env: LabEnv) -> None:
    """Predicates look, and do not touch."""
    start(env, 0)
    before = env.workcell.simulation.state().tobytes()
    for fact in env.workcell.task.facts.values():
        fact.holds(env.workcell.world)
        after = env.workcell.simulation.state().tobytes()
        require(after == before, f"asking '{fact.name}' changes the simulation")


def doing_nothing_does_not_succeed(env: LabEnv) -> None:
    """Neither at the end nor at any instant."""
    _require_no_success(_without_liquid(env), still, seeds=range(1))


def random_actions_do_not_succeed(env: LabEnv) -> None:
    """Neither at the end nor at any instant."""
    _require_no_success(env, random_walk, seeds=range(2))


def doing_nothing_ends_by_timeout_at_the_time_limit(env: LabEnv) -> None:
    """Nothing falls over by itself, and the clock is right."""
    quick = _without_liquid(env)
    trace = play(quick, still, 0).trace
    outcome, steps = trace[-1][1]["outcome"], len(trace) - 1
    require(outcome == "timeout", f"doing nothing ends with {outcome} after {steps} steps")
    limit = quick.workcell.task.max_steps
    require(steps == limit, f"doing nothing ends after {steps} steps, not {limit}")


@cache
def _without_liquid(env: LabEnv) -> LabEnv:
    """Return an environment in which time passes quickly, where the task can do without liquid."""
    return (
        env
        if canonical_task(env.setting).needs_liquid
        else LabEnv(replace(env.setting, liquid="off"))
    )


def _require_no_success(env: LabEnv, player: Player, seeds: range) -> None:
    for seed in seeds:
        trace = play(env, player, seed).trace
        won = any(info["is_success"] or info["ever_success"] for _, info in trace)
        require(not won, f"seed {seed} succeeds")


CHECKS = (
    the_goal_is_false_at_the_start,
    nothing_forbidden_has_happened_at_the_start,
    reading_facts_changes_nothing,
    doing_nothing_does_not_succeed,
    random_actions_do_not_succeed,
    doing_nothing_ends_by_timeout_at_the_time_limit,
)
