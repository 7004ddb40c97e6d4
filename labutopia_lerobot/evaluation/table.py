"""The table in the terminal."""

from collections.abc import Sequence
from itertools import groupby
from statistics import fmean

from rich import box
from rich.table import Table

from labutopia_lerobot.evaluation.policies import REFERENCE_POLICIES
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.task import HOLD_S

_CAPTION = (
    f"Success: the goal held for {HOLD_S:g} s without a break, after every sub-step and before any "
    "breach. 95 %: Wilson interval. Ever: the goal held at any instant. Time: mean simulated time "
    "of the successes. Sub-steps: reached in their order, share of all episodes."
)
_STATE_CAPTION = " State: the policy is told the poses of all things and sees no pictures."
_MEAN_CAPTION = " Mean: each task of the level counts the same."


def summary_table(summaries: Sequence[Summary], level_means: bool) -> Table:
    """Return a table with a line per task, split and policy; one policy fits 80 columns.

    Args:
        summaries: What to show, ordered by task.
        level_means: Whether a line per level and split follows its tasks; of one policy only.
    """
    policies = list(dict.fromkeys(map(_policy, summaries)))
    state = any("state" in policy for policy in policies)
    table = Table(
        title=policies[0] if len(policies) == 1 else None,
        caption=_CAPTION + _STATE_CAPTION * state + _MEAN_CAPTION * level_means,
        caption_justify="left",
        box=box.SIMPLE_HEAD,
    )
    for name in ("Task", "Split") if len(policies) == 1 else ("Policy", "Task", "Split"):
        table.add_column(name, no_wrap=True)
    for name in ("Success", "95 %", "Ever", "Time"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("Sub-steps")
    for level, of_level in groupby(summaries, key=lambda summary: summary.task.split("/")[0]):
        group = list(of_level)
        for summary in group:
            policy = [] if len(policies) == 1 else [_policy(summary)]
            table.add_row(*policy, *_cells(summary))
        for split in dict.fromkeys(summary.split for summary in group) if level_means else ():
            table.add_row(*_mean_cells(level, [line for line in group if line.split == split]))
        table.add_section()
    return table


def _policy(summary: Summary) -> str:
    """Return the policy's name, marked if it was trained on privileged state."""
    privileged = summary.obs == "state" and summary.policy not in REFERENCE_POLICIES
    return f"{summary.policy}, state" if privileged else summary.policy


def _cells(summary: Summary) -> list[str]:
    low, high = summary.wilson95
    seconds = summary.mean_seconds_to_success
    return [
        summary.task,
        summary.split,
        f"{summary.successes}/{summary.n} = {_percent(summary.rate)}",
        f"{100 * low:.0f} to {_percent(high)}",
        _percent(summary.ever_rate),
        "-" if seconds is None else f"{seconds:.1f} s",
        "\n".join(f"{name} {_percent(rate)}" for name, rate in summary.substep_rates.items()),
    ]


def _mean_cells(level: str, summaries: Sequence[Summary]) -> list[str]:
    return [
        f"{level}, mean",
        summaries[0].split,
        _percent(fmean(summary.rate for summary in summaries)),
        "-",
        _percent(fmean(summary.ever_rate for summary in summaries)),
        "-",
        "-",
    ]


def _percent(rate: float) -> str:
    return f"{100 * rate:.0f} %"
