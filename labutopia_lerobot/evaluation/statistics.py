"""From rows to rates."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from statistics import fmean

from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence
from labutopia_lerobot.evaluation.uncertainty.proportion import Interval, exact, wilson


@dataclass(frozen=True)
class Summary:
    """One policy in one task and split.

    Attributes:
        task: Task id.
        split: `train`, `id` or `ood`.
        policy: What the policy is called.
        play: How sequences were played.
        obs: `pixels` or `state`.
        liquid: `on` or `off`; None for a task whose vessels are empty anyway.
        n: Episodes.
        successes: Episodes in which the goal held for as long as it must.
        rate: Share of the successes.
        wilson95: Confidence interval of the rate (see `uncertainty.proportion`).
        ever_rate: Share of the episodes in which the goal held at any instant.
        substep_rates: Sub-step -> share of the episodes in which it and all before it latched.
        mean_seconds_to_success: Mean simulated duration of the successes [s], or None.
        outcomes: Outcome -> number of episodes, the most frequent first.
        causes: Why episodes failed (see `causes`) -> number of them, the most frequent first.
        exact95: Confidence interval of Clopper and Pearson.
        anytime95: Confidence interval that stays valid whenever one stops (see `anytime`).
        step_rates: Step -> share of the episodes in which it and all before it were done.
        axes: Axes that varied, or were shifted, beside the task's own.
        step: The step that was played alone, or None.
    """

    task: str
    split: str
    policy: str
    play: str
    obs: str
    liquid: str | None
    n: int
    successes: int
    rate: float
    wilson95: Interval
    ever_rate: float
    substep_rates: dict[str, float]
    mean_seconds_to_success: float | None
    outcomes: dict[str, int]
    # Results of earlier versions lack what follows.
    causes: dict[str, int] = field(default_factory=dict)
    exact95: Interval | None = None
    anytime95: Interval | None = None
    step_rates: dict[str, float] = field(default_factory=dict)
    axes: tuple[str, ...] = ()
    step: str | None = None


def summarise(rows: Sequence[Row]) -> list[Summary]:
    """Return one summary per task, step, split, axes, policy, play, obs and liquid, in order."""
    return [_summary(list(group)) for _, group in groupby(rows, key=_conditions)]


def _conditions(row: Row) -> tuple[object, ...]:
    return row.task, row.step, row.split, row.axes, row.policy, row.play, row.obs, row.liquid


def _summary(rows: Sequence[Row]) -> Summary:
    first, n = rows[0], len(rows)
    successes = [row for row in rows if row.success]
    low, high = confidence_sequence(len(successes), n)
    return Summary(
        task=first.task,
        split=first.split,
        policy=first.policy,
        play=first.play,
        obs=first.obs,
        liquid=first.liquid,
        n=n,
        successes=len(successes),
        rate=len(successes) / n,
        wilson95=wilson(len(successes), n),
        ever_rate=sum(row.ever_success for row in rows) / n,
        substep_rates={
            name: sum(row.substeps[name] is not None for row in rows) / n for name in first.substeps
        },
        mean_seconds_to_success=fmean(row.seconds for row in successes) if successes else None,
        outcomes=dict(Counter(row.outcome for row in rows).most_common()),
        causes=dict(Counter(row.cause for row in rows if row.cause is not None).most_common()),
        exact95=exact(len(successes), n),
        anytime95=(float(low), float(high)),
        step_rates={
            name: sum(row.step_times[name] is not None for row in rows) / n
            for name in first.step_times
        },
        axes=tuple(first.axes),
        step=first.step,
    )
