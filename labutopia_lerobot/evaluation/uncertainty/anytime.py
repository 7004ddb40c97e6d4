"""Statistics that stay valid however often one looks, and whenever one stops.

An interval for a fixed number of episodes that is looked at after every episode misses the true
rate sooner or later. These do not, with the stated confidence over the whole run: the likelihood of
the successes under a beta mixture of rates, divided by that under one rate, is a martingale if that
is the true one, and exceeds 1 / alpha ever with a probability of at most alpha (Ville's inequality;
Robbins 1970; Howard, Ramdas, McAuliffe and Sekhon 2021, "Time-uniform, nonparametric, nonasymptotic
confidence sequences"). The mixture is uniform, the beta distribution with parameters 1 and 1.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import betaln, xlog1py, xlogy

Rates = NDArray[np.float64]

_HALVINGS = 40
"""Bisections of an interval of at most 1: to 1e-12."""


def confidence_sequence(
    successes: ArrayLike, n: ArrayLike, confidence: float = 0.95
) -> tuple[Rates, Rates]:
    """Return least and greatest rate, valid at all times of a run together.

    Args:
        successes: Successes so far, any shape.
        n: Episodes so far, the same shape; with none the interval is 0 to 1.
        confidence: Probability that no interval of a run misses the true rate.
    """
    wins = np.asarray(successes, dtype=np.float64)
    losses = np.asarray(n, dtype=np.float64) - wins
    middle = wins / np.maximum(wins + losses, 1.0)
    return (
        _edge(wins, losses, np.zeros_like(middle), middle, confidence),
        _edge(wins, losses, np.ones_like(middle), middle, confidence),
    )


def log_evidence(successes: ArrayLike, losses: ArrayLike, rate: ArrayLike = 0.5) -> Rates:
    """Return the natural logarithm of the evidence against a rate.

    Its exponential, at whatever time, is an e-value: 1 / alpha or more speaks against the rate at
    the level alpha. Of two policies on common seeds, `successes` and `losses` are the episodes in
    which only the one or only the other succeeded: a fair coin, if they are equally good.
    """
    wins, lost = np.asarray(successes, dtype=np.float64), np.asarray(losses, dtype=np.float64)
    return _against(rate, wins, lost, betaln(wins + 1.0, lost + 1.0))


def _against(rate: ArrayLike, wins: Rates, lost: Rates, mixture: Rates) -> Rates:
    """Return the logarithm of the likelihood of the mixture over that of one rate."""
    evidence: Rates = mixture - xlogy(wins, rate) - xlog1py(lost, -np.asarray(rate))
    return evidence


def difference_sequence(
    first: int, second: int, n: int, confidence: float = 0.95
) -> tuple[float, float]:
    """Return least and greatest difference of two rates on common seeds, valid at all times.

    An episode counts 1 if only the first policy succeeds, -1 if only the second does, else 0.
    Moved to 0 to 1, the mean of that is bounded as a rate is: the evidence is convex in a single
    outcome, so that it grows no faster than that of successes and failures with the same mean.

    Args:
        first: Episodes in which only the first succeeded.
        second: Episodes in which only the second did.
        n: All common episodes so far.
        confidence: Probability that no interval of a run misses the true difference.
    """
    low, high = confidence_sequence((n + first - second) / 2, n, confidence)
    return 2.0 * float(low) - 1.0, 2.0 * float(high) - 1.0


def p_value(successes: int, losses: int) -> float:
    """Return a p-value of equal policies that stays valid whenever one stops (see above)."""
    return min(1.0, float(np.exp(-log_evidence(successes, losses))))


def _edge(wins: Rates, losses: Rates, out: Rates, inside: Rates, confidence: float) -> Rates:
    """Return where the evidence reaches its bound, between a rate outside and one inside."""
    bound = -np.log1p(-confidence)
    mixture = betaln(wins + 1.0, losses + 1.0)  # the same whatever the rate
    reached = _against(out, wins, losses, mixture) < bound  # the end of the scale is inside
    for _ in range(_HALVINGS):
        middle = (out + inside) / 2
        beyond = _against(middle, wins, losses, mixture) >= bound
        out, inside = np.where(beyond, middle, out), np.where(beyond, inside, middle)
    # Rounded outwards, so that the interval is never too narrow.
    return np.where(reached, np.round(out), out)
