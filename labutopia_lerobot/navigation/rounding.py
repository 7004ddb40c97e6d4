"""Rounding of corners: a path of straight lines gets bends, as wide as there is room for."""

import math
from collections.abc import Iterator

import numpy as np

from labutopia_lerobot.navigation.clearance import Clearance
from labutopia_lerobot.navigation.path import DrivingLimits, Path
from labutopia_lerobot.world import FloatArray

_SPACING = 0.02
"""Distance of the points of a path [m]."""
_NARROWER = 0.7
"""Radius of the next bend that is tried, as a share of that which had no room; ours."""
_NARROWEST = 0.02
"""Radius below which a corner stays a corner, at which the robot stops [m]; ours."""


def rounded(waypoints: FloatArray, clearance: Clearance, limits: DrivingLimits) -> Path:
    """Return a path whose corners are arcs of circles, where the robot has room for them.

    Args:
        waypoints: Corners of a path that passes, with both ends, shape (k, 2) [m], room frame.
        clearance: Where the robot can go.
        limits: How fast it is: at its speed wider bends gain nothing.
    """
    corners = waypoints.copy()
    pieces, bends = [waypoints[:1]], [np.array([np.inf])]
    for index in range(1, len(waypoints) - 1):
        leave, meet, reach = pieces[-1][-1], waypoints[index], waypoints[index + 1]
        last = index == len(waypoints) - 2
        share = 1.0 if last else 0.5  # of the next leg, whose other half is the next corner's
        tried = _arcs(leave, meet, reach, share, limits.widest_bend)
        least = 0.5 * (clearance.radius + clearance.at(meet[None])[0])  # half of what is to spare
        fitting = (bend for bend in tried if np.all(clearance.at(bend[1]) >= least))
        radius, arc = next(fitting, (0.0, meet[None]))
        _add(pieces, bends, arc[:1], np.inf)
        bends[-1][-1] = radius
        if len(arc) > 1:
            pieces.append(arc[1:])
            bends.append(np.full(len(arc) - 1, radius))
    _add(pieces, bends, waypoints[-1:], np.inf)
    return Path(np.vstack(pieces), corners, np.concatenate(bends))


def _add(
    pieces: list[FloatArray], bends: list[FloatArray], point: FloatArray, radius: float
) -> None:
    """Go straight on to a point, shape (1, 2)."""
    start = pieces[-1][-1]
    length = float(np.hypot(*(point[0] - start)))
    if length < 1e-9:
        return
    shares = np.linspace(0.0, 1.0, math.ceil(length / _SPACING) + 1)[1:, None]
    pieces.append(start + shares * (point[0] - start))
    bends.append(np.full(len(shares), radius))


def _arcs(
    leave: FloatArray, meet: FloatArray, reach: FloatArray, share: float, widest: float
) -> Iterator[tuple[float, FloatArray]]:
    """Yield ever narrower bends between two lines: radius [m] and points, shape (n, 2)."""
    one, other = leave - meet, reach - meet
    before, behind = float(np.hypot(*one)), float(np.hypot(*other))
    one, other = one / before, other / behind
    cross = one[0] * other[1] - one[1] * other[0]
    turn = math.pi - math.atan2(abs(cross), float(one @ other))
    if not 1e-6 < turn < math.pi - 1e-3:
        return
    # Tangents of a circle of radius r touch it r tan(turn / 2) before where they meet.
    radius = min(widest, min(before, share * behind) / math.tan(turn / 2))
    while radius > _NARROWEST:
        away = radius * math.tan(turn / 2)
        middle = meet + (one + other) / np.hypot(*(one + other)) * radius / math.cos(turn / 2)
        first = meet + away * one - middle
        angles = np.linspace(0.0, turn, math.ceil(radius * turn / _SPACING) + 1)
        angles = angles * np.sign(cross) * -1.0
        c, s = np.cos(angles), np.sin(angles)
        yield radius, middle + np.column_stack([c * first[0] - s * first[1],
                                                s * first[0] + c * first[1]])  # fmt: skip
        radius *= _NARROWER
