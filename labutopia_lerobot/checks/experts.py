"""Checks of the scripted expert."""

from dataclasses import replace

from labutopia_lerobot.checks.playing import expert, play
from labutopia_lerobot.checks.require import require
from labutopia_lerobot.checks.why import why_failed
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import PARTICLES
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.task import HOLD_S, SUCCESS
from labutopia_lerobot.world import CONTROL_HZ


def expert_commands_are_never_clipped(env: LabEnv) -> None:
    """Check that the expert's commands are what acts."""
    _, info = play(env, expert, 100).trace[-1]
    clipped, bad = info["clipped_actions"], info["nonfinite_actions"]
    require(clipped == 0, f"{clipped} commands of the expert were clipped")
    require(bad == 0, f"{bad} commands of the expert were not finite")


def the_expert_touches_only_what_its_phases_list(env: LabEnv) -> None:
    """Every pair that may touch is declared."""
    script = play(env, expert, 100).actor
    assert isinstance(script, Expert)
    pairs = ", ".join(f"{mover} and {other}" for mover, other in script.unexpected)
    require(not pairs, f"seed 100: touched what no phase lists: {pairs}")


def success_needs_two_seconds_of_the_goal(env: LabEnv) -> None:
    """The goal has held without a break before the episode ends."""
    trace = play(env, expert, 100).trace
    held = 0
    for _, info in reversed(trace):
        if not all(info["facts"][fact.name] for fact in env.workcell.task.goal):
            break
        held += 1
    require(trace[-1][1]["is_success"], f"seed 100 ends with {trace[-1][1]['outcome']}")
    least = HOLD_S * CONTROL_HZ + 1  # both ends of sixty control periods
    require(held >= least, f"the goal held for {held} control steps only, not {least:g}")


def a_step_can_begin_where_the_one_before_is_done(env: LabEnv) -> None:
    """The expert wins too if every step is begun anew in the moment in which it may begin.

    There a policy per step takes over, and there the demonstrations of a single step begin.
    """
    env.reset(seed=100)
    *before, _ = env.workcell.task.steps
    if before:
        info = env.reset(seed=100, options={"after": before[-1].name})[1]
        tries = info["setup_failures"] + 1
        require(tries == 1, f"seed 100: it took {tries} tries to play the steps before one by one")
        _finish(env)
        outcome = env.workcell.progress.outcome
        require(outcome == SUCCESS, f"seed 100, played step by step, ends with {outcome}")


def the_expert_wins_at_least_nine_of_ten(env: LabEnv) -> None:
    """Check the first ten seeds from 100, with as much liquid as everywhere else."""
    usual = LabEnv(replace(env.setting, particles=PARTICLES))
    failures: dict[tuple[str, str], tuple[list[int], str]] = {}
    for seed in range(100, 110):
        script, cell = _play(usual, seed), usual.workcell
        if cell.progress.outcome != SUCCESS:
            cause = cell.progress.outcome, script.failure or script.label
            why = "; ".join(why_failed(cell.task, cell.progress, script, cell.world))
            seeds, _ = failures.setdefault(cause, ([], why))
            seeds.append(seed)
    usual.close()
    failed = sum(len(seeds) for seeds, _ in failures.values())
    reasons = (
        f"seeds {', '.join(map(str, seeds))}: {outcome}; the first: {why}"
        for (outcome, _), (seeds, why) in failures.items()
    )
    require(failed <= 1, f"{failed} of 10 failed. {' | '.join(reasons)}")


def _play(env: LabEnv, seed: int) -> Expert:
    """Play the expert's episode to its end; return the expert."""
    env.reset(seed=seed)
    return _finish(env)


def _finish(env: LabEnv) -> Expert:
    """Play the expert from a reset on to the end of the episode; return the expert."""
    script = expert(env)
    over = False
    while not over:
        _, _, terminated, truncated, _ = env.step(script.act())
        over = terminated or truncated
    return script


CHECKS = (
    expert_commands_are_never_clipped,
    the_expert_touches_only_what_its_phases_list,
    success_needs_two_seconds_of_the_goal,
    a_step_can_begin_where_the_one_before_is_done,
    the_expert_wins_at_least_nine_of_ten,
)
