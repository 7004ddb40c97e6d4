"""Going straight to a place and heading, over the last bit, where nothing is in the way."""

import math

import numpy as np

from labutopia_lerobot.navigation.path import DrivingLimits
from labutopia_lerobot.navigation.steering import heading_towards, share_of_speed
from labutopia_lerobot.navigation.tracking import turning_speed
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_PULL = 2.0
"""Speed of the last bit per distance that is left [1/s]; ours, as in `tracking`."""
_NEAR, _NEAR_ROLLING = 0.01, 0.03
"""How near it comes, and how near if it cannot go sideways [m]; ours: docks are 0.2 m apart."""
_STRAIGHT = 0.15
"""Distance from the end within which a base that cannot go sideways is steered ever less [m]; ours.
"""
_BRAKING = 0.8
"""Share of the acceleration with which it brakes; ours, as in `tracking`."""


class Parking:
    """Yields the velocities that bring a base straight to a place, turning on the way.

    Args:
        position: Where to: middle of the base, shape (2,) [m], room frame.
        yaw: Heading there, to the left of the room's x axis [rad].
        limits: How fast the base is.
    """

    def __init__(self, position: FloatArray, yaw: float, limits: DrivingLimits) -> None:
        self._position, self._yaw, self._limits = position, yaw, limits
        self._velocity_w: FloatArray = np.zeros(2)
        self._turning = 0.0

    @property
    def near(self) -> float:
        """How near to the place it surely comes [m]."""
        return _NEAR if self._limits.sideways else _NEAR_ROLLING

    def velocity(self, position: FloatArray, yaw: float) -> FloatArray:
        """Return the velocity of the next control period, base frame, shape (3,).

        Forward and to the left [m/s], and turning to the left [rad/s].

        Args:
            position: Of the base, shape (2,) [m], room frame.
            yaw: Of the base [rad].
        """
        limits, way = self._limits, self._position - position
        if not limits.sideways:
            return self._rolled(way, yaw)
        left = float(np.hypot(*way))
        fast = min(
            limits.speed, _PULL * left, math.sqrt(2.0 * _BRAKING * limits.acceleration * left)
        )
        change = fast * way / max(left, 1e-9) - self._velocity_w
        most = limits.acceleration / CONTROL_HZ
        change *= min(1.0, most / max(float(np.hypot(*change)), 1e-9))
        self._velocity_w = self._velocity_w + change
        off = math.remainder(self._yaw - yaw, 2.0 * math.pi)
        self._turning = turning_speed(off, self._turning, limits)
        c, s = math.cos(yaw), math.sin(yaw)
        x, y = self._velocity_w
        return np.array([c * x + s * y, c * y - s * x, self._turning])

    def _rolled(self, way: FloatArray, yaw: float) -> FloatArray:
        """Return the next velocity of a base that goes straight ahead or back, along its heading.

        The last bit it goes straight, that its heading is the right one in the end.

        Args:
            way: To the place, shape (2,) [m].
            yaw: Of the base [rad].
        """
        limits, along = self._limits, np.array([math.cos(self._yaw), math.sin(self._yaw)])
        left = float(along @ way)
        fast = min(
            limits.speed,
            _PULL * abs(left),
            math.sqrt(2.0 * _BRAKING * limits.acceleration * abs(left)),
        )
        aside = (way - left * along) * min(1.0, abs(left) / _STRAIGHT)
        heading = heading_towards(along, aside, math.copysign(fast, left))
        off = math.remainder(heading - yaw, 2.0 * math.pi)
        self._turning = turning_speed(off, self._turning, limits)
        now = float(self._velocity_w[0])  # along the heading
        most = limits.acceleration / CONTROL_HZ
        wanted = math.copysign(fast * share_of_speed(off), left)
        now += min(max(wanted - now, -most), most)
        self._velocity_w = np.array([now, 0.0])
        return np.array([now, 0.0, self._turning])

    def arrived(self, position: FloatArray, yaw: float, within: float, within_rad: float) -> bool:
        """Return whether the base is there.

        Args:
            position: Of the base, shape (2,) [m], room frame.
            yaw: Of the base [rad].
            within: How near [m].
            within_rad: How near its heading [rad].
        """
        off = math.remainder(self._yaw - yaw, 2.0 * math.pi)
        return float(np.hypot(*(self._position - position))) <= within and abs(off) <= within_rad
