"""Straightening of a path: of its points only those stay at which it has to turn."""

import numpy as np

from labutopia_lerobot.navigation.clearance import Clearance
from labutopia_lerobot.world import FloatArray

_SAME = 1e-9
"""Difference of prices that is rounding [m]."""


def shortened(points: FloatArray, clearance: Clearance) -> FloatArray:
    """Return the cheapest of the paths along some of the points of a path, shape (m, 2) [m].

    Both ends stay. Straight lines that the robot cannot go along are infinitely dear, so that the
    path that comes in is the worst that can come out: shortest paths in a graph without circles.

    Args:
        points: Of a path that passes, first to last, shape (n, 2) [m], room frame.
        clearance: Where the robot can go, and what that costs.
    """
    points = points[_turns(points)]
    cheapest = np.full(len(points), np.inf)
    cheapest[0] = 0.0
    before = np.arange(-1, len(points) - 1)
    for end in range(1, len(points)):
        for start in range(end):
            straight = float(np.hypot(*(points[end] - points[start])))
            if cheapest[start] + straight >= cheapest[end] - _SAME:
                continue  # no line costs less than its length
            price = cheapest[start] + clearance.line_price(points[start], points[end])
            if price < cheapest[end] - _SAME:
                cheapest[end], before[end] = price, start
    kept = [len(points) - 1]
    while kept[-1] > 0:
        kept.append(int(before[kept[-1]]))
    shorter: FloatArray = points[kept[::-1]]
    return shorter


def _turns(points: FloatArray) -> list[int]:
    """Return the first point, the last, and those where the direction changes."""
    along = np.diff(points, axis=0)
    across = along[:-1, 0] * along[1:, 1] - along[:-1, 1] * along[1:, 0]
    corners = np.flatnonzero(np.abs(across) > 1e-9) + 1
    return [0, *corners.tolist(), len(points) - 1]
