"""Spots for a piece: points of a grid, a patch of which shares heading and height."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.scenes.plan import Heading
from labutopia_lerobot.world import FloatArray

GRID = 0.05
"""Distance of two points [m]."""


@dataclass(frozen=True, eq=False)
class Patch:
    """All points (x, y) of which x is one of some and y one of others.

    Attributes:
        x: [m], room frame, shape (n,).
        y: [m], room frame, shape (m,).
        heading: The way the front faces.
        height: Of the base above the floor [m].
        on: Name of what it stands on.
    """

    x: FloatArray
    y: FloatArray
    heading: Heading
    height: float = 0.0
    on: str | None = None

    def __len__(self) -> int:
        return len(self.x) * len(self.y)

    def offsets(self, numbers: NDArray[np.int_]) -> FloatArray:
        """Return some of its points, by their numbers, shape (n, 3) [m]."""
        rows, columns = np.divmod(numbers, len(self.x))
        heights = np.full(len(numbers), self.height)
        return np.column_stack([self.x[columns], self.y[rows], heights])


def points(low: float, high: float, step: float = GRID) -> FloatArray:
    """Return points of a grid from one end to the other, both included, in whole millimetres."""
    first, last = int(np.ceil(round(1e3 * low, 3))), int(np.floor(round(1e3 * high, 3)))
    if last < first:
        return np.empty(0)
    grid = list(range(first, last + 1, round(1e3 * step)))
    if grid[-1] != last:
        grid.append(last)
    return np.array(grid) / 1e3
