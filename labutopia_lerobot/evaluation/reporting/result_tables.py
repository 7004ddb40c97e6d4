"""The tables of a report: laid out as the paper's, why episodes failed, how precise they were."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby, takewhile
from statistics import fmean

from labutopia_lerobot.evaluation.condition import EXPERT, ID, OOD, SINGLE, STAGED, Condition
from labutopia_lerobot.evaluation.failure_causes import failed_in
from labutopia_lerobot.evaluation.reporting.paper import LEFT_OUT, NAMES, PaperNumber, paper_number
from labutopia_lerobot.evaluation.reporting.report_entry import ReportEntry, shifts
from labutopia_lerobot.evaluation.reporting.table import Cell, Rate, Table
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.evaluation.uncertainty.intervals import Median

_SIZES = "_sizes"
"""Suffix of the names of the tasks of the size test."""

_RATES = "Successes of episodes, per cent, 95 % interval (Wilson{})."
_ANYTIME = "; of a run with `until` the confidence sequence, which is valid whenever one stops"
_INFERRED = "Paper: as printed there; of how many episodes it does not say, its fractions imply {}."
_STRICTER = "Its judge forgives what ends an episode here: any push of the arm over 2 N."


def level_tables(entries: Sequence[ReportEntry]) -> list[Table]:
    """Return the tables of levels 1 and 2, level 3, the size test, levels 4 and 5, single steps.

    What has no row has no table, and no column.
    """
    alone = [entry for entry in entries if entry.condition.step is not None]
    whole = [entry for entry in entries if entry.condition.step is None]
    long = step_by_step(whole)
    small = [entry for entry in whole if entry.level < 3 and entry.condition.play == SINGLE]
    third = [entry for entry in whole if entry.level == 3 and entry.condition.play == SINGLE]
    sizes = [entry for entry in third if entry.task.endswith(_SIZES)]
    others = [entry for entry in third if not entry.task.endswith(_SIZES)]
    return [
        *([_by_task(small)] if small else []),
        *([_by_condition(others, "Level 3")] if others else []),
        *([_by_condition(sizes, "Size test")] if sizes else []),
        *step_tables(long),
        *([_alone(alone)] if alone else []),
    ]


def step_by_step(entries: Sequence[ReportEntry]) -> list[ReportEntry]:
    """Return those that are shown step by step: above level 3, and of tasks played staged."""
    staged = {entry.task for entry in entries if entry.condition.play == STAGED}
    return [
        entry
        for entry in entries
        if entry.condition.step is None and (entry.level > 3 or entry.task in staged)
    ]


def success(entry: ReportEntry) -> Rate:
    """Return the rate of success."""
    return entry.rate(entry.summary.successes, entry.summary.n)


def step_rates(entry: ReportEntry) -> list[Rate]:
    """Return, of every step, the share of the episodes in which it and all before it were done."""
    return [entry.rate(done, len(entry.rows)) for done in _done(entry)]


def conditional_rates(entry: ReportEntry) -> list[Rate | None]:
    """Return, of every step, the share of the episodes that had come to it in which it was done."""
    done = _done(entry)
    before = [len(entry.rows), *done]
    return [entry.rate(d, b) if b else None for d, b in zip(done, before, strict=False)]


def _done(entry: ReportEntry) -> list[int]:
    """Return in how many episodes the first step was done, the first two, and so on.

    Of some tasks the order of the steps is drawn: they count in each row's own order.
    """
    done = [steps_done(row) for row in entry.rows]
    count = max(len(row.step_times) for row in entry.rows)
    return [sum(d > k for d in done) for k in range(count)]


def steps_done(row: Row) -> int:
    """Return how many steps of an episode were done, from its first on without a gap."""
    return sum(1 for _ in takewhile(lambda time: time is not None, row.step_times.values()))


def _by_task(entries: Sequence[ReportEntry]) -> Table:
    """A line per task, a column per policy, then the paper's."""
    columns = list(dict.fromkeys((e.label, e.condition.shift) for e in entries))
    several = len(shifts(entries)) > 1
    entry_of = {(e.task, e.label, e.condition.shift): e for e in entries}
    lines = []
    for task in dict.fromkeys(entry.task for entry in entries):
        ours = [entry_of.get((task, *column)) for column in columns]
        theirs = [paper_number(task, policy) for policy in NAMES]
        lines.append(
            (task, *(None if entry is None else success(entry) for entry in ours), *theirs)
        )
    head = (
        "Task",
        *(f"{label}, {shift}" if several else label for label, shift in columns),
        *(f"paper {name}" for name in NAMES.values()),
    )
    title = " and ".join(f"level {level}" for level in sorted({e.level for e in entries}))
    return _table(title.capitalize(), head, lines, entries)


