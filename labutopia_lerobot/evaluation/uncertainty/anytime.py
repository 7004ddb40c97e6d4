"""What stays valid however often one looks, and whenever one stops.

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
    mixture = betaln(wins + 1.0, lost + 1.0)
    evidence: Rates = mixture - xlogy(wins, rate) - xlog1py(lost, -np.asarray(rate))
    return evidence


def p_value(successes: int, losses: int) -> float:
    """Return a p-value of equal policies that stays valid whenever one stops (see above)."""
    return min(1.0, float(np.exp(-log_evidence(successes, losses))))


def _edge(wins: Rates, losses: Rates, out: Rates, inside: Rates, confidence: float) -> Rates:
    """Return where the evidence reaches its bound, between a rate outside and one inside."""
    bound = -np.log1p(-confidence)
    reached = log_evidence(wins, losses, out) < bound  # the end of the scale is inside
    for _ in range(_HALVINGS):
        middle = (out + inside) / 2
        beyond = log_evidence(wins, losses, middle) >= bound
        out, inside = np.where(beyond, middle, out), np.where(beyond, inside, middle)
    # Rounded outwards, so that the interval is never too narrow.
    return np.where(reached, np.round(out), out)
