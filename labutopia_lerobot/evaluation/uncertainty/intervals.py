"""Intervals of rates and medians, and how many episodes a wanted precision costs."""

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np
from scipy.special import betaincinv, ndtri

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence

Interval = tuple[float, float]
"""Least and greatest value."""


def wilson(successes: int, n: int, confidence: float = 0.95) -> Interval:
    """Return the score interval (Wilson 1927, without continuity correction).

    It covers the true rate with about the stated confidence, on average over rates.

    Raises:
        ValueError: If there are no episodes, or more successes than episodes.
    """
    _require_rate(successes, n)
    rate, z = successes / n, deviations(confidence)
    middle, half = (rate + z**2 / (2 * n)) / (1 + z**2 / n), _half_width(rate, n, z)
    low = 0.0 if successes == 0 else middle - half  # exactly, whatever rounding says
    return low, 1.0 if successes == n else middle + half


def deviations(confidence: float) -> float:
    """Return within how many standard deviations a share of a normal distribution lies."""
    return float(ndtri((1 + confidence) / 2))


def _half_width(rate: float, n: int, z: float) -> float:
    """Return half of the width of the Wilson interval of a rate in so many episodes."""
    spread: float = (rate * (1 - rate) / n + z**2 / (4 * n**2)) ** 0.5
    return z * spread / (1 + z**2 / n)


def exact(successes: int, n: int, confidence: float = 0.95) -> Interval:
    """Return the exact interval (Clopper and Pearson 1934), as quantiles of beta distributions.

    It covers every rate with at least the stated confidence, and is wider for that. `binomtest`
    has it too, found by a search that takes a hundred times as long.

    Raises:
        ValueError: If there are no episodes, or more successes than episodes.
    """
    _require_rate(successes, n)
    tail = (1 - confidence) / 2
    low = 0.0 if successes == 0 else betaincinv(successes, n - successes + 1, tail)
    high = 1.0 if successes == n else betaincinv(successes + 1, n - successes, 1 - tail)
    return float(low), float(high)


def _require_rate(successes: int, n: int) -> None:
    if not 0 <= successes <= n or n == 0:
        raise ValueError(f"No rate of {successes} successes in {n} episodes")


@dataclass(frozen=True)
class Median:
    """The median of a sample.

    Attributes:
        value: The median of the sample.
        interval: Confidence interval of the true one, between two values of the sample (binomial:
            Conover 1999, "Practical Nonparametric Statistics", section 3.2); None where the sample
            is too small for any, at 95 % with fewer than six values.
        n: Values.
    """

    value: float
    interval: Interval | None
    n: int

    @classmethod
    def of(cls, values: Sequence[float], confidence: float = 0.95) -> "Median | None":
        """Return the median of values, or None if there are none."""
        from scipy.stats import quantile_test  # here: it takes half a second

        if not values:
            return None
        bounds = quantile_test(values, q=values[0], p=0.5).confidence_interval(confidence)
        interval = None if np.isnan([*bounds]).any() else (float(bounds.low), float(bounds.high))
        return cls(float(median(values)), interval, len(values))


MOST_EPISODES = 1_000_000
"""Nobody plays more."""


class PrecisionError(UserError, ValueError):
    """A half width that no interval of a rate can have, or nobody can pay for."""


def episodes_for(half_width: float, rate: float = 0.5, confidence: float = 0.95) -> int:
    """Return after how many episodes the Wilson interval is narrow enough, if so many succeed.

    Args:
        half_width: Half of the width of the interval that is wanted, such as 0.05.
        rate: Share of the successes; 0.5 needs the most episodes.
        confidence: Of the interval.

    Raises:
        PrecisionError: If the half width is impossible, or takes more than a million episodes.
    """
    z = deviations(confidence)
    return _fewest(lambda n: _half_width(rate, n, z) <= half_width, half_width)


def anytime_episodes_for(half_width: float, rate: float = 0.5, confidence: float = 0.95) -> int:
    """Return after how many episodes the confidence sequence is narrow enough (see `anytime`).

    Args and errors: those of `episodes_for`.
    """

    def narrow(n: int) -> bool:
        low, high = confidence_sequence(rate * n, n, confidence)
        return float(high - low) / 2 <= half_width

    return _fewest(narrow, half_width)


def require_precision(half_width: float) -> None:
    """Make sure that an interval of a rate can be as narrow as wanted.

    Raises:
        PrecisionError: If it cannot.
    """
    if not 0.001 <= half_width < 0.5:
        raise PrecisionError(
            f"{half_width:g} is no half width of an interval of a rate: choose one from 0.001 up "
            "to 0.5, such as 0.05 for plus or minus five percentage points"
        )


def _fewest(narrow: Callable[[int], bool], half_width: float) -> int:
    require_precision(half_width)
    if not narrow(MOST_EPISODES):
        raise PrecisionError(
            f"Plus or minus {half_width:g} takes more than {MOST_EPISODES:,} episodes: choose a "
            "larger half width"
        )
    return 1 + bisect_left(range(1, MOST_EPISODES), True, key=narrow)