def _by_condition(entries: Sequence[ReportEntry], title: str) -> Table:
    """A line per task and policy; ID, OOD, all axes at once, and whatever else was shifted."""
    shown = shifts(entries)
    lines: list[tuple[Cell, ...]] = []
    for (task, label), group in _by(entries):
        by_shift = {entry.condition.shift: entry for entry in group}
        name = group[0].policy
        ours = [success(by_shift[c]) if c in by_shift else None for c in shown]
        lines.append((task, label, *ours, *(paper_number(task, name, c) for c in (ID, OOD))))
    head = ("Task", "Policy", *shown, f"paper {ID}", f"paper {OOD}")
    return _table(title, head, lines, entries)


def step_tables(entries: Sequence[ReportEntry], *, brief: bool = False) -> list[Table]:
    """Return a table per task, laid out as the paper's Table 5: SP, then a column per step.

    Its lines are S1 to Sk of one policy for everything, A1 to Ak of a policy per step, and the
    paper's numbers.

    Args:
        entries: Evaluations, ordered by task.
        brief: Whether it is for a terminal, of one policy: per cent only, and no line with each
            step given the one before.
    """
    tables = [
        _step_table(list(of_task), brief)
        for _, of_task in groupby(entries, key=lambda entry: entry.task)
    ]
    if tables:
        tables[-1] = replace(tables[-1], note=_step_note(entries, tables))
    return tables


def _step_table(entries: Sequence[ReportEntry], brief: bool) -> Table:
    """Return the table of one task."""
    names = _step_names(entries)
    several = len(shifts(entries)) > 1
    lines: list[tuple[Cell, ...]] = []
    for (_, label), group in _by(entries):
        who = () if brief else (label,)
        for entry in group:
            staged = entry.condition.play == STAGED
            where = f", {entry.condition.shift}" if several else ""
            steps = _padded(step_rates(entry), len(names))
            first = None if staged else success(entry)
            lines.append((*who, "SA"[staged] + where, first, *steps))
            if not brief:
                given = _padded(conditional_rates(entry), len(names))
                lines.append((*who, f"{'SA'[staged]} given the one before{where}", None, *given))
        theirs = [
            paper_number(entries[0].task, group[0].policy, ID, STAGED, step + 1)
            for step in range(len(names))
        ]
        if any(theirs):
            name = NAMES[group[0].policy]
            whole = paper_number(entries[0].task, group[0].policy)
            lines.append((*who, f"paper {name}", whole, *theirs))
    head = (*([] if brief else ["Policy"]), "" if brief else "Played", "SP", *names)
    title = f"Level {entries[0].level}: {entries[0].task.partition('/')[2]}"
    return Table(title, head, tuple(lines), brief=brief).without_empty_columns()


def _step_names(entries: Sequence[ReportEntry]) -> list[str]:
    """Return what the columns of steps are called: `1 pick`; `1` where the order is drawn."""
    orders = {tuple(row.step_times) for entry in entries for row in entry.rows}
    longest = max(orders, key=len)
    if len(orders) > 1:
        return [str(k) for k in range(1, len(longest) + 1)]
    return [f"{k} {name.lstrip('0123456789_')}" for k, name in enumerate(longest, start=1)]


