"""Boxes along the axes, many at a time."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.scenes.plan import Heading
from labutopia_lerobot.world import FloatArray

TOUCHING = 0.0015
"""Greatest overlap of two boxes that still only touch [m]: plans are written to the millimetre."""

_COSINES = {0: 1.0, 90: 0.0, 180: -1.0, 270: 0.0}


class Boxes(NamedTuple):
    """Boxes whose sides are along the axes of a frame.

    Attributes:
        low: Least corners [m], shape (n, 3).
        high: Greatest corners [m], shape (n, 3).
    """

    low: FloatArray
    high: FloatArray

    @property
    def hull(self) -> "Boxes":
        """The box around all of them, shape (1, 3) each; nothing around nothing."""
        if not len(self.low):
            return self
        return Boxes(self.low.min(axis=0, keepdims=True), self.high.max(axis=0, keepdims=True))

    def placed(self, heading: Heading) -> "Boxes":
        """Return boxes of a piece, whose front faces -x, when its front faces a heading."""
        c, s = -_COSINES[heading], -_COSINES[(heading + 270) % 360]
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        one, other = self.low @ turn.T, self.high @ turn.T
        return Boxes(np.minimum(one, other), np.maximum(one, other))

    def moved(self, by: FloatArray) -> "Boxes":
        """Return them elsewhere.

        Args:
            by: How far [m], shape (3,).
        """
        return Boxes(self.low + by, self.high + by)

    def meet(self, other: "Boxes") -> bool:
        """Return whether any of them is in any of others by more than they may touch."""
        return bool(len(self.low) and len(other.low) and self.meets(other).any())

    def meets(self, other: "Boxes") -> NDArray[np.bool_]:
        """Return which of others are in any of them by more than they may touch, shape (n,)."""
        inside = self.low[:, None] + TOUCHING < other.high
        inside &= other.low + TOUCHING < self.high[:, None]
        return np.asarray((inside[..., 0] & inside[..., 1] & inside[..., 2]).any(axis=0))

    def without_inner(self) -> "Boxes":
        """Return them without those that lie in another one."""
        inside = np.logical_and.reduce(
            (self.low[:, None] >= self.low[None]) & (self.high[:, None] <= self.high[None]), axis=2
        )
        same = inside & inside.T  # of equal ones the first stays
        inside &= ~(same & np.triu(np.ones(inside.shape, bool)))
        return Boxes(self.low[~inside.any(axis=1)], self.high[~inside.any(axis=1)])


def boxes(*spans: tuple[tuple[float, float], ...]) -> Boxes:
    """Return boxes, each of its spans along x, y and z [m]."""
    corners = np.array(spans, dtype=float).reshape(-1, 3, 2)
    return Boxes(corners[:, :, 0], corners[:, :, 1])


def joined(*parts: Boxes) -> Boxes:
    """Return all boxes of several."""
    if not parts:
        return boxes()
    return Boxes(np.vstack([p.low for p in parts]), np.vstack([p.high for p in parts]))
