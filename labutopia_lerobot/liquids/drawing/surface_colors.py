"""Colours of a surface around particles of several substances: in between where they mix."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.drawing.open_space import poly6

REACH = 2.0
"""Reach of a particle's colour on the surface, in particle spacings."""

_SIDE = 32
"""Cells after which the grid repeats itself, a power of 2: what shares a bucket by chance is
further away than the reach, and counts for nothing."""


@kernel
def colors_at(
    points: NDArray[np.float32],
    positions: NDArray[np.float64],
    colors: NDArray[np.float64],
    reach: float,
) -> NDArray[np.float64]:
    """Return the mean colour of the particles around points, weighted with a kernel.

    Args:
        points: Shape (q, 3), metres, world frame.
        positions: The particles, shape (n, 3).
        colors: Of the particles, shape (n, channels).
        reach: Of the kernel [m].

    Returns:
        Shape (q, channels); 0 where no particle is within reach.
    """
    n, channels = len(positions), colors.shape[1]
    buckets, starts = np.empty(n, np.int64), np.zeros(_SIDE**3 + 1, np.int64)
    for a in range(n):
        buckets[a] = _bucket(positions[a], reach, 0, 0, 0)
        starts[buckets[a] + 1] += 1
    for b in range(_SIDE**3):
        starts[b + 1] += starts[b]
    order, filled = np.empty(n, np.int64), starts[:-1].copy()
    for a in range(n):
        order[filled[buckets[a]]] = a
        filled[buckets[a]] += 1
    result = np.zeros((len(points), channels))
    point = np.empty(3)
    for q in range(len(points)):
        point[:] = points[q]
        total = 0.0
        for step in range(27):
            bucket = _bucket(point, reach, step // 9 - 1, step // 3 % 3 - 1, step % 3 - 1)
            for place in range(starts[bucket], starts[bucket + 1]):
                a = order[place]
                square = 0.0
                for k in range(3):
                    square += (positions[a, k] - point[k]) ** 2
                weight = poly6(square / reach**2)
                total += weight
                for channel in range(channels):
                    result[q, channel] += weight * colors[a, channel]
        if total > 0.0:
            result[q] /= total
    return result


@kernel
def _bucket(point: NDArray[np.float64], reach: float, i: int, j: int, k: int) -> int:
    """Return the bucket of the cell that is (i, j, k) cells away from that of a point."""
    x = (int(np.floor(point[0] / reach)) + i) & (_SIDE - 1)
    y = (int(np.floor(point[1] / reach)) + j) & (_SIDE - 1)
    z = (int(np.floor(point[2] / reach)) + k) & (_SIDE - 1)
    return (x * _SIDE + y) * _SIDE + z
