"""Which rows stand together: one policy in one task, under one condition."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby

from labutopia_lerobot.evaluation.found import FoundResult
from labutopia_lerobot.evaluation.row import SINGLE, Row
from labutopia_lerobot.evaluation.statistics import Summary, summarise
from labutopia_lerobot.evaluation.uncertainty.proportion import Interval
from labutopia_lerobot.robots import DEFAULT_ROBOT
from labutopia_lerobot.scenes import DEFAULT_ROOM
from labutopia_lerobot.setting import ALL, FILAMENT

ID, OOD, ALL_AXES = "ID", "OOD", "all axes"
REFERENCES = ("expert", "random", "still")
"""Policies that look at no pictures anyway, and are not marked for it."""


@dataclass(frozen=True)
class Entry:
    """One policy in one task, under one condition.

    Attributes:
        policy: What it is called here: its name, and whatever sets it apart.
        condition: `ID`, `OOD` (what the task shifts), `all axes`, or what else was varied.
        rows: Its rows, in the order of the seeds.
        result: Where they come from.
    """

    policy: str
    condition: str
    rows: tuple[Row, ...]
    result: FoundResult

    @property
    def task(self) -> str:
        """Task id."""
        return self.rows[0].task

    @property
    def level(self) -> int:
        """Level of the task; 0 of a task whose folder is named otherwise."""
        digits = self.task.partition("/")[0].removeprefix("level")
        return int(digits) if digits.isdigit() else 0

    @property
    def play(self) -> str:
        """How steps were played: `single` or `staged`."""
        return self.rows[0].play

    @property
    def step(self) -> str | None:
        """The step that was played alone, or None."""
        return self.rows[0].step

    @property
    def played(self) -> str:
        """The condition, and what is unusual about how the steps were played."""
        alone = [] if self.step is None else [f"{self.step} alone"]
        return ", ".join([self.condition, *([self.play] if self.play != SINGLE else alone)])

    @cached_property
    def summary(self) -> Summary:
        """Its rates."""
        (summary,) = summarise(self.rows)
        return summary

    @property
    def sequential(self) -> bool:
        """Whether the run stopped by what it had seen, so that only `anytime95` is valid."""
        return self.result.provenance.get("config", {}).get("until") is not None

    @property
    def interval(self) -> Interval:
        """Confidence interval of the rate of success, 95 %."""
        summary = self.summary
        anytime = summary.anytime95 if self.sequential else None
        return summary.wilson95 if anytime is None else anytime


def entries(results: Sequence[FoundResult]) -> list[Entry]:
    """Return what results hold, by task, policy and condition; `single` before `staged`.

    Two results with the same policy, as two checkpoints of one kind, are told apart by where they
    lie.
    """
    found = [entry for result in results for entry in _of_result(result)]
    by_heading: dict[tuple[str, ...], list[Entry]] = {}
    for entry in found:
        by_heading.setdefault(_heading(entry), []).append(entry)
    ambiguous = {entry.policy for same in by_heading.values() if len(same) > 1 for entry in same}
    told = [
        replace(entry, policy=f"{entry.policy} ({_short(entry.result, results)})")
        if entry.policy in ambiguous
        else entry
        for entry in found
    ]
    return sorted(told, key=lambda e: (e.task, e.policy, _order(e.condition), e.play, e.step or ""))


def condition(row: Row) -> str:
    """Return under which condition an episode was played, as a column of a table is called."""
    if row.split == "ood":
        if row.axes == [ALL]:
            return ALL_AXES
        return f"OOD {'+'.join(row.axes)}" if row.axes else OOD
    name = ID if row.split == "id" else row.split
    return f"{name} {'+'.join(row.axes)}" if row.axes else name


def conditions(of: Iterable[Entry]) -> list[str]:
    """Return the conditions of entries: `ID`, `OOD`, `all axes`, then the others."""
    return sorted({entry.condition for entry in of}, key=_order)


def _order(condition: str) -> tuple[int, str]:
    usual = (ID, OOD, ALL_AXES)
    return (usual.index(condition) if condition in usual else len(usual), condition)


def _of_result(result: FoundResult) -> Iterable[Entry]:
    def heading(row: Row) -> tuple[str, ...]:
        return row.task, _policy(row), condition(row), row.play, row.step or ""

    for (_, policy, shown, *_), rows in groupby(sorted(result.rows, key=heading), key=heading):
        ordered = tuple(sorted(rows, key=lambda row: row.seed))
        yield Entry(policy, shown, ordered, result)


def _heading(entry: Entry) -> tuple[str, ...]:
    return entry.task, entry.policy, entry.condition, entry.play, entry.step or ""


def _policy(row: Row) -> str:
    """Return the policy's name, marked with what is unusual about how it was played."""
    marks = {
        "state": row.obs == "state" and row.policy not in REFERENCES,
        "liquid=off": row.liquid == "off",
        f"robot={row.robot}": row.robot != DEFAULT_ROBOT,
        f"room={row.room}": row.room != DEFAULT_ROOM,
        f"renderer={FILAMENT}": row.seen_through_filament,
    }
    return ", ".join([row.policy, *(mark for mark, applies in marks.items() if applies)])


def _short(result: FoundResult, results: Sequence[FoundResult]) -> str:
    """Return the end of a place's path that no other result has."""
    parts = result.place.parts
    others = [other.place.parts for other in results if other is not result]
    for length in range(1, len(parts) + 1):
        if all(other[-length:] != parts[-length:] for other in others):
            return "/".join(parts[-length:])
    return str(result.place)
