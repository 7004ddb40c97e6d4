"""Where a piece could stand: points of a grid, a patch of which shares heading and height."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from labutopia_lerobot.scenes.plan import Heading
from labutopia_lerobot.world import FloatArray

GRID = 0.05
"""Distance of two points [m]."""


class Spot(NamedTuple):
    """A place for a piece; see `plan.Placed`."""

    x: float
    y: float
    heading: Heading
    height: float = 0.0
    on: str | None = None


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

    def __getitem__(self, number: int) -> Spot:
        row, column = divmod(number, len(self.x))
        x, y = float(self.x[column]), float(self.y[row])
        return Spot(x, y, self.heading, self.height, self.on)


def points(low: float, high: float, step: float = GRID) -> FloatArray:
    """Return points of a grid from one end to the other, both included, in whole millimetres."""
    first, last = int(np.ceil(round(1e3 * low, 3))), int(np.floor(round(1e3 * high, 3)))
    if last < first:
        return np.empty(0)
    grid = list(range(first, last + 1, round(1e3 * step)))
    if grid[-1] != last:
        grid.append(last)
    return np.array(grid) / 1e3


def pick(patches: Sequence[Patch], numbers: Sequence[int]) -> list[Spot]:
    """Return points by their numbers among all of several patches."""
    ends = np.cumsum([len(patch) for patch in patches])
    which = np.searchsorted(ends, numbers, side="right")
    return [
        patches[patch][int(number - (ends[patch - 1] if patch else 0))]
        for patch, number in zip(which, numbers, strict=True)
    ]
