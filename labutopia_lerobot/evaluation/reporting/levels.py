"""The result tables, laid out as the paper's: by level, made of rows only."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from labutopia_lerobot.evaluation.reporting.entry import ID, OOD, Entry, conditions
from labutopia_lerobot.evaluation.reporting.paper import NAMES, Printed, printed
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.evaluation.row import SINGLE, STAGED
from labutopia_lerobot.evaluation.uncertainty.proportion import wilson

_SIZES = "_sizes"
"""How the names of the tasks of the size test end."""

_RATES = "Successes of episodes, per cent, 95 % interval (Wilson{})."
_ANYTIME = "; of a run with `until` the confidence sequence, which is valid whenever one stops"
_INFERRED = (
    " Paper: as printed there; it does not tell of how many episodes, its fractions imply {}."
)


def level_tables(entries: Sequence[Entry]) -> list[Table]:
    """Return the tables of levels 1 and 2, level 3, the size test, levels 4 and 5, single steps.

    What has no row has no table, and no column. A task that was played staged, or whose level is
    above 3, is told step by step.
    """
    alone = [entry for entry in entries if entry.step is not None]
    whole = [entry for entry in entries if entry.step is None]
    staged = {entry.task for entry in whole if entry.play == STAGED}
    long = [entry for entry in whole if entry.level > 3 or entry.task in staged]
    small = [entry for entry in whole if entry.level < 3 and entry.play == SINGLE]
    third = [entry for entry in whole if entry.level == 3 and entry.play == SINGLE]
    sizes = [entry for entry in third if entry.task.endswith(_SIZES)]
    others = [entry for entry in third if not entry.task.endswith(_SIZES)]
    return [
        *([_by_task(small)] if small else []),
        *([_by_condition(others, "Level 3")] if others else []),
        *([_by_condition(sizes, "Size test")] if sizes else []),
        *([step_table(long)] if long else []),
        *([_alone(alone)] if alone else []),
    ]


def success(entry: Entry) -> Rate:
    """Return the rate of success."""
    summary = entry.summary
    return Rate(summary.successes, summary.n, entry.interval)


def step_rates(entry: Entry) -> list[Rate]:
    """Return, of every step, the share of the episodes in which it and all before it were done."""
    return [_rate(done, len(entry.rows)) for done in _done(entry)]


def conditional_rates(entry: Entry) -> list[Rate | None]:
    """Return, of every step, the share of the episodes that had come to it in which it was done."""
    done = _done(entry)
    before = [len(entry.rows), *done]
    return [_rate(d, b) if b else None for d, b in zip(done, before, strict=False)]


def _done(entry: Entry) -> list[int]:
    """Return in how many episodes each step was done."""
    names = entry.rows[0].step_times
    return [sum(row.step_times.get(name) is not None for row in entry.rows) for name in names]


def _rate(count: int, n: int) -> Rate:
    return Rate(count, n, wilson(count, n))


def _by_task(entries: Sequence[Entry]) -> Table:
    """A line per task, a column per policy, then the paper's."""
    columns = list(dict.fromkeys((entry.policy, entry.condition) for entry in entries))
    several = len(conditions(entries)) > 1
    found = {(entry.task, entry.policy, entry.condition): entry for entry in entries}
    lines = []
    for task in dict.fromkeys(entry.task for entry in entries):
        ours = [found.get((task, *column)) for column in columns]
        theirs = [printed(task, policy) for policy in NAMES]
        lines.append(
            (task, *(None if entry is None else success(entry) for entry in ours), *theirs)
        )
    head = (
        "Task",
        *(f"{policy}, {shown}" if several else policy for policy, shown in columns),
        *(f"paper {name}" for name in NAMES.values()),
    )
    title = " and ".join(f"level {level}" for level in sorted({e.level for e in entries}))
    return _table(title.capitalize(), head, lines, entries)


def _by_condition(entries: Sequence[Entry], title: str) -> Table:
    """A line per task and policy; ID, OOD, all axes at once, and whatever else was shifted."""
    shown = conditions(entries)
    lines: list[tuple[Cell, ...]] = []
    for (task, policy), group in _by(entries):
        found = {entry.condition: entry for entry in group}
        name = group[0].rows[0].policy
        ours = [success(found[c]) if c in found else None for c in shown]
        lines.append((task, policy, *ours, *(printed(task, name, c) for c in (ID, OOD))))
    head = ("Task", "Policy", *shown, f"paper {ID}", f"paper {OOD}")
    return _table(title, head, lines, entries)


def step_table(entries: Sequence[Entry]) -> Table:
    """Return, per task and policy, SP, S1..Sk and A1..Ak, and each step given the one before."""
    count = max(len(entry.rows[0].step_times) for entry in entries)
    several = len(conditions(entries)) > 1
    lines: list[tuple[Cell, ...]] = []
    for (task, policy), group in _by(entries):
        for entry in group:
            letter, whole = ("A", None) if entry.play == STAGED else ("S", success(entry))
            where = f", {entry.condition}" if several else ""
            for how, first, steps in (
                (f"{letter}{where}", whole, step_rates(entry)),
                (f"{letter} given the one before{where}", None, conditional_rates(entry)),
            ):
                lines.append((task, policy, how, first, *_padded(steps, count)))
        name = group[0].rows[0].policy
        theirs = [printed(task, name, ID, STAGED, step) for step in range(1, count + 1)]
        if any(theirs):
            lines.append((task, policy, "paper: A", printed(task, name), *theirs))
    head = ("Task", "Policy", "Played", "SP", *(str(step + 1) for step in range(count)))
    note = (
        " SP: one policy plays everything. S1 to Sk: it and all steps before were done. A1 to Ak: "
        "the same with a policy per step. Given the one before: of the episodes that came to it."
    )
    levels = sorted({entry.level for entry in entries})
    title = " and ".join(f"level {level}" for level in levels).capitalize()
    return _table(title, head, lines, entries, note)


def _alone(entries: Sequence[Entry]) -> Table:
    """A line per step that was played alone."""
    lines: list[tuple[Cell, ...]] = [
        (entry.task, entry.policy, entry.condition, str(entry.step), success(entry))
        for entry in entries
    ]
    note = " Every episode begins where the expert has done the steps before."
    head = ("Task", "Policy", "Condition", "Step", "done")
    return _table("Steps played alone", head, lines, entries, note)


def _by(entries: Iterable[Entry]) -> Iterator[tuple[tuple[str, str], list[Entry]]]:
    for heading, group in groupby(entries, key=lambda entry: (entry.task, entry.policy)):
        yield heading, list(group)


def _padded(steps: Sequence[Rate | None], count: int) -> list[Rate | None]:
    return [*steps, *[None] * (count - len(steps))]


def _table(
    title: str,
    head: tuple[str, ...],
    lines: Sequence[tuple[Cell, ...]],
    entries: Sequence[Entry],
    note: str = "",
) -> Table:
    sequential = any(entry.sequential for entry in entries)
    implied = sorted({cell.n for line in lines for cell in line if isinstance(cell, Printed)})
    about = "about " if 300 in implied else ""  # not all of level 4 are fractions of one number
    inferred = _INFERRED.format(about + " or ".join(map(str, implied))) if implied else ""
    told = _RATES.format(_ANYTIME if sequential else "") + note + inferred
    return Table(title, head, tuple(lines), told).without_empty_columns()
