"""Why an expert did not succeed, in the words of the task."""

from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.progress import Progress
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.task import COLLIDED, HOLD_S, INTERRUPTED, SUCCESS, TIMEOUT, Task
from labutopia_lerobot.world import World


def why_failed(task: Task, progress: Progress, expert: Expert, world: World) -> list[str]:
    """Return what kept an episode that is over from success, line by line; nothing if it succeeded.

    Args:
        task: The played task.
        progress: Who judged it.
        expert: Who played it.
        world: Where it was played, as it is at the end.
    """
    if progress.outcome == SUCCESS:
        return []
    missing = [name for name, time in progress.substeps.items() if time is None]
    step = "the goal" if progress.step is None else f"step '{progress.step.name}'"
    lines = [
        f"Ended in {step}: {_ending(task, progress, world)}",
        f"Expert: {_expert(expert)}",
        *([] if expert.finished else [f"Hand: {expert.shortfall}"]),
        f"Substeps not reached: {', '.join(missing) or 'none'}",
    ]
    false = [_missed(fact, world) for fact in progress.awaited if not progress.facts[fact.name]]
    awaited = f"for '{missing[0]}'" if missing else "for the goal"
    if false:
        lines.append(f"Did not hold at the end, {awaited}: {'; '.join(false)}")
    elif progress.outcome == TIMEOUT:
        lines.append(f"All held at the end, {awaited}, but not for long enough")
    if missing and progress.counting is not None:
        count = progress.counting
        lines.append(f"Counted, {awaited}: {progress.counted:.3g} of {count.needed:g} {count.name}")
    lines += [
        f"Touched what no phase lists: {mover} and {other}, {count} control steps"
        for (mover, other), count in expert.unexpected.most_common()
    ]
    return lines


def _missed(fact: Predicate, world: World) -> str:
    """Return a fact that does not hold, and by how much where that is measured."""
    errors = fact.errors(world).items()
    amounts = ", ".join(f"{amount:.3g} {unit}" for unit, amount in errors)
    return f"{fact.name} (off by {amounts})" if amounts else fact.name


def _ending(task: Task, progress: Progress, world: World) -> str:
    """Return what ended the episode."""
    if progress.outcome == TIMEOUT:
        return (
            f"the time limit of {task.time_limit_s:g} s ran out "
            f"(the goal has to hold for {HOLD_S:g} s)"
        )
    if progress.outcome == INTERRUPTED:
        return "what a substep must keep ceased to hold"
    breach = task.forbidden(progress.step or task.steps[-1]).get(progress.outcome)
    if breach is None:
        return progress.outcome
    reason = breach.reason(world)
    because = f": {reason}" if reason else ""
    cure = "; is the hand to? Then name it in `touches` of the step" * (
        progress.outcome == COLLIDED
    )
    return f"{progress.outcome} ({breach.name}){because}{cure}"


def _expert(expert: Expert) -> str:
    if expert.failure is not None:
        return f"gave up: {expert.failure}"
    if expert.finished:
        return "had played all its phases"
    return f"was in phase {expert.label}"
