"""From rows to rates."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from statistics import fmean

from labutopia_lerobot.evaluation.row import Row

_Z = 1.959963984540054
"""Normal quantile of 0.975."""


@dataclass(frozen=True)
class Summary:
    """One policy in one task and split.

    Attributes:
        task: Task id.
        split: `train` or `id`.
        policy: What the policy is called.
        play: How sequences were played.
        obs: `pixels` or `state`.
        liquid: `on` or `off`; None for a task whose vessels are empty anyway.
        n: Episodes.
        successes: Episodes in which the goal held for as long as it must.
        rate: Share of the successes.
        wilson95: Confidence interval of the rate (see `wilson95`).
        ever_rate: Share of the episodes in which the goal held at any instant.
        substep_rates: Sub-step -> share of the episodes in which it and all before it latched.
        mean_seconds_to_success: Mean simulated duration of the successes [s], or None.
        outcomes: Outcome -> number of episodes, the most frequent first.
        causes: Why episodes failed (see `causes`) -> number of them, the most frequent first.
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
    wilson95: tuple[float, float]
    ever_rate: float
    substep_rates: dict[str, float]
    mean_seconds_to_success: float | None
    outcomes: dict[str, int]
    # Results of earlier versions lack what follows.
    causes: dict[str, int] = field(default_factory=dict)


def wilson95(successes: int, n: int) -> tuple[float, float]:
    """Return the 95 % confidence interval of a rate (Wilson 1927, without continuity correction).

    Raises:
        ValueError: If there are no episodes, or more successes than episodes.
    """
    if not 0 <= successes <= n or n == 0:
        raise ValueError(f"No rate of {successes} successes in {n} episodes")
    rate = successes / n
    centre = rate + _Z**2 / (2 * n)
    half_width = _Z * math.sqrt(rate * (1 - rate) / n + _Z**2 / (4 * n**2))
    scale = 1 + _Z**2 / n
    return max(0.0, (centre - half_width) / scale), min(1.0, (centre + half_width) / scale)


def summarise(rows: Sequence[Row]) -> list[Summary]:
    """Return one summary per task, split, policy, play, obs and liquid, in order."""
    return [_summary(list(group)) for _, group in groupby(rows, key=_conditions)]


def _conditions(row: Row) -> tuple[str | None, ...]:
    return row.task, row.split, row.policy, row.play, row.obs, row.liquid


def _summary(rows: Sequence[Row]) -> Summary:
    first, n = rows[0], len(rows)
    successes = [row for row in rows if row.success]
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
        wilson95=wilson95(len(successes), n),
        ever_rate=sum(row.ever_success for row in rows) / n,
        substep_rates={
            name: sum(row.substeps[name] is not None for row in rows) / n for name in first.substeps
        },
        mean_seconds_to_success=fmean(row.seconds for row in successes) if successes else None,
        outcomes=dict(Counter(row.outcome for row in rows).most_common()),
        causes=dict(Counter(row.cause for row in rows if row.cause is not None).most_common()),
    )
