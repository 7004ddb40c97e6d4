"""The table in the terminal."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from statistics import fmean

from rich import box
from rich.table import Table

from labutopia_lerobot.evaluation.policies import REFERENCE_POLICIES
from labutopia_lerobot.evaluation.row import SINGLE
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.task import HOLD_S

_CAPTION = (
    f"Success: the goal held for {HOLD_S:g} s without a break, after every sub-step and before any "
    "breach. 95 %: {interval}. Ever: the goal held at any instant. Time: mean simulated time "
    "of the successes. Sub-steps, or the steps of a long task: reached in their order, share of "
    "all episodes."
)
_SUBSTEPS = 8
"""Sub-steps that are shown one by one; a task with more of them is told by its steps."""

_STATE_MARK = ", state"
_EMPTY_MARK = ", liquid=off"
_STATE_CAPTION = " State: the policy is told the poses of all things and sees no pictures."
_EMPTY_CAPTION = " Liquid=off: vessels are empty, pouring and spilling are told from tilts."
_MEAN_CAPTION = " Mean: each task of the level counts the same."


def summary_table(
    summaries: Sequence[Summary], *, level_means: bool, anytime: bool = False
) -> Table:
    """Return a table with a line per task, split, policy and way of playing; it fits 80 columns.

    What all lines have in common, such as the policy or the split, stands in the title.

    Args:
        summaries: What to show, ordered by task.
        level_means: Whether a line per level, and each of these, follows its tasks.
        anytime: Whether what was seen decided when to stop: only `anytime95` is valid then.
    """
    parts = [_part(summary) for summary in summaries]
    policies, splits, plays = (list(dict.fromkeys(words)) for words in zip(*parts, strict=True))
    varying = [len(words) > 1 for words in (policies, splits, plays)]
    state = any(_STATE_MARK in policy for policy in policies)
    empty = any(_EMPTY_MARK in policy for policy in policies)
    told = (policies[0], f"split {splits[0]}", "" if plays[0] == SINGLE else plays[0])
    common = [words for words, varies in zip(told, varying, strict=True) if words and not varies]
    interval = "Confidence sequence, valid whenever one stops" if anytime else "Wilson interval"
    notes = {_STATE_CAPTION: state, _EMPTY_CAPTION: empty, _MEAN_CAPTION: level_means}
    table = Table(
        title=", ".join(common) or None,
        caption=_CAPTION.format(interval=interval)
        + "".join(note for note, applies in notes.items() if applies),
        caption_justify="left",
        box=box.SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
    )
    for name, shown in zip(("Policy", "Split", "Played", "Task"), (*varying, True), strict=True):
        if shown:
            table.add_column(name, no_wrap=name != "Policy", overflow="fold")
    for name in ("Success", "95 %", "Ever", "Time"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("Sub-steps", overflow="fold")

    def heading(summary: Summary) -> list[str]:
        return [word for word, shown in zip(_part(summary), varying, strict=True) if shown]

    for level, of_level in groupby(summaries, key=lambda summary: summary.task.split("/")[0]):
        group = list(of_level)
        for summary in group:
            table.add_row(*heading(summary), *_cells(summary, anytime))
        if level_means:
            for first, alike in _means(group):
                table.add_row(*heading(first), *_mean_cells(level, alike))
        table.add_section()
    return table


def _part(summary: Summary) -> tuple[str, str, str]:
    """Return policy, split and way of playing."""
    return _policy(summary), summary.split, summary.play


def _means(group: Sequence[Summary]) -> Iterator[tuple[Summary, list[Summary]]]:
    """Yield the lines of every mean, and before them the one that says whose it is."""
    left = sorted(group, key=lambda line: line.liquid is None)
    while left:
        first = left[0]
        yield first, [line for line in group if _counts_with(line, first)]
        left = [line for line in left if not _counts_with(line, first)]


def _counts_with(line: Summary, first: Summary) -> bool:
    """Tell whether a mean holds both; a task without liquid counts with `liquid=off` too."""
    return _part(replace(line, liquid=line.liquid or first.liquid)) == _part(first)


def _policy(summary: Summary) -> str:
    """Return the policy's name, marked if it is told the state, or if vessels were empty."""
    privileged = summary.obs == "state" and summary.policy not in REFERENCE_POLICIES
    empty = summary.liquid == "off"
    return summary.policy + _STATE_MARK * privileged + _EMPTY_MARK * empty


def _cells(summary: Summary, anytime: bool) -> list[str]:
    low, high = (anytime and summary.anytime95) or summary.wilson95
    seconds = summary.mean_seconds_to_success
    is_long = len(summary.substep_rates) > _SUBSTEPS and summary.step_rates
    reached = (summary.step_rates if is_long else summary.substep_rates).items()
    return [
        summary.task if summary.step is None else f"{summary.task} {summary.step}",
        f"{summary.successes}/{summary.n}",
        f"{100 * low:.0f} to {_percent(high)}",
        _percent(summary.ever_rate),
        "-" if seconds is None else f"{seconds:.1f} s",
        ", ".join(f"{name} {_percent(rate)}" for name, rate in reached),
    ]


def _mean_cells(level: str, summaries: Sequence[Summary]) -> list[str]:
    return [
        f"{level}, mean",
        _percent(fmean(summary.rate for summary in summaries)),
        "",
        _percent(fmean(summary.ever_rate for summary in summaries)),
        "",
        "",
    ]


def _percent(rate: float) -> str:
    return f"{100 * rate:.0f} %"
