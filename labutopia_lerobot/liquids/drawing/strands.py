"""Strands of falling liquid: particles near each other are smoothed, and joined by threads.

A particle stands for a cube of liquid, but a stream is thinner and longer than a row of cubes, and
surface tension makes it smooth. Positions are moved towards the mean of their neighbours, as Yu and
Turk (2013), "Reconstructing Surfaces of Particle-Based Fluids Using Anisotropic Kernels", section
4.2, do it; in the place of their stretched kernels there are small balls along the way to the
nearest neighbours. For the eye only.
"""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel

FALL = 2.6
"""Ratio of the reach of particles up and down to that sideways: a stream is torn apart along
its fall, and hangs together there."""

_NEIGHBOURS = 2.4
"""Reach of the smoothing sideways, in particle spacings."""

_SMOOTHING = np.array([0.9, 0.9, 0.3])
"""Share of the way to its neighbours' mean that a particle is moved, along each axis; Yu and Turk
take 0.9 to 1."""

LINK = 1.8
"""Greatest sideways span of a thread, in particle spacings."""

_LINKS = 2
"""Threads that a particle begins: those to its nearest neighbours."""

_STEP = 0.45
"""Distance between the balls of a thread, in particle spacings."""

_BALL = 0.27
"""Weight of such a ball: half a particle spacing of radius, all together."""

_THINNEST = 0.7
"""Part of it that is left in the middle of the longest thread."""

_MOST_BALLS = 3
"""Most balls of all threads for each particle: the skin of a liquid has no room for more."""

_COMPANY = 0.75
"""Weight of neighbours from which a particle begins to be of a stream, and at twice which it is: a
row of particles one spacing apart has 5.7, one of drops five spacings apart 0.3."""


@kernel
def strands(
    positions_w: NDArray[np.float64], weights: NDArray[np.float32], spacing: float
) -> tuple[NDArray[np.float64], NDArray[np.float32]]:
    """Return what to draw of drops: the particles, smoothed, and the threads between them.

    Args:
        positions_w: The particles, shape (n, 3), metres.
        weights: How much of a drop each is, shape (n,).
        spacing: Edge of the cube that has a particle's volume [m].

    Returns:
        Places [m] and weights; particles first, and those that are in no stream as they were.
    """
    n = len(positions_w)
    order = np.argsort(positions_w[:, 2])
    near, span = (_NEIGHBOURS * spacing) ** 2, (LINK * spacing) ** 2
    furthest = max(_NEIGHBOURS, LINK) * FALL * spacing
    sums, totals = positions_w.copy(), np.ones(n)
    nearest = np.full((n, _LINKS), -1, np.int64)
    squares = np.full((n, _LINKS), span)
    for first in range(n):
        a = order[first]
        for second in range(first + 1, n):
            b = order[second]
            if positions_w[b, 2] - positions_w[a, 2] > furthest:
                break
            square = ((positions_w[a, 2] - positions_w[b, 2]) / FALL) ** 2
            for k in range(2):
                square += (positions_w[a, k] - positions_w[b, k]) ** 2
            if square < near:
                weight = (1.0 - square / near) ** 2
                totals[a] += weight
                totals[b] += weight
                for k in range(3):
                    sums[a, k] += weight * positions_w[b, k]
                    sums[b, k] += weight * positions_w[a, k]
            _keep_nearest(nearest[a], squares[a], b, square)
            _keep_nearest(nearest[b], squares[b], a, square)
    points = np.empty((n * (1 + _MOST_BALLS), 3))
    point_weights = np.empty(len(points), np.float32)
    flows = np.empty(n)
    for a in range(n):
        flows[a] = min(max((totals[a] - 1.0) / _COMPANY - 1.0, 0.0), 1.0)
        for k in range(3):
            aside = sums[a, k] / totals[a] - positions_w[a, k]
            points[a, k] = positions_w[a, k] + flows[a] * _SMOOTHING[k] * aside
        point_weights[a] = weights[a]
    count = n
    for a in range(n):
        for link in range(_LINKS):
            b = nearest[a, link]
            flow = 0.0 if b < 0 else min(flows[a], flows[b])
            if flow == 0.0 or (b < a and (nearest[b] == a).any()):  # the other has drawn it
                continue
            long = np.sqrt(np.sum((points[a] - points[b]) ** 2)) / spacing
            balls = int(long / _STEP)
            if count + balls > len(points):
                continue
            for ball in range(balls):
                t = (ball + 1.0) / (balls + 1.0)
                thin = 1.0 - (1.0 - _THINNEST) * 4.0 * t * (1.0 - t) * min(
                    long / (LINK * FALL), 1.0
                )
                for k in range(3):
                    points[count, k] = (1.0 - t) * points[a, k] + t * points[b, k]
                point_weights[count] = _BALL * flow * thin * min(weights[a], weights[b])
                count += 1
    return points[:count], point_weights[:count]


@kernel
def _keep_nearest(
    nearest: NDArray[np.int64], squares: NDArray[np.float64], other: int, square: float
) -> None:
    """Insert a neighbour into the few nearest, in order of distance."""
    for place in range(_LINKS):
        if square < squares[place]:
            for later in range(_LINKS - 1, place, -1):
                squares[later], nearest[later] = squares[later - 1], nearest[later - 1]
            squares[place], nearest[place] = square, other
            return
