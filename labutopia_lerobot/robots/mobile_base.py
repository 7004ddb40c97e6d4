"""Interface of a base that drives for the rest of the package."""

import math
from dataclasses import dataclass

from labutopia_lerobot.navigation.path import DrivingLimits
from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.laser_scanner import LaserScanner


@dataclass(frozen=True)
class MobileBase:
    """A base that moves any way over the floor (paper: x and y velocity and rotation).

    One on two driven wheels has a range of nothing sideways.

    Its frame has x forward, y to the left, z up, and its origin in the middle of it on the floor.

    Attributes:
        elements: Velocities forward and to the left [m/s], and of turning to the left [rad/s],
            in its own frame.
        joints: Slides along x and y of the room, and the hinge about z that turns in them.
        body: Root body.
        size: Length and width of its footprint [m].
        height: Up to its deck [m].
        payload: Greatest mass on its deck [kg].
        arm: Where the base of the arm is mounted [m], base frame, facing forward.
        ahead: Least and greatest distance before the base of the arm at which it takes things well
            [m].
        above: Greatest such distance at which it takes them from above and lifts them well [m].
        gap: Least distance from a bench at which it stands while the arm works there [m].
        door_room: How much farther off than to reach in it stands to open a door [m].
        scanner: Its laser scanner.
        folded: What the stowed arm takes before the footprint, as spans of x, y and z [m], base
            frame; None if it stays over it.
    """

    elements: tuple[Element, Element, Element]
    joints: tuple[str, str, str]
    body: str
    size: tuple[float, float]
    height: float
    payload: float
    arm: tuple[float, float, float]
    ahead: tuple[float, float]
    above: float
    gap: float
    door_room: float
    scanner: LaserScanner
    folded: tuple[tuple[float, float], ...] | None = None

    @property
    def radius(self) -> float:
        """Radius of the circle around its footprint [m]."""
        return 0.5 * math.hypot(*self.size)

    @property
    def limits(self) -> DrivingLimits:
        """Speed and acceleration, for planning."""
        forward, sideways, turning = self.elements
        return DrivingLimits(
            forward.upper, forward.speed, turning.upper, turning.speed, sideways.upper > 0.0
        )

    @property
    def pose_names(self) -> tuple[str, str, str]:
        """Names of x and y [m] and of the heading, to the left of x [rad], room frame."""
        return self.joints
