"""Which particles are near each other: a hashed grid, without bounds in space."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.compilation import kernel

_STENCIL = np.array(
    [
        (i, j, k)
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
        for k in (-1, 0, 1)
        if (i, j, k) >= (0, 0, 0)
    ]
)
"""A cell and half of the 26 around it: so that every pair is met once."""


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
def _bucket(i: int, j: int, k: int, mask: int) -> int:
    # Large primes, as in Teschner et al. (2003), "Optimized Spatial Hashing", section 3.
    return ((i * 73856093) ^ (j * 19349663) ^ (k * 83492791)) & mask


@kernel
def near_pairs(positions: NDArray[np.float64], reach: float) -> Pairs:
    """Return every pair of points not further apart than a distance, in a fixed order.

    Args:
        positions: Shape (n, 3), metres.
        reach: The distance [m].
    """
    n = np.uint32(len(positions))
    size = 64
    while size < 2 * n:
        size *= 2
    mask = size - 1
    cells = np.empty((n, 3), np.int64)
    buckets = np.empty(n, np.uint32)
    starts = np.zeros(size + 1, np.uint32)
    for a in range(n):
        for k in range(3):
            cells[a, k] = int(np.floor(positions[a, k] / reach))
        buckets[a] = _bucket(cells[a, 0], cells[a, 1], cells[a, 2], mask)
        starts[buckets[a] + 1] += 1
    for b in range(size):
        starts[b + 1] += starts[b]
    # A copy in the order of the buckets: what is compared then lies together in memory.
    order = np.empty(n, np.uint32)
    near, cell = np.empty((n, 3)), np.empty((n, 3), np.int64)
    filled = starts[:-1].copy()
    for a in range(n):
        place = filled[buckets[a]]
        filled[buckets[a]] += 1
        order[place] = a
        for k in range(3):
            near[place, k], cell[place, k] = positions[a, k], cells[a, k]
    limit = reach * reach
    room = 24 * n + 64
    second: NDArray[np.uint32] = np.empty(room, np.uint32)
    begins = np.empty(n + 1, np.uint32)
    count = np.uint32(0)
    for b in range(n):
        begins[b] = count
        x, y, z = near[b, 0], near[b, 1], near[b, 2]
        if count + n > room:
            room *= 2
            second = np.append(second, np.empty(room - len(second), np.uint32))
        for s in range(len(_STENCIL)):
            i, j, k = (
                cell[b, 0] + _STENCIL[s, 0],
                cell[b, 1] + _STENCIL[s, 1],
                cell[b, 2] + _STENCIL[s, 2],
            )
            bucket = _bucket(i, j, k, mask)
            begin, end = starts[bucket], starts[bucket + 1]
            if s == 0:
                begin = b + np.uint32(1)
            for c in range(begin, end):
                dx, dy, dz = x - near[c, 0], y - near[c, 1], z - near[c, 2]
                if dx * dx + dy * dy + dz * dz < limit and (
                    cell[c, 0] == i and cell[c, 1] == j and cell[c, 2] == k
                ):
                    second[count] = order[c]
                    count += np.uint32(1)
    begins[n] = count
    return Pairs(order, begins, second[:count])
