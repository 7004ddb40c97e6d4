"""Greatest speed of something that has to stop in a given distance, step by step."""

import numpy as np

from labutopia_lerobot.world import FloatArray


def longest_step(distance: FloatArray, growth: FloatArray) -> FloatArray:
    """Return the longest next step after which one can stop within a distance.

    A step may be shorter than the one before by `growth` at most. From a step `s` with
    `n growth <= s <= (n + 1) growth` the way to rest is the sum of `s`, `s - growth`, ..., which is
    `(n + 1) s - growth n (n + 1) / 2`; solved for `s`, with the `n` that the distance allows.

    Args:
        distance: How far it is to the end; what is negative counts as nothing.
        growth: How much longer or shorter a step may be than the one before; of a shape that
            broadcasts against that of the distances.
    """
    distance = np.maximum(distance, 0.0)
    n = np.floor(0.5 * (np.sqrt(1.0 + 8.0 * distance / growth) - 1.0))
    step: FloatArray = (distance + 0.5 * growth * n * (n + 1.0)) / (n + 1.0)
    return step
