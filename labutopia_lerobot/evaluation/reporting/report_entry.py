"""Rows that stand together: one policy under one condition."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from labutopia_lerobot.evaluation.condition import ALL_AXES, ID, OOD, Condition
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.reporting.table import Rate
from labutopia_lerobot.evaluation.rows import EvaluationSummary, Row, by_condition, summary_of
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence
from labutopia_lerobot.evaluation.uncertainty.intervals import wilson


@dataclass(frozen=True)
class ReportEntry:
    """One policy under one condition.

    Attributes:
        policy: What the rows call the policy.
        condition: Under which condition it played.
        rows: Its rows, in the order of the seeds.
        result: Where they come from.
        place: Folder or file that distinguishes its result from another with the same policy and
            condition, or nothing.
    """

    policy: str
    condition: Condition
    rows: tuple[Row, ...]
    result: LoadedResult
    place: str = ""

    @property
    def task(self) -> str:
        """Task id."""
        return self.condition.task

    @property
    def level(self) -> int:
        """Level of the task; 0 of a task whose folder is named otherwise."""
        digits = self.task.partition("/")[0].removeprefix("level")
        return int(digits) if digits.isdigit() else 0

    @property
    def name(self) -> str:
        """Name of the policy, whatever it played."""
        return f"{self.policy} ({self.place})" if self.place else self.policy

    @property
    def label(self) -> str:
        """Name of the policy in tables, with what distinguishes it from others."""
        return self.condition.label(self.policy) + (f" ({self.place})" if self.place else "")

    @cached_property
    def summary(self) -> EvaluationSummary:
        """Its rates."""
        return summary_of(self.rows, self.policy, self.condition, self.sequential)

    @property
    def sequential(self) -> bool:
        """Whether the run could stop early by its outcomes: then only what is valid anytime is."""
        return self.result.sequential

    def rate(self, count: int, n: int) -> Rate:
        """Return the share of some of its episodes, with the interval that is valid for its run."""
        if self.sequential:
            low, high = confidence_sequence(count, n)
            return Rate(count, n, (float(low), float(high)))
        return Rate(count, n, wilson(count, n))


def report_entries(results: Sequence[LoadedResult]) -> list[ReportEntry]:
    """Return what results hold, by task, policy and condition; `single` before `staged`.

    Two results of one policy under one condition, as of two checkpoints of one kind, are
    distinguished by where they lie.
    """
    entries: dict[tuple[Condition, str], list[ReportEntry]] = {}
    for result in results:
        for key, rows in by_condition(sorted(result.rows, key=lambda row: row.seed)).items():
            entry = ReportEntry(key[1], key[0], tuple(rows), result)
            entries.setdefault(key, []).append(entry)
    ambiguous = {policy for (_, policy), same in entries.items() if len(same) > 1}
    named = [
        replace(entry, place=_distinct_end(entry.result, results))
        if entry.policy in ambiguous
        else entry
        for same in entries.values()
        for entry in same
    ]
    return sorted(named, key=_order)


def shifts(of: Iterable[ReportEntry]) -> list[str]:
    """Return the shifts of entries: `ID`, `OOD`, `all axes`, then the others."""
    return sorted({entry.condition.shift for entry in of}, key=_order_of_shift)


def _order(entry: ReportEntry) -> tuple[object, ...]:
    played = entry.condition
    return entry.task, entry.label, _order_of_shift(played.shift), played.play, played.step or ""


def _order_of_shift(shift: str) -> tuple[int, str]:
    usual = (ID, OOD, ALL_AXES)
    return (usual.index(shift) if shift in usual else len(usual), shift)


def _distinct_end(result: LoadedResult, results: Sequence[LoadedResult]) -> str:
    """Return the end of a place's path that no other result has."""
    parts = result.place.parts
    others = [other.place.parts for other in results if other is not result]
    for length in range(1, len(parts) + 1):
        if all(other[-length:] != parts[-length:] for other in others):
            return "/".join(parts[-length:])
    return str(result.place)
