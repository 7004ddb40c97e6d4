"""Two results on common seeds: which policy is better, and how sure that is."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.uncertainty import anytime
from labutopia_lerobot.evaluation.uncertainty.paired import Pairs, holm
from labutopia_lerobot.evaluation.uncertainty.proportion import wilson

POOLED = "all tasks"

Condition = tuple[str, str, tuple[str, ...], str]
"""Task, split, axes and how it was played."""


class NothingCommonError(UserError):
    """Results that cannot be compared; the message says why."""


@dataclass(frozen=True)
class Comparison:
    """Two policies in one task, or in all.

    Attributes:
        task: Task id, or `POOLED`.
        condition: Split, axes and way of playing; empty of all tasks.
        pairs: Common episodes, by who succeeded.
        p_value_holm: The p-value, adjusted for the number of tasks; of all tasks as it is.
    """

    task: str
    condition: str
    pairs: Pairs
    p_value_holm: float

    @property
    def told(self) -> dict[str, Any]:
        """Everything about it, as JSON has it."""
        pairs = self.pairs
        wins = (pairs.both + pairs.first, pairs.both + pairs.second)
        return {
            "task": self.task,
            "condition": self.condition,
            "n": pairs.n,
            "successes": list(wins),
            "rates": [count / pairs.n for count in wins],
            "wilson95": [wilson(count, pairs.n) for count in wins],
            "only_first": pairs.first,
            "only_second": pairs.second,
            "difference": pairs.difference,
            "difference95": pairs.interval(),
            "p_value": pairs.p_value,
            "p_value_holm": self.p_value_holm,
            "p_value_anytime": anytime.p_value(pairs.first, pairs.second),
        }


def compare(first: Iterable[Row], second: Iterable[Row]) -> list[Comparison]:
    """Return the comparison of each common task and condition, and then of all together.

    Raises:
        NothingCommonError: If no episode is common to both, an episode occurs twice in one of
            them, or what should be the same episode was another scene.
    """
    ours, theirs = _episodes(first, "first"), _episodes(second, "second")
    common: dict[Condition, list[tuple[bool, bool]]] = {}
    for key, row in ours.items():
        other = theirs.get(key)
        if other is not None:
            _require_same_scene(row, other)
            condition = (row.task, row.split, tuple(row.axes), row.play)
            common.setdefault(condition, []).append((row.success, other.success))
    if not common:
        raise NothingCommonError(
            f"The results have no episode in common. First: {_told(ours)}. Second: "
            f"{_told(theirs)}. Play the same tasks, splits, axes and seeds "
            "with the same robot, room and liquid"
        )
    pairs = {condition: Pairs.of(outcomes) for condition, outcomes in sorted(common.items())}
    adjusted = holm([each.p_value for each in pairs.values()])
    tasks = [
        Comparison(condition[0], _words(condition), each, p)
        for (condition, each), p in zip(pairs.items(), adjusted, strict=True)
    ]
    if len(tasks) == 1:
        return tasks
    pooled = reduce(Pairs.__add__, pairs.values())
    return [*tasks, Comparison(POOLED, "", pooled, pooled.p_value)]


def comparison_table(comparisons: Sequence[Comparison], names: tuple[str, str]) -> Table:
    """Return the comparisons as a table.

    Args:
        comparisons: What to show.
        names: What the two results are called.
    """
    lines: list[tuple[Cell, ...]] = []
    for comparison in comparisons:
        told = comparison.told
        rates = (
            Rate(count, told["n"], interval)
            for count, interval in zip(told["successes"], told["wilson95"], strict=True)
        )
        low, high = told["difference95"]
        difference = f"{100 * told['difference']:+.1f} [{100 * low:+.1f}, {100 * high:+.1f}]"
        p_values = (_p(told[name]) for name in ("p_value", "p_value_holm"))
        lines.append((comparison.task, comparison.condition, *rates, difference, *p_values))
    head = ("Task", "Condition", *names, "difference, points", "p", "p (Holm)")
    note = (
        "Common episodes only. Rates: per cent, Wilson 95 %. Difference: percentage points, score "
        "interval of Tango 1998. p: exact McNemar test; Holm: adjusted for the number of tasks."
    )
    return Table("Comparison on common seeds", head, tuple(lines), note)


def _episodes(rows: Iterable[Row], which: str) -> Mapping[tuple[Any, ...], Row]:
    """Return the rows by what tells which episode it was."""
    found: dict[tuple[Any, ...], Row] = {}
    for row in rows:
        played = (row.task, row.step, row.split, *row.axes, row.play)
        key = (*played, row.seed, row.liquid, row.robot, row.room)
        if key in found:
            raise NothingCommonError(
                f"The {which} result holds {row.task}, split {row.split}, seed {row.seed} twice, "
                f"by {found[key].policy} and {row.policy}: name a folder with one policy"
            )
        found[key] = row
    return found


def _require_same_scene(row: Row, other: Row) -> None:
    if row.drawn != other.drawn:
        raise NothingCommonError(
            f"{row.task}, split {row.split}, seed {row.seed} is not the same scene in both: "
            f"{row.drawn} and {other.drawn}. Were they played by different versions?"
        )


def _told(episodes: Mapping[tuple[Any, ...], Row]) -> str:
    tasks = sorted({f"{row.task} ({row.split})" for row in episodes.values()})
    seeds = [row.seed for row in episodes.values()]
    return f"{', '.join(tasks)}, seeds {min(seeds)} to {max(seeds)}" if seeds else "no episode"


def _words(condition: Condition) -> str:
    _, split, axes, play = condition
    return " ".join([split, *(("+".join(axes),) if axes else ()), *([play] * (play != "single"))])


def _p(value: float) -> str:
    return "< 0.0001" if value < 1e-4 else f"{value:.4f}"
