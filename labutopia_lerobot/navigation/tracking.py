"""Following a path: where the base is, in; the velocity of the base, out.

A speed along the path, and a pull back onto it in proportion to how far off it the base is: the
controller of Kanayama, Kimura, Miyazaki and Noguchi (1990, "A Stable Tracking Control Method for an
Autonomous Mobile Robot"), without its detour by the heading, since the base moves any way. It looks
where it goes: as far as it still has to turn it drives slower. One that cannot go sideways is
steered back (`steering`).
"""

import math

import numpy as np

from labutopia_lerobot.navigation.path import DrivingLimits, Path
from labutopia_lerobot.navigation.steering import heading_towards, share_of_speed
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_PULL = 2.0
"""Speed back onto the path, and of the last bit of a turn, per error [1/s]; ours."""
_AHEAD = 0.15
"""Distance along the path at which the base looks [m]; ours: it begins to turn before a bend."""
_BRAKING = 0.8
"""Share of the acceleration with which a turn is braked; ours: time goes in steps."""
_WINDOW = 0.5
"""Distance ahead in which the nearest point of the path is looked for [m]; ours: a path that comes
back to where it was is not cut short."""


class PathTracker:
    """Yields the velocities that bring a base along a path, from rest to rest.

    Attributes:
        travelled: How far along the path the base is [m].

    Args:
        path: Where to.
        limits: How fast the base is.
    """

    def __init__(self, path: Path, limits: DrivingLimits) -> None:
        self._path, self._limits = path, limits
        self._speeds = path.speeds(limits)
        self._velocity_b: FloatArray = np.zeros(3)
        self.travelled = 0.0

    def velocity(self, position: FloatArray, yaw: float, fastest: float = math.inf) -> FloatArray:
        """Return the velocity of the next control period, base frame, shape (3,).

        Forward and to the left [m/s], and turning to the left [rad/s].

        Args:
            position: Of the base, shape (2,) [m], room frame.
            yaw: Of the base, to the left of the room's x axis [rad].
            fastest: Greatest speed along the path [m/s], where something is in the way.
        """
        path, limits = self._path, self._limits
        if not path.length:
            return self._velocity_b.copy()
        self.travelled = self._nearest(position)
        ahead = path.direction(min(self.travelled + _AHEAD, path.length))
        back, speed = path.at(self.travelled) - position, min(self._speed(), fastest)
        heading = math.atan2(ahead[1], ahead[0])
        if not limits.sideways:
            heading = heading_towards(ahead, back, speed)
        off = math.remainder(heading - yaw, 2.0 * math.pi)
        turning = turning_speed(off, self._velocity_b[2], limits)
        if not limits.sideways:
            return self._rolled(speed * share_of_speed(off), turning)
        speed *= max(0.0, math.cos(off))
        velocity = speed * path.direction(self.travelled) + _PULL * back
        velocity *= min(1.0, limits.speed / max(float(np.hypot(*velocity)), 1e-9))
        middle = yaw + 0.5 * turning / CONTROL_HZ  # how it is turned on average until the next one
        c, s = math.cos(middle), math.sin(middle)
        wanted_b = np.array([c * velocity[0] + s * velocity[1], c * velocity[1] - s * velocity[0]])
        change = wanted_b - self._velocity_b[:2]
        most = limits.acceleration / CONTROL_HZ
        change *= min(1.0, most / max(float(np.hypot(*change)), 1e-9))
        self._velocity_b = np.append(self._velocity_b[:2] + change, turning)
        return self._velocity_b.copy()

    def _rolled(self, speed: float, turning: float) -> FloatArray:
        """Return the next velocity of a base that goes straight ahead."""
        most = self._limits.acceleration / CONTROL_HZ
        change = min(max(speed - self._velocity_b[0], -most), most)
        self._velocity_b = np.array([self._velocity_b[0] + change, 0.0, turning])
        return self._velocity_b.copy()

    def ahead(self, most: float, step: float) -> tuple[FloatArray, FloatArray]:
        """Return the path ahead: distances from here, shape (n,), and points, shape (n, 2) [m].

        Args:
            most: How far ahead [m].
            step: Distance of the points [m].
        """
        end = min(most, self._path.length - self.travelled)
        far = np.linspace(0.0, end, 1 + math.ceil(end / step))
        along = self.travelled + far
        points = [np.interp(along, self._path.distances, axis) for axis in self._path.points.T]
        return np.asarray(far, np.float64), np.column_stack(points)

    def arrived(self, position: FloatArray, within: float) -> bool:
        """Return whether the base is at the end of the path.

        Args:
            position: Of the base, shape (2,) [m], room frame.
            within: How near [m].
        """
        return bool(np.hypot(*(self._path.points[-1] - position)) <= within)

    def _speed(self) -> float:
        """Return how fast to go on along the path [m/s]."""
        limits, now = self._limits, float(np.hypot(*self._velocity_b[:2]))
        next_step = (now + limits.along / CONTROL_HZ) / CONTROL_HZ
        distances = self._path.distances
        fast = float(np.interp(self.travelled + next_step, distances, self._speeds))
        left = self._path.length - self.travelled
        return min(max(fast, limits.along / CONTROL_HZ), _PULL * left)

    def _nearest(self, position: FloatArray) -> float:
        """Return how far along the path the point next to a position is [m]."""
        path = self._path
        first, last = np.searchsorted(path.distances, [self.travelled, self.travelled + _WINDOW])
        first, last = max(int(first) - 1, 0), min(int(last), len(path.points) - 1)
        start, along = path.points[first:last], np.diff(path.points[first : last + 1], axis=0)
        lengths = np.hypot(*along.T)
        share = ((position - start) * along).sum(axis=1) / lengths**2
        share = np.clip(share, 0.0, 1.0)
        away = np.hypot(*(start + share[:, None] * along - position).T)
        best = int(np.argmin(away))
        along_it = path.distances[first + best] + share[best] * lengths[best]
        return max(self.travelled, float(along_it))


def turning_speed(off: float, now: float, limits: DrivingLimits) -> float:
    """Return how fast to turn in the next control period [rad/s], so as to stop where one looks.

    Args:
        off: Angle that is left to turn, to the left [rad].
        now: How fast the base turns [rad/s].
        limits: How fast the base is.
    """
    stopping = math.sqrt(2.0 * _BRAKING * limits.turning_acceleration * abs(off))
    wanted = math.copysign(min(limits.turning, stopping, _PULL * abs(off)), off)
    most = limits.turning_acceleration / CONTROL_HZ
    return now + min(max(wanted - now, -most), most)
