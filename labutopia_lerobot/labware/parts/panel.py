"""Frames of things on panels: z into the panel, x up, y to the right of who stands before it."""

import math

from labutopia_lerobot.labware.parts.solid import Quaternion


def leaning(degrees: float) -> Quaternion:
    """Return the orientation of what is on a panel that leans back from upright [deg].

    The panel faces -x, and at 90 degrees up. Scalar-first.
    """
    half = math.radians(90.0 - degrees) / 2
    return (0.0, math.cos(half), 0.0, math.sin(half))


ON_FRONT = leaning(0.0)
ON_TOP = leaning(90.0)
