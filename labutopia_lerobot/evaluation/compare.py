"""Two results on common seeds: which policy is better, and how sure that is."""

import hashlib
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import reduce
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import Condition, differ_in_task_only
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.evaluation.uncertainty import anytime
from labutopia_lerobot.evaluation.uncertainty.intervals import Interval, wilson
from labutopia_lerobot.evaluation.uncertainty.paired import PairedOutcomes, holm


class NoCommonEpisodesError(UserError):
    """Results that cannot be compared; the message says what each of them holds."""


@dataclass(frozen=True)
class PlayedEpisodes:
    """Episodes that one policy played.

    Attributes:
        rows: Condition without what only the observer sees -> seed -> row.
        sequential: Those of these conditions whose run could stop early by its outcomes (`until`).
    """

    rows: Mapping[Condition, Mapping[int, Row]]
    sequential: frozenset[Condition]

    def __str__(self) -> str:
        """Return every condition with its seeds."""
        listed = (
            f"{condition.description}, {_seeds(sorted(rows))}"
            for condition, rows in self.rows.items()
        )
        return "; ".join(listed) or "no episode"

    @property
    def sha256(self) -> str:
        """Hash of all rows, in hexadecimal digits."""
        rows = [asdict(row) for of_one in self.rows.values() for row in of_one.values()]
        return hashlib.sha256(json.dumps(rows, sort_keys=True).encode()).hexdigest()


def _seeds(seeds: Sequence[int]) -> str:
    """Return which seeds there are, in increasing order, in words."""
    first, last = seeds[0], seeds[-1]
    if first == last:
        return f"seed {first}"
    whole = len(seeds) == last - first + 1
    return f"seeds {first} to {last}" + ("" if whole else f" ({len(seeds)} of them)")


def played_episodes(results: Sequence[LoadedResult]) -> PlayedEpisodes:
    """Return the episodes of results by condition and seed.

    Raises:
        NoCommonEpisodesError: If one condition is in two results or was played by two policies, or
            an episode occurs twice.
    """
    rows: dict[Condition, dict[int, Row]] = {}
    of: dict[Condition, tuple[str, str]] = {}
    for result in results:
        for row in result.rows:
            scene, seed = row.scene
            by = row.policy, str(result.place)
            first = of.setdefault(scene, by)
            if by != first or seed in rows.setdefault(scene, {}):
                raise NoCommonEpisodesError(
                    f"{scene.description}, seed {seed}, is there twice: by {first[0]} in "
                    f"{first[1]} and by {by[0]} in {by[1]}. Name the folder of one of them"
                )
            rows[scene][seed] = row
    sequential = (r.scene[0] for result in results if result.sequential for r in result.rows)
    return PlayedEpisodes(rows, frozenset(sequential))


def require_same_scene(row: Row, other: Row) -> None:
    """Make sure that an episode was drawn alike for both.

    Raises:
        NoCommonEpisodesError: If it was not.
    """
    if row.drawn != other.drawn:
        raise NoCommonEpisodesError(
            f"{row.condition.description}, seed {row.seed}, is not the same scene in both: "
            f"{row.drawn} and {other.drawn}. Were they played by different versions?"
        )


def common_outcomes(
    first: Mapping[int, Row], second: Mapping[int, Row]
) -> Iterable[tuple[bool, bool]]:
    """Yield who succeeded in each common episode of one condition.

    Raises:
        NoCommonEpisodesError: If an episode was not drawn alike for both.
    """
    for seed in sorted(first.keys() & second.keys()):
        require_same_scene(first[seed], second[seed])
        yield first[seed].success, second[seed].success


POOLED = "all tasks"


@dataclass(frozen=True)
class Comparison:
    """Two policies under one condition, or over all tasks.

    Attributes:
        condition: What both played, without what only they saw; None over all tasks.
        pairs: Common episodes, by who succeeded.
        sequential: Whether one of the runs could stop early by its outcomes: then the number of
            episodes says something of the outcome, and only what is valid anytime is given.
        p_value_holm: Its p-value, adjusted for the number of conditions that are listed; over all
            tasks as it is.
    """

    condition: Condition | None
    pairs: PairedOutcomes
    sequential: bool
    p_value_holm: float = math.nan

    @property
    def task(self) -> str:
        """Task id, or `POOLED`."""
        return POOLED if self.condition is None else self.condition.task

    @property
    def p_value(self) -> float:
        """P-value under equal policies; valid for how the number of episodes came about."""
        pairs = self.pairs
        return anytime.p_value(pairs.first, pairs.second) if self.sequential else pairs.p_value

    @property
    def rates(self) -> tuple[Rate, Rate]:
        """Successes of both policies."""
        pairs = self.pairs
        return self._rate(pairs.both + pairs.first), self._rate(pairs.both + pairs.second)

    @property
    def interval(self) -> Interval:
        """Confidence interval of the difference of the rates, 95 %."""
        pairs = self.pairs
        if self.sequential:
            return anytime.difference_sequence(pairs.first, pairs.second, pairs.n)
        return pairs.interval()

    @property
    def cells(self) -> tuple[Cell, ...]:
        """What tables show of it: both rates, and `NUMBERS`."""
        low, high = self.interval
        difference = f"{100 * self.pairs.difference:+.1f} [{100 * low:+.1f}, {100 * high:+.1f}]"
        return (*self.rates, difference, _p(self.p_value), _p(self.p_value_holm))

    @property
    def columns(self) -> dict[str, Any]:
        """Everything about it, as JSON has it."""
        pairs = self.pairs
        return {
            "task": self.task,
            "condition": None if self.condition is None else asdict(self.condition),
            "n": pairs.n,
            "successes": [rate.count for rate in self.rates],
            "rates": [rate.count / pairs.n for rate in self.rates],
            "rates95": [rate.interval for rate in self.rates],
            "only_first": pairs.first,
            "only_second": pairs.second,
            "difference": pairs.difference,
            "difference95": self.interval,
            "sequential": self.sequential,
            "p_value": self.p_value,
            "p_value_holm": self.p_value_holm,
            "p_value_anytime": anytime.p_value(pairs.first, pairs.second),
        }

    def _rate(self, count: int) -> Rate:
        n = self.pairs.n
        if self.sequential:
            low, high = anytime.confidence_sequence(count, n)
            return Rate(count, n, (float(low), float(high)))
        return Rate(count, n, wilson(count, n))


