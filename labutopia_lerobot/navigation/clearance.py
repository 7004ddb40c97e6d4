"""How far a point is from everything, and what it costs to drive there."""

from dataclasses import dataclass, replace

import numpy as np

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.world import FloatArray

COMFORT = 0.3
"""Distance beyond the radius up to which it costs more to drive [m]; ours."""
_STEP = 0.5
"""Distance of the points at which a line is looked at, in widths of a cell."""
_AROUND = 0.15
"""Distance within which one leaves a place that is hardly too tight [m]; ours: three cells."""
_ROUNDING = 1e-9
"""Difference of distances that is rounding [m]."""


@dataclass(frozen=True, eq=False)
class Clearance:
    """Distances of all points from what a robot must not touch, for a robot of a size.

    Between the middles of cells they are interpolated linearly along both axes.

    Attributes:
        distances: Of the middles of the cells [m], shape (rows, columns).
        origin: As that of the map [m], room frame.
        resolution: Width of a cell [m].
        radius: Of the robot's disc [m].
        care: Greatest share by which a way costs more for being near things; 0 for the shortest.
    """

    distances: FloatArray
    origin: tuple[float, float]
    resolution: float
    radius: float
    care: float = 0.0

    @classmethod
    def of(cls, occupancy: Occupancy, radius: float) -> "Clearance":
        """Return that of a map for a disc of a radius [m]."""
        return cls(occupancy.clearance(), occupancy.origin, occupancy.resolution, radius)

    def leaving(self, start: FloatArray) -> "Clearance":
        """Return this one, eased around a start that is nearer to something than the radius.

        Within twice what is missing, and a bit, everything counts as that much further away;
        elsewhere nothing changes.

        Args:
            start: Shape (2,) [m], room frame.
        """
        short = self.radius - float(self.at(start[None])[0])
        if short <= 0.0:
            return self
        rows, columns = np.indices(self.distances.shape)
        column, row = self.in_widths(start[None])[0]
        near = np.hypot(rows - row, columns - column) * self.resolution < _AROUND + 2.0 * short
        return replace(self, distances=self.distances + np.where(near, short + _ROUNDING, 0.0))

    def prices(self) -> FloatArray:
        """Return the price of a metre in each cell, shape (rows, columns): 1 far from everything.

        It is infinite where the disc cannot be.
        """
        scarce = np.clip(1.0 - (self.distances - self.radius) / COMFORT, 0.0, 1.0)
        return np.where(self.distances >= self.radius, 1.0 + self.care * scarce, np.inf)

    def at(self, points: FloatArray) -> FloatArray:
        """Return the distances at points, shape (n,) [m].

        Args:
            points: Shape (n, 2) [m], room frame.
        """
        found = np.empty(len(points))
        for number, (column, row) in enumerate(self.in_widths(points)):
            found[number] = _distance(self.distances, row, column)
        return found

    def line_price(self, start: FloatArray, end: FloatArray) -> float:
        """Return the price of a straight line, infinite if the disc cannot go along it [m].

        Args:
            start: Shape (2,) [m], room frame.
            end: The same.
        """
        (a, b), (c, d) = self.in_widths(np.array([start, end]))
        price = _line_price(self.distances, self.radius, self.care, b, a, d, c)
        return price * self.resolution

    def in_widths(self, points: FloatArray) -> FloatArray:
        """Return (column, row) of points [m], whole at the middles of cells, shape (n, 2)."""
        widths: FloatArray = (points - np.array(self.origin)) / self.resolution - 0.5
        return widths


@kernel
def _distance(distances: FloatArray, row: float, column: float) -> float:
    """Return the interpolated distance at a place; that of the outermost middles beyond them."""
    rows, columns = distances.shape
    row, column = min(max(row, 0.0), rows - 1.0), min(max(column, 0.0), columns - 1.0)
    i, j = min(int(row), max(rows - 2, 0)), min(int(column), max(columns - 2, 0))
    k, m = min(i + 1, rows - 1), min(j + 1, columns - 1)
    down, right = row - i, column - j
    near = distances[i, j] * (1.0 - right) + distances[i, m] * right
    far = distances[k, j] * (1.0 - right) + distances[k, m] * right
    return float(near * (1.0 - down) + far * down)


@kernel
def _line_price(
    distances: FloatArray,
    radius: float,
    care: float,
    row: float,
    column: float,
    r: float,
    c: float,
) -> float:
    """Return the price of a line between two places, in widths of a cell."""
    length = np.hypot(r - row, c - column)
    steps = int(length / _STEP) + 1
    price = 0.0
    for step in range(steps + 1):
        share = step / steps
        away = _distance(distances, row + share * (r - row), column + share * (c - column)) - radius
        if away < -_ROUNDING:
            return np.inf
        weight = 0.5 if step in (0, steps) else 1.0
        price += weight * (1.0 + care * min(max(1.0 - away / COMFORT, 0.0), 1.0))
    return float(price * length / steps)
