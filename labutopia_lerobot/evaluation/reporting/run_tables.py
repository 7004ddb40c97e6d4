"""Tables that a run prints: a line per task, or its steps; the cost of a wanted precision."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from statistics import fmean

from labutopia_lerobot.evaluation.condition import SINGLE, STAGED
from labutopia_lerobot.evaluation.reporting.report_entry import ReportEntry
from labutopia_lerobot.evaluation.reporting.result_tables import step_by_step, step_tables, success
from labutopia_lerobot.evaluation.reporting.table import Cell, Table
from labutopia_lerobot.evaluation.uncertainty.intervals import (
    MOST_EPISODES,
    PrecisionError,
    anytime_episodes_for,
    episodes_for,
    require_precision,
)
from labutopia_lerobot.task import HOLD_S

_NOTE = (
    f"Success: the goal held for {HOLD_S:g} s without a break, after every substep and before any "
    "breach; per cent [95 %: {interval}]. Ever: the goal held at any instant. Time: mean simulated "
    "time of the successes. Substeps: reached in their order, of all episodes."
)
_STATE = "State: the policy is given the poses of all things and sees no pictures."
_EMPTY = "Liquid=off: vessels are empty, pouring and spilling are judged by tilts."
_MEAN = "Mean: each task counts the same."


def run_tables(entries: Sequence[ReportEntry], *, level_means: bool) -> list[Table]:
    """Return what a run reports: tables of tasks by their substeps, and a table per long task.

    Args:
        entries: What it played, ordered by task.
        level_means: Whether the mean over each level is shown too.
    """
    tables: list[Table] = []
    groups: dict[str, list[ReportEntry]] = {}
    for entry in entries:
        groups.setdefault(_title(entry, entries), []).append(entry)
    for title, group in groups.items():
        long = step_by_step(group)
        short = [entry for entry in group if entry not in long]
        if short:
            tables.append(_by_task(title, short, level_means))
        if long:
            tables += _by_step(title, long, level_means)
    notes = [table.note for table in tables]
    return [
        replace(table, note="") if table.note in notes[i + 1 :] else table
        for i, table in enumerate(tables)
    ]


def _title(entry: ReportEntry, entries: Sequence[ReportEntry]) -> str:
    """Return the policy and the condition, as far as the task and the way of playing leave it."""
    played = replace(entry.condition, play=SINGLE)
    if played.liquid is None:  # a task without liquid was played with the same options
        filled = (other.condition for other in entries if other.condition.liquid is not None)
        like = next(filled, played)
        filled_as = {name: getattr(like, name) for name in ("liquid", "particles", "reasoner")}
        played = replace(played, **filled_as)
    return f"{entry.policy}, {played.without_task(entry.policy)}"


def _by_task(title: str, entries: Sequence[ReportEntry], level_means: bool) -> Table:
    """Return a line per task, with its substeps."""
    lines: list[tuple[Cell, ...]] = []
    for entry in entries:
        summary = entry.summary
        seconds = summary.mean_seconds_to_success
        substeps = (f"{name} {_percent(rate)}" for name, rate in summary.substep_rates.items())
        lines.append(
            (
                entry.task,
                success(entry),
                _percent(summary.ever_rate),
                None if seconds is None else f"{seconds:.1f} s",
                ", ".join(substeps),
            )
        )
    for level, of_level in _levels(entries) if level_means else ():
        ever = fmean(entry.summary.ever_rate for entry in of_level)
        lines.append((f"level{level}, mean", _mean(of_level), _percent(ever), None, ""))
    sequential = any(entry.sequential for entry in entries)
    interval = "confidence sequence, valid whenever one stops" if sequential else "Wilson"
    note = [_NOTE.format(interval=interval), *_notes(entries, level_means)]
    head = ("Task", "Success", "Ever", "Time", "Substeps")
    return Table(title, head, tuple(lines), " ".join(note))


def _by_step(title: str, entries: Sequence[ReportEntry], level_means: bool) -> list[Table]:
    """Return a table per task, with its steps."""
    tables: list[Table] = []
    for table in step_tables(entries, brief=True):
        task = table.title.partition(": ")[2]
        of_task = [entry for entry in entries if entry.task.partition("/")[2] == task]
        results = "; ".join(map(_result, of_task))
        heading = f"{task}: {results}"
        tables.append(replace(table, title=heading if tables else f"{title}\n\n{heading}"))
    means = []
    for level, of_level in _levels(entries) if level_means else ():
        of = {
            play: [entry for entry in of_level if entry.condition.play == play]
            for play in (SINGLE, STAGED)
        }
        rates = ", ".join(f"{play} {_mean(group)}" for play, group in of.items() if group)
        means.append(f"Mean of level {level}: {rates}.")
    note = [*means, tables[-1].note, *_notes(entries, level_means=False)]
    tables[-1] = replace(tables[-1], note=" ".join(note))
    return tables


def _result(entry: ReportEntry) -> str:
    """Return how the whole task went, in a few words."""
    summary, rate = entry.summary, success(entry)
    low, high = rate.interval
    staged = "staged " * (entry.condition.play == STAGED)
    ever = f", ever {_percent(summary.ever_rate)}" if summary.ever_rate > summary.rate else ""
    seconds = summary.mean_seconds_to_success
    time = "" if seconds is None else f", {seconds:.1f} s"
    return f"{staged}{rate.count}/{rate.n} [{100 * low:.0f}, {100 * high:.0f}]{ever}{time}"


def _notes(entries: Sequence[ReportEntry], level_means: bool) -> list[str]:
    marks = {mark for entry in entries for mark in entry.condition.marks(entry.policy)}
    notes = {_STATE: "state" in marks, _EMPTY: "liquid=off" in marks, _MEAN: level_means}
    return [note for note, applies in notes.items() if applies]


def _levels(entries: Sequence[ReportEntry]) -> list[tuple[int, list[ReportEntry]]]:
    """Return levels with several tasks, and what was played of each."""
    levels: dict[int, list[ReportEntry]] = {}
    for entry in entries:
        levels.setdefault(entry.level, []).append(entry)
    return [item for item in levels.items() if len({entry.task for entry in item[1]}) > 1]


def _mean(entries: Sequence[ReportEntry]) -> str:
    return f"{100 * fmean(entry.summary.rate for entry in entries):.1f} %"


def _percent(rate: float) -> str:
    return f"{100 * rate:.0f} %"


_RATES = (0.5, 0.7, 0.8, 0.9, 0.95, 0.99)
"""Rates of success; of 10 % it takes as many episodes as of 90 %."""


def cost_table(half_width: float, settings: int) -> Table:
    """Return how many episodes an interval of a half width takes, by the rate of success.

    Args:
        half_width: Half of the width of the 95 % interval, such as 0.05.
        settings: Number of tasks and splits that are played.

    Raises:
        PrecisionError: If no interval of a rate can be that narrow.
    """
    require_precision(half_width)
    lines: list[tuple[Cell, ...]] = []
    for rate in _RATES:
        shared = f"{100 * rate:g} %" + (f" or {100 * (1 - rate):g} %" if rate != 0.5 else "")
        costs = [_cost(plan, half_width, rate) for plan in (episodes_for, anytime_episodes_for)]
        in_all = (c if isinstance(c, str) else c * settings for c in costs)
        lines.append((shared, *costs, *in_all))
    head = ("Successes", "episodes=", "until=", "episodes= in all", "until= in all")
    note = (
        "episodes=: a number fixed beforehand (Wilson interval); 50 % is safe whatever the rate. "
        f"until={half_width:g}: stops by itself, and pays for looking at every episode. In all: "
        f"over {settings} tasks and splits."
    )
    title = f"Episodes for a success rate to plus or minus {100 * half_width:g} points (95 %)"
    return Table(title, head, tuple(lines), note)


def _cost(plan: Callable[[float, float], int], half_width: float, rate: float) -> int | str:
    try:
        return plan(half_width, rate)
    except PrecisionError:
        return f"> {MOST_EPISODES:,}"
