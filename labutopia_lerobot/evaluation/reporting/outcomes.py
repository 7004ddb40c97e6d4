"""Why episodes failed, in which step, and how precisely they were done."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from labutopia_lerobot.evaluation.causes import failed_in
from labutopia_lerobot.evaluation.reporting.entry import Entry
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.uncertainty.median import Median
from labutopia_lerobot.evaluation.uncertainty.proportion import wilson

EXPERT = "expert"

Failures = Counter[tuple[str, str]]
"""Step and cause -> number of episodes."""


def failures(entry: Entry) -> Failures:
    """Count failed episodes by the step in which they failed and by their cause."""
    return Counter((failed_in(row), cause_told(row)) for row in entry.rows if not row.success)


def cause_told(row: Row) -> str:
    """Return the one cause of a failure; of rows of earlier versions, the outcome."""
    return row.cause or row.outcome.replace("_", " ")


def failure_table(entries: Sequence[Entry]) -> Table:
    """Return one line per cause of failure, with its share of the failures."""
    lines: list[tuple[Cell, ...]] = []
    for entry in entries:
        found = failures(entry)
        for (step, cause), count in found.most_common():
            share = Rate(count, found.total(), wilson(count, found.total()))
            lines.append((entry.task, entry.policy, entry.played, step, cause, share))
    head = ("Task", "Policy", "Condition", "Failed in", "Cause", "Of the failures")
    note = "Every failed episode has one cause. Failed in: the first step that was not done."
    return Table("Failures", head, tuple(lines), note)


def precision_table(entries: Sequence[Entry]) -> Table:
    """Return medians of what was measured, of the successes and of all episodes."""
    pace = expert_seconds(entries)
    lines: list[tuple[Cell, ...]] = []
    for entry in entries:
        for whose, rows in (
            ("successes", [row for row in entry.rows if row.success]),
            ("all", list(entry.rows)),
        ):
            measured = [_median(of, rows) for of in (*_MEASURES.values(), _over(pace, entry))]
            if rows and any(cell is not None for cell in (*measured, _touched(rows))):
                named = (entry.task, entry.policy, entry.played, whose)
                lines.append((*named, *measured, _touched(rows)))
    head = (
        "Task",
        "Policy",
        "Condition",
        "Episodes",
        *_MEASURES,
        "s over the expert",
        "unwanted contact",
    )
    note = (
        "Medians with 95 % intervals (order statistics), of the worst of each episode: millilitres "
        "that are not where they should be, millimetres and degrees off the place at the end, "
        "seconds over the expert's with the same seed. Unwanted contact: episodes in which the arm "
        "touched anything, or the hand the bench, a housing or a bystander."
    )
    return Table("Precision", head, tuple(lines), note).without_empty_columns()


def expert_seconds(entries: Iterable[Entry]) -> Mapping[tuple[Any, ...], float]:
    """Return how long the expert took for each scene in which it succeeded [s]."""
    return {
        scene(row): row.seconds
        for entry in entries
        for row in entry.rows
        if row.policy == EXPERT and row.success
    }


def scene(row: Row) -> tuple[Any, ...]:
    """Return what tells in which scene an episode was played, whoever played it."""
    axes = tuple(row.axes)
    return row.task, row.step, row.split, axes, row.seed, row.liquid, row.robot, row.room


_MEASURES: dict[str, Callable[[Row], float | None]] = {
    "ml off target": lambda row: row.ml_off_target,
    "mm off place": lambda row: row.mm_off_place,
    "deg off place": lambda row: row.deg_off_place,
}


def _over(pace: Mapping[tuple[Any, ...], float], entry: Entry) -> Callable[[Row], float | None]:
    """Return how to tell how many seconds an episode took over the expert's."""
    expert = entry.rows[0].policy == EXPERT
    return lambda row: None if expert or scene(row) not in pace else row.seconds - pace[scene(row)]


def _median(of: Callable[[Row], float | None], rows: Iterable[Row]) -> Median | None:
    return Median.of([value for value in map(of, rows) if value is not None])


def _touched(rows: Sequence[Row]) -> Rate | None:
    told = [row.unwanted_contacts for row in rows if row.unwanted_contacts is not None]
    if not told:
        return None
    count = sum(map(bool, told))
    return Rate(count, len(told), wilson(count, len(told)))