def _step_note(entries: Sequence[ReportEntry], tables: Sequence[Table]) -> str:
    """Return what a reader has to know of the tables of steps."""
    cells = [cell for table in tables for line in table.lines for cell in line]
    rates = [cell for cell in cells if isinstance(cell, Rate)]
    intervals = [rate.interval for rate in rates]
    widest = max((100 * (high - low) for low, high in intervals), default=0.0)
    sequential = any(entry.sequential for entry in entries)
    drawn = any(len({tuple(row.step_times) for row in entry.rows}) > 1 for entry in entries)
    brief = any(table.brief for table in tables)
    staged = any(entry.condition.play == STAGED for entry in entries)
    parts = {
        "Per cent of all episodes. SP: one policy, the whole task. S1 to Sk: one policy, that step "
        "and all before it done.": True,
        "A1 to Ak: the same with a policy per step.": staged,
        "A1 to Ak, with a policy per step, take play=both.": brief and not staged,
        "Given the one before: of the episodes that came to it.": not brief,
        "Where the order of steps is drawn, the first k of each episode's own.": drawn,
        f"95 % intervals ({'confidence sequences' if sequential else 'Wilson'}) are up to "
        f"{widest:.0f} points wide.": brief,
        _RATES.format(_ANYTIME if sequential else ""): not brief,
    }
    implied = _implied(cells)
    shown = [part for part, applies in parts.items() if applies]
    return " ".join([*shown, *([implied, LEFT_OUT, _STRICTER] if implied else [])])


def _alone(entries: Sequence[ReportEntry]) -> Table:
    """A line per step that was played alone."""
    lines: list[tuple[Cell, ...]] = [
        (e.task, e.label, e.condition.shift, str(e.condition.step), success(e)) for e in entries
    ]
    note = " Every episode begins where the expert has done the steps before."
    head = ("Task", "Policy", "Condition", "Step", "done")
    return _table("Steps played alone", head, lines, entries, note)


def _by(entries: Iterable[ReportEntry]) -> Iterator[tuple[tuple[str, str], list[ReportEntry]]]:
    for heading, group in groupby(entries, key=lambda entry: (entry.task, entry.label)):
        yield heading, list(group)


def _padded(steps: Sequence[Rate | None], count: int) -> list[Rate | None]:
    return [*steps, *[None] * (count - len(steps))]


def _table(
    title: str,
    head: tuple[str, ...],
    lines: Sequence[tuple[Cell, ...]],
    entries: Sequence[ReportEntry],
    note: str = "",
) -> Table:
    sequential = any(entry.sequential for entry in entries)
    cells = [cell for line in lines for cell in line]
    about = _RATES.format(_ANYTIME if sequential else "") + note
    full = " ".join(filter(None, (about, _implied(cells))))
    return Table(title, head, tuple(lines), full).without_empty_columns()


def _implied(cells: Iterable[Cell]) -> str:
    """Return of how many episodes the paper's numbers are, if there are any."""
    counts = sorted({cell.n for cell in cells if isinstance(cell, PaperNumber)})
    if not counts:
        return ""
    about = "about " if 300 in counts else ""  # not all of level 4 are fractions of one number
    return _INFERRED.format(about + " or ".join(map(str, counts)))


Failures = Counter[tuple[str, str]]
"""Step and cause -> number of episodes."""


def failures(entry: ReportEntry) -> Failures:
    """Count failed episodes by the step in which they failed and by their cause."""
    return Counter((failed_in(row), cause_in_words(row)) for row in entry.rows if not row.success)


def cause_in_words(row: Row) -> str:
    """Return the one cause of a failure; of rows of earlier versions, the outcome."""
    return row.cause or row.outcome.replace("_", " ")


def failure_table(entries: Sequence[ReportEntry]) -> Table:
    """Return one line per cause of failure, with its share of the failures."""
    lines: list[tuple[Cell, ...]] = []
    for entry in entries:
        counts = failures(entry)
        for (step, cause), count in counts.most_common():
            share = entry.rate(count, counts.total())
            lines.append((entry.task, entry.label, entry.condition.played, step, cause, share))
    head = ("Task", "Policy", "Condition", "Failed in", "Cause", "Of the failures")
    note = "Every failed episode has one cause. Failed in: the first step that was not done."
    return Table("Failures", head, tuple(lines), note)


