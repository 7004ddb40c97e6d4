"""Search for near particles: a grid that repeats itself, without bounds in space."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel

_SIDE = 16
"""Cells after which the grid repeats itself, a power of 2. Two cells that share a bucket are
further apart than any neighbours, so that the distance distinguishes them."""

_ROWS = np.array([(0, 1), (1, -1), (1, 0), (1, 1)])
"""Half of the eight rows of cells around a row, so that every pair is met once."""


class Pairs(NamedTuple):
    """Pairs of neighbours, each once.

    Attributes:
        first: Every point, in the order of the pairs, shape (n,).
        starts: Where the pairs of each of these begin, shape (n + 1,).
        second: The other point of each pair, shape (pairs,).
    """

    first: NDArray[np.uint32]
    starts: NDArray[np.uint32]
    second: NDArray[np.uint32]


@kernel
def near_pairs(positions: NDArray[np.float64], reach: float) -> Pairs:
    """Return every pair of points nearer to each other than a distance, in a fixed order.

    Args:
        positions: Shape (n, 3), metres.
        reach: The distance [m].
    """
    n = len(positions)
    buckets = np.empty(n, np.int64)
    starts = np.zeros(_SIDE**3 + 1, np.int64)
    for a in range(n):
        bucket = 0
        for k in range(3):
            bucket = bucket * _SIDE + (int(np.floor(positions[a, k] / reach)) & (_SIDE - 1))
        buckets[a] = bucket
        starts[bucket + 1] += 1
    for b in range(_SIDE**3):
        starts[b + 1] += starts[b]
    # A copy in the order of the buckets: what is compared then lies together in memory.
    order, near, bucket_of = np.empty(n, np.uint32), np.empty((n, 3)), np.empty(n, np.int64)
    filled = starts[:-1].copy()
    for a in range(n):
        place = filled[buckets[a]]
        filled[buckets[a]] += 1
        order[place], bucket_of[place] = a, buckets[a]
        near[place] = positions[a]
    room = 24 * n + 64
    second: NDArray[np.uint32] = np.empty(room, np.uint32)
    begins = np.empty(n + 1, np.uint32)
    count = 0
    for p in range(n):
        begins[p] = count
        if count + n > room:
            room *= 2
            second = np.append(second, np.empty(room - len(second), np.uint32))
        i, j = bucket_of[p] // _SIDE**2, bucket_of[p] // _SIDE % _SIDE
        k = bucket_of[p] % _SIDE
        low, high = (k - 1) & (_SIDE - 1), (k + 1) & (_SIDE - 1)
        own = bucket_of[p] - k
        # The rest of the point's own cell, and the next one of its row.
        count = _append(near, order, p, p + 1, starts[own + k + 1], reach, second, count)
        count = _append(
            near, order, p, starts[own + high], starts[own + high + 1], reach, second, count
        )
        for r in range(len(_ROWS)):
            row = (i + _ROWS[r, 0]) & (_SIDE - 1)
            row = (row * _SIDE + ((j + _ROWS[r, 1]) & (_SIDE - 1))) * _SIDE
            if low < high:
                begin, end = starts[row + low], starts[row + high + 1]
                count = _append(near, order, p, begin, end, reach, second, count)
                continue
            for cell in (low, k, high):
                begin, end = starts[row + cell], starts[row + cell + 1]
                count = _append(near, order, p, begin, end, reach, second, count)
    begins[n] = count
    return Pairs(order, begins, second[:count])


@kernel
def _append(
    near: NDArray[np.float64],
    order: NDArray[np.uint32],
    p: int,
    begin: int,
    end: int,
    reach: float,
    second: NDArray[np.uint32],
    count: int,
) -> int:
    """Append those of a run of points that are near one; return how many there are now."""
    x, y, z = near[p, 0], near[p, 1], near[p, 2]
    for c in range(begin, end):
        dx, dy, dz = x - near[c, 0], y - near[c, 1], z - near[c, 2]
        # Always written, seldom kept: a branch that cannot be foreseen costs more.
        second[count] = order[c]
        count += int(dx * dx + dy * dy + dz * dz < reach * reach)
    return count
