"""Where liquid is that has just left a spout or a tip: ahead of it, and in nothing."""

import math

import numpy as np

from labutopia_lerobot.liquids.surroundings import Surroundings
from labutopia_lerobot.world import FloatArray, Pose

_GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
"""Angle from particle to particle about the axis [rad]: they fill a disc evenly (Vogel, 1979)."""

_MOUTH = 0.002
"""How far within an outlet its liquid may be where something shuts it [m]; ours: more than one is
pressed into a thing."""


def stream(
    outlet: Pose,
    way: FloatArray,
    along: FloatArray,
    spacing: float,
    around: Surroundings,
    bore_area: float = 0.0,
) -> FloatArray:
    """Return where particles are that have just left an outlet.

    Where something is in their way they are before it, closer behind each other and so much further
    beside each other.

    Args:
        outlet: What they left; z the way that they go.
        way: Along its z axis, shape (3,), of any length.
        along: How many times that they have gone, evenly from half a step on, shape (n, 1).
        spacing: Edge of the cube that a particle's volume fills [m].
        around: What may be in the way.
        bore_area: How wide the outlet is [m^2]; they leave it in single file where they are wider
            than half of it.

    Returns:
        Shape (n, 3), metres, world frame.
    """
    count, end, step = len(along), float(along[0, 0] + along[-1, 0]), float(np.linalg.norm(way))
    width = max(0.0, math.sqrt(bore_area / math.pi) - spacing / 2)
    within = outlet.position_w - _MOUTH * outlet.z_axis
    share = around.free_way(within, outlet.position_w + end * way)
    free = share * (_MOUTH + end * step) - _MOUTH
    if free >= end * step:
        return outlet.position_w + along * way + _disc(outlet, width, count)
    first = min(0.0, free - _MOUTH / 2)
    axis = outlet.position_w + (first + (free - first) * along / end) * outlet.z_axis
    width = max(width, math.sqrt(count * spacing**3 / (math.pi * (free - first))))
    beside = _disc(outlet, width, count)
    shares = [around.free_way(at, at + 2 * aside) for at, aside in zip(axis, beside, strict=True)]
    before: FloatArray = axis + np.array(shares)[:, None] * beside
    return before


def _disc(outlet: Pose, radius: float, count: int) -> FloatArray:
    """Return points that fill a disc [m] around the middle of an outlet, shape (count, 3)."""
    number = np.arange(count)
    out, turn = radius * np.sqrt((number + 0.5) / count), _GOLDEN * number
    across = np.column_stack([out * np.cos(turn), out * np.sin(turn)])
    points: FloatArray = across @ outlet.rotation_w[:, :2].T
    return points
