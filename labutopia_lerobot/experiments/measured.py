"""Results of an experiment as tables and curves: what is not measured says so."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path
from statistics import mean, stdev
from typing import Any

from labutopia_lerobot.evaluation.compare import (
    NUMBERS,
    Comparison,
    NoCommonEpisodesError,
    compare,
    compare_controlled,
    comparison_table,
    explanation,
)
from labutopia_lerobot.evaluation.condition import REFERENCES
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.reporting.charts import curve
from labutopia_lerobot.evaluation.reporting.report_entry import report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import success
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.evaluation.uncertainty.paired import holm
from labutopia_lerobot.experiments.parts.evaluation_part import EvaluationPart
from labutopia_lerobot.experiments.rates import UNKNOWN

_OTHER_EPISODES = "other episodes"
"""What stands where two results are not of the same episodes."""
_RATES = "Successes of episodes, per cent, 95 % interval (Wilson)."


@dataclass(frozen=True)
class Line:
    """A line of a curve.

    Attributes:
        label: What tables call the policy.
        played: Under which condition it plays.
        task: Task id.
        demonstrations: How many it has learned from, or None where that is the axis.
    """

    label: str
    played: str
    task: str
    demonstrations: int | None

    @property
    def who(self) -> str:
        """What all lines of a chart have in common."""
        return f"{self.label}, {self.played}"

    @property
    def short(self) -> str:
        """Its name in a chart, where there is little room."""
        count = "" if self.demonstrations is None else f" ({self.demonstrations})"
        return f"{self.task.partition('/')[2]}{count}"

    def __str__(self) -> str:
        count = "" if self.demonstrations is None else f", {self.demonstrations} demonstrations"
        return f"{self.label}, {self.task}, {self.played}{count}"


@dataclass(frozen=True)
class Measured:
    """Evaluations of an experiment, with the results of those that are finished.

    Attributes:
        evaluations: All of them, in order.
        results: Of the finished ones.
    """

    evaluations: tuple[EvaluationPart, ...]
    results: Mapping[EvaluationPart, LoadedResult]

    @classmethod
    def of(cls, evaluations: Iterable[EvaluationPart]) -> "Measured":
        """Read what is there."""
        wanted = tuple(evaluations)
        return cls(wanted, {e: load_results(e.place)[0] for e in wanted if e.finished()})

    @property
    def final(self) -> list[EvaluationPart]:
        """Those of the last weights, from as many demonstrations as most policies and tasks have.

        Where one has never so many, the most that it has: numbers in one table are comparable. Of
        trainings that differ in their seed alone, the first.
        """
        last = [each for each in self.evaluations if each.at is None and not each.repeat]
        counts: dict[tuple[str, str], set[int]] = {}
        for each in last:
            counts.setdefault((each.label, each.task), set()).add(each.demonstrations or 0)
        times = Counter(count for of_one in counts.values() for count in of_one)
        usual = max(times, key=lambda count: (times[count] * (count > 0), count), default=0)
        chosen = {who: usual if usual in own else max(own) for who, own in counts.items()}
        return [e for e in last if (e.demonstrations or 0) == chosen[e.label, e.task]]

    def rate(self, evaluation: EvaluationPart | None) -> Cell:
        """Return the successes of an evaluation, or that they are not measured.

        Args:
            evaluation: The evaluation, or None for one that was not to be.
        """
        if evaluation is None:
            return None
        result = self.results.get(evaluation)
        return UNKNOWN if result is None else success(report_entries([result])[0])

    def tables(self) -> list[Table]:
        """Return the tables of tasks, causes, learning curves, trainings, controls, comparisons."""
        return [
            self.by_task(),
            *self._causes(),
            *self._curve_tables(),
            *self.trainings(),
            *self.controls(),
            *self._comparisons(),
        ]

    def final_results(self) -> list[LoadedResult]:
        """Return the finished ones of `final`."""
        return [self.results[each] for each in self.final if each in self.results]

    def curves(self) -> list[dict[str, Any]]:
        """Return the charts of what grows with demonstrations, or with steps."""
        charts = []
        for title, places, lines in self._series():
            drawn: dict[str, dict[str, dict[int, Rate]]] = {}
            for line, points in lines.items():
                rates = {x: rate for x, rate in points.items() if isinstance(rate, Rate)}
                if rates:
                    drawn.setdefault(line.who, {})[line.short] = rates
            charts += [curve(f"{who}: {title.lower()}", places, of) for who, of in drawn.items()]
        return charts

    def by_task(self) -> Table:
        """Return the successes: a line per task and condition, a column per policy."""
        labels = list(dict.fromkeys(each.label for each in self.final))
        of: dict[tuple[str, str], dict[str, EvaluationPart]] = {}
        for each in self.final:
            of.setdefault((each.task, _played(each)), {})[each.label] = each
        lines = [
            (task, played, *(self.rate(by_label.get(label)) for label in labels))
            for (task, played), by_label in of.items()
        ]
        note = f"{_RATES} Where a policy was not to be evaluated stands nothing."
        return Table("All tasks", ("Task", "Condition", *labels), tuple(lines), note)

    def _causes(self) -> list[Table]:
        """Why episodes failed, the most frequent cause first."""
        lines = []
        for each in self.final:
            entries = report_entries([self.results[each]]) if each in self.results else []
            for causes in (entry.summary.causes for entry in entries):
                if causes:
                    said = ", ".join(f"{cause} {count}" for cause, count in causes.items())
                    lines.append((each.label, each.task, _played(each), sum(causes.values()), said))
        head = ("Policy", "Task", "Condition", "Failures", "Causes")
        return [Table("Why they fail", head, tuple(lines))] if lines else []

    def _curve_tables(self) -> list[Table]:
        """Curves of which two points or more are measured, and how many others there are to be."""
        tables = []
        for title, places, lines in self._series():
            drawn = [
                (str(line), *(points.get(x) for x in places))
                for line, points in lines.items()
                if sum(isinstance(rate, Rate) for rate in points.values()) > 1
            ]
            left = len(lines) - len(drawn)
            note = f"{_RATES} Not measured yet: {left} of {len(lines)} curves." if left else _RATES
            if drawn:
                tables.append(Table(title, ("Policy and task", *map(str, places)), (*drawn,), note))
        return tables

    def _series(self) -> list[tuple[str, list[int], dict["Line", dict[int, Cell]]]]:
        """Return title, places on the axis, and line -> place -> its rate."""
        by_count: dict[Line, dict[int, Cell]] = {}
        by_step: dict[Line, dict[int, Cell]] = {}
        for each in self.evaluations:
            if each.demonstrations is None or each.repeat:
                continue
            line = Line(each.label, _played(each), each.task, None)
            if each.at is None:
                by_count.setdefault(line, {})[each.demonstrations] = self.rate(each)
            along = by_step.setdefault(replace(line, demonstrations=each.demonstrations), {})
            steps = each.trainings[0].steps if each.at is None else each.at
            along[steps] = self.rate(each)
        return [
            (title, sorted({x for points in shown.values() for x in points}), shown)
            for title, lines in {
                "Success over demonstrations": by_count,
                "Success over steps of the training": by_step,
            }.items()
            if (shown := {line: points for line, points in lines.items() if len(points) > 1})
        ]

    def trainings(self) -> list[Table]:
        """Return the table of trainings that differ in their seed alone, if there are such."""
        of: dict[tuple[str, str, str, int], list[EvaluationPart]] = {}
        for each in self.evaluations:
            if each.at is None and each.demonstrations is not None:
                said = (each.label, each.task, _played(each), each.demonstrations)
                of.setdefault(said, []).append(each)
        lines = [
            (*said, *_spread([self.rate(each) for each in trained]))
            for said, trained in of.items()
            if len(trained) > 1
        ]
        head = ("Policy", "Task", "Condition", "Demonstrations", "Successes of each", "mean", "sd")
        note = (
            "Of each training, the recipe's seed first. Mean of the rates in per cent, sd: their "
            "standard deviation in percentage points. All play the same episodes."
        )
        title = "Trainings that differ in their seed"
        return [Table(title, head, (*lines,), note)] if lines else []

    def controls(self) -> list[Table]:
        """Return the table of what is compared with what differs from it in one thing, if any is.

        The difference is what the change makes.
        """
        partners = {
            each: other
            for each in self.final
            for other in self.final
            if (each.control, *_same(each)) == (other.label, *_same(other))
        }
        pairs = {
            each: comparison
            for each, usual in partners.items()
            if (comparison := self._controlled(each, usual)) is not None
        }
        p_values = holm([comparison.p_value for comparison in pairs.values()])
        compared = {
            each: replace(comparison, p_value_holm=p)
            for (each, comparison), p in zip(pairs.items(), p_values, strict=True)
        }
        lines = tuple(
            (each.label, each.control, each.task, _played(each))
            + (
                compared[each].cells
                if each in compared
                else (self.rate(each), self.rate(usual), *self._why_not(each, usual))
            )
            for each, usual in partners.items()
        )
        head = ("Changed", "Usual", "Task", "Condition", "changed", "usual", *NUMBERS)
        note = explanation(compared.values())
        return [Table("Controls", head, lines, note)] if lines else []

    def _why_not(self, changed: EvaluationPart, usual: EvaluationPart) -> list[str]:
        """Return what stands where two are not compared."""
        measured = changed in self.results and usual in self.results
        return [_OTHER_EPISODES if measured else UNKNOWN] * len(NUMBERS)

    def _controlled(self, changed: EvaluationPart, usual: EvaluationPart) -> Comparison | None:
        """Return what a change makes, or None if one is not measured or was another scene."""
        if changed not in self.results or usual not in self.results:
            return None
        try:
            return compare_controlled(self.results[changed], self.results[usual])
        except NoCommonEpisodesError:
            return None

    def _comparisons(self) -> list[Table]:
        """Every two learned policies on common seeds, but those that are among the controls."""
        controlled = {frozenset((each.label, each.control)) for each in self.final}
        of: dict[str, list[LoadedResult]] = {}
        for each in self.final:
            if each in self.results and each.policy not in REFERENCES:
                of.setdefault(each.label, []).append(self.results[each])
        tables = []
        for first, second in combinations(of, 2):
            if {first, second} in controlled:
                continue
            try:
                compared = compare(of[first], of[second])
            except NoCommonEpisodesError as error:
                tables.append(Table(f"{first} and {second}", ("Not compared",), ((str(error),),)))
                continue
            tables.append(comparison_table(compared, (first, second)))
        return tables


def missing_table(missing: Mapping[str, str]) -> Table:
    """Return the table of parts that are not done, and why."""
    lines = tuple((name, reason.replace("\n", " ")) for name, reason in missing.items())
    return Table("Not done", ("Part", "Reason"), lines)


def kept_results(folder: Path, evaluations: Sequence[EvaluationPart]) -> Measured:
    """Return what is kept of evaluations in another folder, laid out as that of the experiment."""
    moved = {each: folder / each.place.relative_to(each.out / "eval") for each in evaluations}
    there = {e: load_results(place)[0] for e, place in moved.items() if place.exists()}
    return Measured(tuple(evaluations), there)


def _spread(rates: Sequence[Cell]) -> tuple[str, str, str]:
    """Return successes of each training, and mean and standard deviation of what is measured."""
    known = [rate for rate in rates if isinstance(rate, Rate)]
    each = ", ".join(str(rate.count) if isinstance(rate, Rate) else UNKNOWN for rate in rates)
    percents = [rate.percent for rate in known]
    return (
        f"{each} of {known[0].n}" if known else UNKNOWN,
        f"{mean(percents):.1f}" if known else UNKNOWN,
        f"{stdev(percents):.1f}" if len(known) > 1 else UNKNOWN,
    )


def _same(evaluation: EvaluationPart) -> tuple[str, str]:
    """Return what an evaluation has in common with what it is compared with."""
    return evaluation.task, _played(evaluation)


def _played(evaluation: EvaluationPart) -> str:
    shift = evaluation.shift
    staged = [evaluation.play] if evaluation.play != "single" else []
    return ", ".join([" ".join([shift.split, *shift.axes]), *staged])
