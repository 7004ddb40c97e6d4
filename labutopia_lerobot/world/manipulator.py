"""The view of the robot that skills have."""

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True)
class Approach:
    """A direction of the hand that its arm reaches comfortably.

    Attributes:
        yaw: About the vertical, to the left of some level direction [rad].
        pitch: Below the horizontal [rad].
    """

    yaw: float
    pitch: float


class Pace(Protocol):
    """How fast a base may be and become."""

    @property
    def speed(self) -> float:
        """Greatest speed, whichever way [m/s]."""
        ...

    @property
    def acceleration(self) -> float:
        """Greatest acceleration, whichever way [m/s^2]."""
        ...

    @property
    def turning(self) -> float:
        """Greatest speed of turning [rad/s]."""
        ...

    @property
    def turning_acceleration(self) -> float:
        """Greatest angular acceleration [rad/s^2]."""
        ...

    @property
    def sideways(self) -> bool:
        """Whether it can go sideways."""
        ...


class Wheels(Protocol):
    """The view of a base that skills have: its footprint, and how fast it is."""

    @property
    def size(self) -> tuple[float, float]:
        """Length and width of its footprint [m]."""
        ...

    @property
    def ahead(self) -> tuple[float, float]:
        """Least and greatest distance before the arm's base at which it takes things well [m]."""
        ...

    @property
    def above(self) -> float:
        """Greatest such distance at which it takes things from above and lifts them well [m]."""
        ...

    @property
    def door_room(self) -> float:
        """Distance by which it stands farther off to open a door than to reach in [m]."""
        ...

    @property
    def limits(self) -> Pace:
        """How fast it is."""
        ...


class Manipulator(Protocol):
    """The view of the robot that skills have: its hand, and the orientations that suit its arm."""

    @property
    def reach(self) -> float:
        """Distance that the hand gets from the base of the arm, horizontally [m]."""
        ...

    @property
    def max_opening(self) -> float:
        """Greatest distance between the pads [m]."""
        ...

    @property
    def finger_reach(self) -> float:
        """Reach of the fingers beyond the point between the pads [m]."""
        ...

    @property
    def finger_thickness(self) -> float:
        """Thickness of a finger tip, along the motion of the fingers [m]."""
        ...

    @property
    def vessel_approach(self) -> Approach:
        """Approach of the hand to vessels, relative to the bearing from the robot's base."""
        ...

    @property
    def handle_approach(self) -> Approach:
        """Approach of the hand to handles, relative to straight into the door or drawer."""
        ...

    @property
    def deep_approach(self) -> Approach:
        """Approach of the hand that points down, to what stands deep in something, likewise."""
        ...

    @property
    def settling(self) -> float:
        """Time that the hand stays near a place until it has stopped swinging there [s]."""
        ...

    @property
    def base(self) -> Wheels | None:
        """What carries it over the floor; None for an arm on a stand."""
        ...
