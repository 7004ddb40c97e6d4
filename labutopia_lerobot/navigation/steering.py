"""Steering a base that cannot go sideways: back onto a line by turning towards it.

The law of Stanley (Hoffmann, Tomlin, Montemerlo and Thrun, 2007, "Autonomous Automobile Trajectory
Tracking for Off-Road Driving"): the heading is that of the line and an angle towards it, whose
tangent is the distance from the line over the speed.
"""

import math

import numpy as np

from labutopia_lerobot.world import FloatArray

_PULL = 2.0
"""Speed towards the line per distance from it [1/s]; ours, as in `tracking`."""
_SLOWEST = 0.3
"""Speed that the tangent reckons with at least [m/s]; ours: at rest one does not turn away."""
_MOST = math.radians(30.0)
"""Heading error at which it stops to turn [rad]; ours: it leaves the line by centimetres."""


def heading_towards(along: FloatArray, offset: FloatArray, speed: float) -> float:
    """Return the heading that brings a base back onto a line [rad].

    Args:
        along: Direction of the line in which it drives, a unit vector, shape (2,).
        offset: From the base to the nearest point of the line, shape (2,) [m].
        speed: How fast it drives [m/s]; negative in reverse.
    """
    left = float(along[0] * offset[1] - along[1] * offset[0])
    towards = math.atan2(_PULL * left, max(abs(speed), _SLOWEST))
    return math.atan2(along[1], along[0]) + math.copysign(towards, left * speed)


def share_of_speed(off: float) -> float:
    """Return the share of its speed at which it drives with a heading error [rad]."""
    return float(np.clip(1.0 - abs(off) / _MOST, 0.0, 1.0))
