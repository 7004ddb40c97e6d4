"""Why an episode failed, in one phrase, derived from the history of its facts."""

from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.task import DIVERGED, INTERRUPTED

NEVER_REACHED = "never reached"
MISSED_GRASP = "missed grasp"
DROPPED = "dropped"
TIPPED = "tipped"
SPILLED = "spilled"
WRONG_OBJECT = "wrong object"
HIT_SOMETHING = "hit something"
GOAL_NOT_KEPT = "goal not kept"
"""It held at an instant, but not for as long as it must."""

_BREACHES = {
    "wrong": WRONG_OBJECT,
    "spilled": SPILLED,
    "knocked_over": TIPPED,
    "dropped": DROPPED,
    "struck": HIT_SOMETHING,
    "collided": HIT_SOMETHING,
}
"""Part of the name of an outcome that a task forbids -> cause."""

_GRIPS = (" gripped", " grasped")
"""Suffix of the facts about a thing in the hand."""

_LETTING_GO = ("placed", "released", "withdrawn")
"""Substeps that are about letting go."""


def cause_of(row: Row) -> str | None:
    """Return why an episode is no success, or None if it is one.

    "Too slow in" and "interrupted in" name the first substep that did not latch. A breach that is
    none of the usual ones is its own cause.
    """
    if row.success:
        return None
    for part, cause in _BREACHES.items():
        if part in row.outcome:
            return TIPPED if cause == DROPPED and _held(row) is False else cause
    step = next((name for name, time in row.substeps.items() if time is None), None)
    if row.outcome == INTERRUPTED:
        return _lost(row, step) or f"interrupted in {step}"
    if row.outcome != "timeout":
        return "simulation diverged" if row.outcome == DIVERGED else row.outcome.replace("_", " ")
    if step is None:
        return GOAL_NOT_KEPT if row.ever_success else "too slow in the goal"
    return _not_grasped(row, step) or _lost(row, step) or f"too slow in {step}"


def _held(row: Row) -> bool | None:
    """Return whether anything was ever in the hand; None where no fact says so."""
    grips = [row.history[name]["times"] for name in row.history if name.endswith(_GRIPS)]
    return any(grips) if grips else None


def _not_grasped(row: Row, step: str) -> str | None:
    """Return why a substep that is about grasping or touching did not latch."""
    last = step.rpartition("/")[2]
    if last == "pressed":
        touched = [fact["times"] for name, fact in row.history.items() if "finger on" in name]
        return None if any(touched) or not touched else NEVER_REACHED
    if "grip" not in last and "grasp" not in last:
        return None
    free = [_thing(name) for name in _grips(row) if not row.history[name]["times"]]
    if not free:
        return MISSED_GRASP  # the fingers closed on it, but not as the substep wants it
    moved = any(_changed(row, name) for name in row.history if name.startswith(tuple(free)))
    return MISSED_GRASP if moved else NEVER_REACHED


def _lost(row: Row, step: str | None) -> str | None:
    """Return how something slipped out of the hand that should still be in it, or None."""
    let_go = any(
        time is not None and name.rpartition("/")[2] == "released"
        for name, time in row.substeps.items()
    )
    if let_go or (step or "").rpartition("/")[2] in _LETTING_GO:
        return None
    for grip in _grips(row):
        if row.history[grip]["times"] and not row.facts[grip]:
            carried = f"{_thing(grip)} lifted"
            lifted = any(
                fact["times"] for name, fact in row.history.items() if name.startswith(carried)
            )
            return DROPPED if lifted else MISSED_GRASP
    return None


def _grips(row: Row) -> list[str]:
    return [name for name in row.history if name.endswith(_GRIPS)]


def _thing(grip: str) -> str:
    return grip.removesuffix(_GRIPS[0]).removesuffix(_GRIPS[1])


def _changed(row: Row, name: str) -> bool:
    """Return whether a fact ever began or ceased to hold."""
    fact = row.history[name]
    if fact["times"] != 1:
        return bool(fact["times"])
    firsts = [other["first"] for other in row.history.values() if other["first"] is not None]
    return not row.facts[name] or fact["first"] != min(firsts)


def failed_in(row: Row) -> str:
    """Return the first step that was not done; of rows without steps, the first substep."""
    times = row.step_times or row.substeps
    return next((name for name, time in times.items() if time is None), "the goal")
