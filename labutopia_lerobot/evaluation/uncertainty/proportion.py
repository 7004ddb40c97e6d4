"""Confidence intervals of a rate, for a number of episodes that was fixed beforehand."""

from scipy.stats import binomtest

Interval = tuple[float, float]
"""Least and greatest value."""


def wilson(successes: int, n: int, confidence: float = 0.95) -> Interval:
    """Return the score interval (Wilson 1927, without continuity correction).

    It covers the true rate with about the stated confidence, on average over rates.

    Raises:
        ValueError: If there are no episodes, or more successes than episodes.
    """
    return _interval(successes, n, confidence, "wilson")


def exact(successes: int, n: int, confidence: float = 0.95) -> Interval:
    """Return the exact interval (Clopper and Pearson 1934).

    It covers every rate with at least the stated confidence, and is wider for that.

    Raises:
        ValueError: If there are no episodes, or more successes than episodes.
    """
    return _interval(successes, n, confidence, "exact")


def _interval(successes: int, n: int, confidence: float, method: str) -> Interval:
    if not 0 <= successes <= n or n == 0:
        raise ValueError(f"No rate of {successes} successes in {n} episodes")
    interval = binomtest(successes, n).proportion_ci(confidence, method)
    return float(interval.low), float(interval.high)
