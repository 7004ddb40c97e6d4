"""Layers of what a vessel holds, by height, and what is exchanged between them."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.world import FloatArray

_MOST = 8
"""Layers of a vessel at most; ours: each is one equilibrium to solve."""
_BELOW_SURFACE = 0.95
"""Share of the particles that lie below the surface; ours: the others may be drops in the air."""


class Layers(NamedTuple):
    """Which particles of a vessel are in which layer; none is empty, the lowest is the first.

    Attributes:
        of: Layer of each particle, shape (m,).
        counts: Particles in each layer, shape (layers,).
        height: Of a layer [m].
    """

    of: NDArray[np.intp]
    counts: NDArray[np.intp]
    height: float

    @classmethod
    def by_height(cls, heights: FloatArray, thinnest: float) -> "Layers":
        """Return the layers of particles; what is still falling in belongs to the top one.

        Args:
            heights: Of the particles, shape (m,) [m].
            thinnest: Least height of a layer [m].
        """
        above = heights - heights.min()
        surface = int(_BELOW_SURFACE * (len(above) - 1))
        above = np.minimum(above, np.partition(above, surface)[surface])
        height = max(thinnest, float(above.max()) / (_MOST - 0.5))
        _, of, counts = np.unique(np.floor(above / height), return_inverse=True, return_counts=True)
        return cls(of, counts, height)

    def means(self, contents: FloatArray) -> FloatArray:
        """Return the mean of each layer, shape (layers, species), of rows, shape (m, species)."""
        starts = np.cumsum(self.counts) - self.counts
        sums = np.add.reduceat(contents[np.argsort(self.of, kind="stable")], starts)
        means: FloatArray = sums / self.counts[:, None]
        return means


def exchange(means: FloatArray, counts: NDArray[np.intp], reach: float) -> FloatArray:
    """Return the means of layers after diffusion between those that touch, shape (layers, species).

    One implicit step (backward Euler) of the diffusion equation. Thomas' algorithm: the matrix is
    diagonally dominant, so that nothing becomes negative, and its columns add up to the counts, so
    that nothing is lost.

    Args:
        means: What a particle of each layer holds, shape (layers, species).
        counts: Particles in each layer, shape (layers,).
        reach: Diffusivity times time, by the square of a layer's height.
    """
    passing = reach * np.minimum(counts[:-1], counts[1:])
    diagonal = counts.astype(float)
    diagonal[:-1] += passing
    diagonal[1:] += passing
    after = means * counts[:, None]
    for k in range(1, len(counts)):
        part = passing[k - 1] / diagonal[k - 1]
        diagonal[k] -= part * passing[k - 1]
        after[k] += part * after[k - 1]
    after[-1] /= diagonal[-1]
    for k in range(len(counts) - 2, -1, -1):
        after[k] = (after[k] + passing[k] * after[k + 1]) / diagonal[k]
    return after