def compare(first: Sequence[LoadedResult], second: Sequence[LoadedResult]) -> list[Comparison]:
    """Return the comparison under each common condition, and of all tasks together.

    All tasks are pooled where the conditions differ in nothing else, and every number of
    episodes was fixed beforehand.

    Raises:
        NoCommonEpisodesError: If no episode is common to both, one of them holds a condition twice,
            or what should be the same episode was another scene.
    """
    ours, theirs = played_episodes(first), played_episodes(second)
    sequential = ours.sequential | theirs.sequential
    comparisons = []
    for condition in sorted(ours.rows.keys() & theirs.rows.keys(), key=lambda c: c.description):
        pairs = PairedOutcomes.of(common_outcomes(ours.rows[condition], theirs.rows[condition]))
        if pairs.n:
            comparisons.append(Comparison(condition, pairs, condition in sequential))
    if not comparisons:
        raise NoCommonEpisodesError(
            f"The results have no episode in common. First: {ours}. Second: {theirs}. Play the "
            "same tasks, splits, axes, steps and seeds with the same robot, room and liquid"
        )
    return adjusted(comparisons)


def compare_controlled(changed: LoadedResult, usual: LoadedResult) -> Comparison:
    """Return the comparison of two results, seed by seed, whose conditions differ on purpose.

    Args:
        changed: What differs in one thing, such as in how many particles the liquid is divided.
        usual: What it is compared with, and whose condition the comparison has.

    Raises:
        NoCommonEpisodesError: If they have no episode in common, one of them holds several
            conditions, or what should be the same episode was another scene.
    """
    ours, theirs = played_episodes([changed]), played_episodes([usual])
    if len(ours.rows) == len(theirs.rows) == 1:
        ((_, mine),), ((condition, others),) = ours.rows.items(), theirs.rows.items()
        pairs = PairedOutcomes.of(common_outcomes(mine, others))
        if pairs.n:
            return Comparison(condition, pairs, bool(ours.sequential | theirs.sequential))
    raise NoCommonEpisodesError(
        f"These are not one condition each with common seeds. First: {ours}. Second: {theirs}"
    )


def adjusted(comparisons: Sequence[Comparison]) -> list[Comparison]:
    """Return comparisons with p-values adjusted for how many there are, and all tasks pooled."""
    p_values = holm([comparison.p_value for comparison in comparisons])
    lines = [replace(each, p_value_holm=p) for each, p in zip(comparisons, p_values, strict=True)]
    conditions = [each.condition for each in comparisons if each.condition is not None]
    fixed = not any(comparison.sequential for comparison in comparisons)
    if len(comparisons) == 1 or not fixed or not differ_in_task_only(conditions):
        return lines
    pairs = reduce(PairedOutcomes.__add__, (each.pairs for each in comparisons))
    pooled = Comparison(None, pairs, False)
    return [*lines, replace(pooled, p_value_holm=pooled.p_value)]


def comparison_table(comparisons: Sequence[Comparison], names: tuple[str, str]) -> Table:
    """Return the comparisons as a table.

    Args:
        comparisons: What to show.
        names: What the two results are called.
    """
    lines: list[tuple[Cell, ...]] = []
    for each in comparisons:
        condition = "" if each.condition is None else each.condition.without_task()
        lines.append((each.task, condition, *each.cells))
    head = ("Task", "Condition", *names, *NUMBERS)
    title = " and ".join(names) + " on common seeds"
    return Table(title, head, tuple(lines), explanation(comparisons))


NUMBERS = ("difference, points", "p", "p (Holm)")
"""Heads of the numbers of comparisons behind the rates."""


def explanation(comparisons: Iterable[Comparison]) -> str:
    """Return what is to be known of the numbers of comparisons."""
    kinds = {each.sequential for each in comparisons}
    return " ".join(
        [
            "Common episodes only. Rates in per cent; differences, the first less the second, in "
            "percentage points.",
            *[_FIXED] * (False in kinds),
            *[_SEQUENTIAL] * (True in kinds),
            "Holm: adjusted for the number of conditions.",
        ]
    )


_FIXED = "95 %: Wilson, of differences the score interval of Tango 1998; p: exact McNemar test."
_SEQUENTIAL = (
    "Of runs with `until`: confidence sequences and p-values that are valid whenever one stops."
)


def _p(value: float) -> str:
    return "< 0.0001" if value < 1e-4 else f"{value:.4f}"
