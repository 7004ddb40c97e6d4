"""A path over the floor: points close together, and how fast a robot may be at each."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from labutopia_lerobot.world import FloatArray


@dataclass(frozen=True)
class DrivingLimits:
    """How fast a base may be and become; speeds and accelerations are those of its middle.

    Attributes:
        speed: Greatest speed, whichever way [m/s].
        acceleration: Greatest acceleration, whichever way [m/s^2].
        turning: Greatest speed of turning [rad/s].
        turning_acceleration: Greatest angular acceleration [rad/s^2].
        sideways: Whether it can go sideways; one that cannot turns to where it drives.
    """

    speed: float
    acceleration: float
    turning: float
    turning_acceleration: float
    sideways: bool = True

    @property
    def widest_bend(self) -> float:
        """Radius of the bend that it goes round at full speed [m]: wider ones are no faster."""
        return self.speed**2 / self.along

    @property
    def along(self) -> float:
        """Acceleration along a path [m/s^2]; as much is left across it."""
        return self.acceleration / math.sqrt(2.0)


@dataclass(frozen=True, eq=False)
class Path:
    """A way over the floor.

    Attributes:
        points: First to last, shape (n, 2) [m], room frame.
        waypoints: The points at which it turns, with both ends, shape (k, 2) [m]: key waypoints of
            the paper. Bends cut their corners.
        bends: Radius of the bend that each point is on [m], infinite where it is straight, 0 where
            the robot has to stop and go on another way; shape (n,).
    """

    points: FloatArray
    waypoints: FloatArray
    bends: FloatArray

    @property
    def length(self) -> float:
        """How long it is [m]."""
        return float(self.distances[-1])

    @cached_property
    def distances(self) -> FloatArray:
        """How far it is to each point from the first, along the path, shape (n,) [m]."""
        steps = np.hypot(*np.diff(self.points, axis=0).T)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def at(self, distance: float) -> FloatArray:
        """Return the point at a distance from the first, along the path, shape (2,) [m]."""
        return np.array([np.interp(distance, self.distances, axis) for axis in self.points.T])

    def direction(self, distance: float) -> FloatArray:
        """Return the direction at a distance from the first point, a unit vector, shape (2,)."""
        index = int(np.searchsorted(self.distances, distance, side="right")) - 1
        index = min(max(index, 0), len(self.points) - 2)
        along: FloatArray = self.points[index + 1] - self.points[index]
        unit: FloatArray = along / np.hypot(*along)
        return unit

    def speeds(self, limits: DrivingLimits) -> FloatArray:
        """Return the greatest speed at each point, shape (n,) [m/s].

        From rest to rest: bends take their part of the acceleration, v^2 / r, and between points a
        distance d apart v^2 changes by 2 a d at most, forwards and backwards (Bobrow, Dubowsky,
        Gibson, 1985, "Time-Optimal Control of Robotic Manipulators Along Specified Paths").
        """
        squares = np.minimum(limits.speed**2, limits.along * self.bends)
        squares[[0, -1]] = 0.0
        gains = 2.0 * limits.along * np.diff(self.distances)
        squares = _rising(_rising(squares, gains)[::-1], gains[::-1])[::-1]
        speeds: FloatArray = np.sqrt(squares)
        return speeds

    def duration(self, limits: DrivingLimits) -> float:
        """Return the time that it takes at these speeds [s].

        From rest to rest between two points it is as fast in the middle as may be gained by then.
        """
        speeds, steps = self.speeds(limits), np.diff(self.distances)
        means = 0.5 * (speeds[1:] + speeds[:-1])
        middle = 0.5 * np.minimum(limits.speed, np.sqrt(limits.along * steps))
        return float((steps / np.where(means > 0.0, means, middle)).sum())


def _rising(squares: FloatArray, gains: FloatArray) -> FloatArray:
    """Return squares of speeds that rise by no more than may be gained on the way."""
    bounded = squares.copy()
    for index, gain in enumerate(gains):
        bounded[index + 1] = min(bounded[index + 1], bounded[index] + gain)
    return bounded
