"""Confidence intervals of a rate, for a number of episodes that was fixed beforehand."""

from scipy.special import betaincinv
from scipy.stats import binomtest

Interval = tuple[float, float]
"""Least and greatest value."""


def wilson(successes: int, n: int, confidence: float = 0.95) -> Interval:
    """Return the score interval (Wilson 1927, without continuity correction).

    It covers the true rate with about the stated confidence, on average over rates.

    Raises:
        ValueError: If there are no episodes, or more successes than episodes.
    """
    _require_rate(successes, n)
    interval = binomtest(successes, n).proportion_ci(confidence, "wilson")
    return float(interval.low), float(interval.high)


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
