"""Limits of the next command of a robot, so that it can always stop before its limits."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.robots.braking import longest_step
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_ROUNDING = 2.0
"""Units in the last place of float32 by which accelerations stay below their limit: commands are
rounded to float32 at either end of a change."""

_DOWN_AND_UP = np.array([[-1.0], [1.0]])


class CommandLimits:
    """Bounds on the change from one command to the next.

    Position, speed and acceleration are bounded as the first and second differences of commands
    that are 1/30 s apart. The set-points between commands have no greater derivatives
    (`robots.set_points`), and their jerk is at most twice the bound on the acceleration per control
    period: where the limit of jerk asks for less, the acceleration is bounded by half of that.

    Attributes:
        resolution: Distance of neighbouring float32 numbers at the greatest position, shape
            (elements,) [rad or m].

    Args:
        robot: Whose limits they are.
        share: Share of its speeds and accelerations that may be used.
    """

    def __init__(self, robot: Robot, share: float = 1.0) -> None:
        self._ends = np.array([robot.lower, robot.upper])
        largest = np.abs(self._ends).max(axis=0).astype(np.float32)
        self.resolution: FloatArray = np.spacing(largest).astype(np.float64)
        acceleration = np.minimum(robot.acceleration, np.array(robot.jerk) / CONTROL_HZ / 2.0)
        rounding = _ROUNDING * self.resolution
        self._longest = share * np.array(robot.speed) / CONTROL_HZ - rounding
        self._growth = share * acceleration / CONTROL_HZ**2 - rounding

    def changes(self, before: FloatArray, last: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the least and the greatest change from the last command [rad or m].

        Args:
            before: The command before the last, shape (elements,).
            last: The last command, shape (elements,).
        """
        stopping = longest_step(_DOWN_AND_UP * (self._ends - last), self._growth)
        fastest = np.minimum(_DOWN_AND_UP * (last - before) + self._growth, self._longest)
        down, up = np.maximum(np.minimum(fastest, stopping), -stopping[::-1])
        return -down, up

    def within(self, positions: NDArray[np.floating]) -> FloatArray:
        """Return positions moved into their ranges, shape (elements,) [rad or m]."""
        inside: FloatArray = np.minimum(np.maximum(positions, self._ends[0]), self._ends[1])
        return inside

    def closing(self, gap: FloatArray) -> FloatArray:
        """Return how much of a gap can be closed next, so that one can still stop at its end."""
        step: FloatArray = np.copysign(longest_step(np.abs(gap), self._growth), gap)
        return step

    def braking(self, change: FloatArray) -> FloatArray:
        """Return the next change if all elements slow down by one share, as large as can be.

        What moves against each other then does so until all stands still.

        Args:
            change: The last change, shape (elements,) [rad or m].
        """
        fastest = np.max(np.abs(change) / self._growth)  # control periods from speed to rest
        slower: FloatArray = change * (1.0 - 1.0 / max(fastest, 1.0))
        return slower