def precision_table(entries: Sequence[ReportEntry]) -> Table:
    """Return medians of what was measured, of the successes and of all episodes."""
    pace = expert_seconds(entries)
    lines: list[tuple[Cell, ...]] = []
    for entry in entries:
        for whose, rows in (
            ("successes", [row for row in entry.rows if row.success]),
            ("all", list(entry.rows)),
        ):
            measured: list[Cell] = [
                *(_median(of, rows) for of in (*_MEASURES.values(), _over(pace, entry))),
                _touched(entry, rows),
                _spl(rows),
            ]
            if any(cell is not None for cell in measured):
                lines.append((entry.task, entry.label, entry.condition.played, whose, *measured))
    head = (
        "Task",
        "Policy",
        "Condition",
        "Episodes",
        *_MEASURES,
        "s over the expert",
        "unwanted contact",
        "SPL",
    )
    note = (
        "Medians with 95 % intervals (order statistics), of the worst of each episode: millilitres "
        "that are not where they should be, millimetres and degrees from the place at the end, "
        "seconds over the expert's with the same seed. Unwanted contact: episodes in which the arm "
        "touched anything, or the hand the bench, a housing or a distractor."
    )
    if any(row.driving is not None for entry in entries for row in entry.rows):
        note += (
            " Of a robot that drives: what was spilled in all, its way over the shortest one, how "
            "near its footprint came to things on the map, how far it stood at the end from where "
            "it should dock, and SPL, the mean success weighted by path length."
        )
    if any(entry.sequential for entry in entries):
        note += " Intervals of medians are those of a number of episodes fixed beforehand."
    return Table("Precision", head, tuple(lines), note).without_empty_columns()


def expert_seconds(entries: Iterable[ReportEntry]) -> Mapping[tuple[Condition, int], float]:
    """Return how long the expert took for each scene in which it succeeded [s]."""
    return {
        row.scene: row.seconds
        for entry in entries
        for row in entry.rows
        if row.policy == EXPERT and row.success
    }


_MEASURES: dict[str, Callable[[Row], float | None]] = {
    "ml off target": lambda row: row.ml_off_target,
    "mm off place": lambda row: row.mm_off_place,
    "deg off place": lambda row: row.deg_off_place,
    "ml spilled on the way": lambda row: None if row.driving is None else row.ml_spilled,
    "shortest ways driven": lambda row: _ways(row),
    "mm from things": lambda row: _driven(row, "m_gap", 1e3),
    "mm off dock": lambda row: _driven(row, "m_off_dock", 1e3),
    "deg off dock": lambda row: _driven(row, "deg_off_dock"),
}


def _driven(row: Row, name: str, times: float = 1.0) -> float | None:
    """Return a number of the driving, or None where nobody drives or it is not known."""
    number = None if row.driving is None else row.driving.get(name)
    return None if number is None else times * number


def _ways(row: Row) -> float | None:
    """Return how long the way was that it drove, as a multiple of the shortest."""
    driven, shortest = _driven(row, "m_driven"), _driven(row, "m_shortest")
    return driven / shortest if driven is not None and shortest else None


def _spl(rows: Iterable[Row]) -> str | None:
    shares = [share for row in rows if (share := _driven(row, "spl")) is not None]
    return f"{fmean(shares):.3f}" if shares else None


def _over(
    pace: Mapping[tuple[Condition, int], float], entry: ReportEntry
) -> Callable[[Row], float | None]:
    """Return the wording for the seconds that an episode took over the expert's."""
    if entry.policy == EXPERT:
        return lambda row: None
    return lambda row: row.seconds - pace[row.scene] if row.scene in pace else None


def _median(of: Callable[[Row], float | None], rows: Iterable[Row]) -> Median | None:
    return Median.of([value for value in map(of, rows) if value is not None])


def _touched(entry: ReportEntry, rows: Sequence[Row]) -> Rate | None:
    contacts = [row.unwanted_contacts for row in rows if row.unwanted_contacts is not None]
    return entry.rate(sum(map(bool, contacts)), len(contacts)) if contacts else None
