"""Reachability: a robot drives in by the entrance and reaches for the fronts of things."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import ndimage

from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.scenes.plan import Opening, Placed, WorkPlace
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.world import FloatArray

ROBOT_RADIUS = 0.3
"""Half the width of a robot that drives [m]; half of the paper's radius ("Navigation Details")."""
REACH = 0.855
"""Reach of the arm of levels 1 to 4 [m] (its maker's data sheet)."""
BENCH_SIDE = 0.5
"""Least distance of a robot from its bench [m]: that of somebody who stands at it."""
_STAND = 0.3
"""Least distance of a robot from a work place [m]: behind it, as its disc is wider than the gap."""

_SLACK = 0.01
"""Margin of the search, so that nothing is left out by rounding [m]."""

_COSINES = {0: 1.0, 90: 0.0, 180: -1.0, 270: 0.0}


@dataclass(frozen=True, eq=False)
class Reach:
    """The places and things that a robot reaches.

    Attributes:
        middles: Where its middle gets, cell by cell, shape (n, 2) [m], room frame.
    """

    middles: FloatArray

    @classmethod
    def of(cls, occupancy: Occupancy, entrance: Opening) -> "Reach":
        """Return where a robot gets from an entrance."""
        free = occupancy.passable(ROBOT_RADIUS)
        regions, _ = ndimage.label(free, structure=np.ones((3, 3)))
        inside = ROBOT_RADIUS + 2 * occupancy.resolution
        here = occupancy.cell(
            entrance.x + inside * _COSINES[entrance.heading],
            entrance.y + inside * _COSINES[(entrance.heading + 270) % 360],
        )
        reached = (regions == regions[here]) & (regions > 0)
        return cls(occupancy.middles(reached))

    def gets_to(self, place: WorkPlace) -> bool:
        """Return whether it gets to a work place."""
        away = np.hypot(*(self.middles - (place.x, place.y)).T)
        return bool((away < _STAND).any())

    def front_of(self, piece: Placed) -> bool:
        """Return whether it can reach for the front of a piece, standing before it."""
        hull = extent(piece.kind).hull
        along = (float(hull.low[0, 1]), float(hull.high[0, 1]))
        before, beside = self._from(piece, float(hull.low[0, 0]), along, behind=False)
        return bool(((before > 0) & (np.hypot(before, beside) <= REACH)).any())

    def side_of(self, piece: Placed, top: Top) -> bool:
        """Return whether it gets to the side of a piece of furniture at which one works."""
        edge = top.x[1] if top.behind else top.x[0]
        before, beside = self._from(piece, edge, top.y, behind=top.behind)
        return bool(((before > 0) & (before <= BENCH_SIDE) & (beside == 0)).any())

    def _from(
        self, piece: Placed, edge: float, along: tuple[float, float], *, behind: bool
    ) -> tuple[FloatArray, FloatArray]:
        """Return how far before an edge across a piece it gets, and how far beside its ends [m].

        Of the cells that are near enough to matter: a room has thousands.
        """
        c, s = -_COSINES[piece.heading], -_COSINES[(piece.heading + 270) % 360]
        x, y = self._around(piece, max(map(abs, (edge, *along))) + REACH)
        x, y = c * x + s * y, c * y - s * x
        beside = np.maximum(np.maximum(along[0] - y, y - along[1]), 0.0)
        return (x - edge) if behind else (edge - x), beside

    def _around(self, piece: Placed, near: float) -> tuple[FloatArray, FloatArray]:
        """Return where it gets from the middle of a piece, up to a distance along x and y [m]."""
        x = self._x - piece.x
        beside = np.flatnonzero(np.abs(x) <= near + _SLACK)
        y = self._y[beside] - piece.y
        around = np.abs(y) <= near + _SLACK
        return x[beside][around], y[around]

    @cached_property
    def _x(self) -> FloatArray:
        return np.ascontiguousarray(self.middles[:, 0])

    @cached_property
    def _y(self) -> FloatArray:
        return np.ascontiguousarray(self.middles[:, 1])
