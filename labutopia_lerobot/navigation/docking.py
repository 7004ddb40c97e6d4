"""Docking: the last bit to a bench, where the robot's disc would touch but its footprint does not.

A robot drives as a disc to a point straight behind its place, turns, and goes straight in.
"""

import math
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.navigation.clearance import Clearance
from labutopia_lerobot.navigation.occupancy import FREE, Occupancy
from labutopia_lerobot.navigation.path_planner import BlockedPlaceError, PathPlanner
from labutopia_lerobot.world import FloatArray

LONGEST = 1.5
"""Greatest distance that is gone straight in [m]; ours: more than twice the paper's radius."""
_STEP = 0.02
"""Distance of the places that are looked at on the way [m]."""


@dataclass(frozen=True)
class FloorRectangle:
    """The rectangle on the floor that a base takes; the base frame is in its middle.

    Attributes:
        length: Along x of the base [m].
        width: Along y of the base [m].
    """

    length: float
    width: float

    def turns(self, clearance: Clearance, position: FloatArray) -> bool:
        """Return whether it can turn all round: its corners may reach further than its disc.

        Args:
            clearance: How far everything is.
            position: Middle of the base, shape (2,) [m], frame of the map.
        """
        corner = math.hypot(self.length, self.width) / 2
        return bool(clearance.at(position[None])[0] >= corner)

    def fits(self, occupancy: Occupancy, position: FloatArray, yaw: float) -> bool:
        """Return whether it is on the floor and in no cell that is not free.

        A cell counts as far as it reaches along the sides of the rectangle, which is too far at its
        corners: by a fifth of a cell at most.

        Args:
            occupancy: Where things stand.
            position: Middle of the base, shape (2,) [m], frame of the map.
            yaw: Of the base, to the left of x [rad].
        """
        c, s = math.cos(yaw), math.sin(yaw)
        half = np.array([self.length, self.width]) / 2
        corners = half * [[1, 1], [1, -1], [-1, 1], [-1, -1]] @ [[c, s], [-s, c]] + position
        rows, columns = occupancy.cells.shape
        far = np.array(occupancy.origin) + np.array([columns, rows]) * occupancy.resolution
        if (corners < occupancy.origin).any() or (corners > far).any():
            return False
        first = occupancy.cell(*corners.min(axis=0))
        last = occupancy.cell(*corners.max(axis=0))
        near = np.zeros(occupancy.cells.shape, bool)
        window = slice(first[0], last[0] + 1), slice(first[1], last[1] + 1)
        near[window] = occupancy.cells[window] != FREE
        away = np.abs((occupancy.middles(near) - position) @ [[c, -s], [s, c]])
        reach = half + occupancy.resolution / 2 * (abs(c) + abs(s))
        return not (away < reach - 1e-9).all(axis=1).any()


def approach_to(
    planner: PathPlanner,
    occupancy: Occupancy,
    footprint: FloorRectangle,
    position: FloatArray,
    yaw: float,
) -> FloatArray:
    """Return the nearest point straight behind a place where the robot can turn, shape (2,) [m].

    Its disc can be there, and its footprint at any heading; where there is no such point, the disc.

    Args:
        planner: Knows where the disc can be.
        occupancy: The same map, for the footprint.
        footprint: Of the base.
        position: The place: middle of the base, shape (2,) [m], room frame.
        yaw: Heading at the place [rad].

    Raises:
        BlockedPlaceError: If the footprint touches something there or on the way in.
    """
    place = (
        f"The place ({position[0]:.2f}, {position[1]:.2f}) m, heading {math.degrees(yaw):.0f} deg,"
    )
    reason = (
        f"is too far in: within {LONGEST:g} m behind it there is no room for a robot of "
        f"{planner.clearance.radius:g} m radius to turn"
    )
    back = -np.array([math.cos(yaw), math.sin(yaw)])
    free: list[FloatArray] = []
    for distance in np.arange(0.0, LONGEST, _STEP):
        point: FloatArray = position + distance * back
        if not footprint.fits(occupancy, point, yaw):
            reason = (
                f"is blocked: a base of {footprint.length:g} x {footprint.width:g} m touches "
                f"something {'there' if distance == 0.0 else f'{distance:.2f} m behind it'}"
            )
            break
        if planner.free(point):
            free.append(point)
            if footprint.turns(planner.clearance, point):
                return point
    if not free:
        raise BlockedPlaceError(f"{place} {reason}. Choose another place")
    return free[0]
