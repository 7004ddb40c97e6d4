"""Planning: from a place to another on a map, without touching anything."""

from dataclasses import dataclass, replace

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.navigation.clearance import Clearance
from labutopia_lerobot.navigation.grid_search import cheapest_cells
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.path import DrivingLimits, Path
from labutopia_lerobot.navigation.rounding import rounded
from labutopia_lerobot.navigation.shortening import shortened
from labutopia_lerobot.world import FloatArray

RADIUS = 0.6
"""Radius of the disc that touches nothing on the way [m] (paper, "Navigation Details": "the
collision detection radius is set to 60 cm")."""

_CARE = 0.2
"""Share by which a way is dearer where it is tightest; ours: round an island of 6 m, 0.15 m further
away, for 2 % of length and no more time."""
_DETOUR = 1.04
"""Greatest length of a careful path, as a multiple of the shortest; ours."""


class BlockedPlaceError(UserError, ValueError):
    """A start or a goal where the robot cannot be; the message says what is how near."""


class UnreachableGoalError(UserError, ValueError):
    """A goal to which no way leads; the message says from where."""


@dataclass(frozen=True)
class PathPlanner:
    """Finds ways over a map for a robot of a size.

    Attributes:
        clearance: How far everything is, and the radius of the robot.
        limits: How fast the robot is.
    """

    clearance: Clearance
    limits: DrivingLimits

    @classmethod
    def of(
        cls, occupancy: Occupancy, limits: DrivingLimits, radius: float = RADIUS
    ) -> "PathPlanner":
        """Return the planner for a map as it is now.

        Args:
            occupancy: Where things stand.
            limits: How fast the robot is.
            radius: Of the robot's disc [m].
        """
        return cls(Clearance.of(occupancy, radius), limits)

    def plan(self, start: FloatArray, goal: FloatArray) -> Path:
        """Return the path from a point to another, both of shape (2,) [m], room frame.

        Raises:
            BlockedPlaceError: If something stands within the robot's radius of either.
            UnreachableGoalError: If there is no way between them.
        """
        short, careful = (self._plan(start, goal, care) for care in (0.0, _CARE))
        return careful if careful.length <= _DETOUR * short.length else short

    def shortest(self, start: FloatArray, goal: FloatArray) -> Path:
        """Return the shortest path, however near it comes to things; else as `plan`.

        Raises:
            BlockedPlaceError: As `plan`.
            UnreachableGoalError: As `plan`.
        """
        return self._plan(start, goal, 0.0)

    def _plan(self, start: FloatArray, goal: FloatArray, care: float) -> Path:
        clearance = replace(self.clearance, care=care)
        prices = clearance.prices()
        ends = self._cell("start", start, prices), self._cell("goal", goal, prices)
        cells = cheapest_cells(prices, *ends)
        if not len(cells):
            raise UnreachableGoalError(
                f"No way leads from {_place(start)} to {_place(goal)} for a robot of "
                f"{self.clearance.radius:g} m radius. Choose a goal in the same part of the room, "
                "or a smaller radius"
            )
        middles = (cells[:, ::-1] + 0.5) * self.clearance.resolution
        points = np.vstack([start, middles + np.array(self.clearance.origin), goal])
        return rounded(shortened(points, clearance), clearance, self.limits)

    def free(self, point: FloatArray) -> bool:
        """Return whether the robot can be at a point, shape (2,) [m], room frame."""
        rows, columns = self.clearance.distances.shape
        column, row = self.clearance.in_widths(point[None])[0]
        inside = -0.5 <= row <= rows - 0.5 and -0.5 <= column <= columns - 0.5
        return bool(inside and self.clearance.at(point[None])[0] >= self.clearance.radius)

    def _cell(self, what: str, point: FloatArray, prices: FloatArray) -> tuple[int, int]:
        """Return row and column of the nearest cell to which one gets straight from a point."""
        if not self.free(point):
            raise BlockedPlaceError(
                f"The {what} {_place(point)} is blocked: a robot of {self.clearance.radius:g} m "
                "radius touches something there, or is not on the floor. Choose a place further "
                "away from things and walls"
            )
        column, row = self.clearance.in_widths(point[None])[0]
        around = [
            (float(np.hypot(r - row, c - column)), r, c)
            for r in range(max(int(row) - 1, 0), min(int(row) + 3, prices.shape[0]))
            for c in range(max(int(column) - 1, 0), min(int(column) + 3, prices.shape[1]))
            if np.isfinite(prices[r, c])
        ]
        for _, r, c in sorted(around):
            middle = (np.array([c, r]) + 0.5) * self.clearance.resolution
            straight = self.clearance.line_price(point, middle + np.array(self.clearance.origin))
            if np.isfinite(straight):
                return r, c
        raise BlockedPlaceError(
            f"The {what} {_place(point)} is hemmed in: a robot of {self.clearance.radius:g} m "
            "radius gets nowhere from there. Choose a place further away from things and walls"
        )


def _place(point: FloatArray) -> str:
    return f"({point[0]:.2f}, {point[1]:.2f}) m"
