"""Stirring: liquid is drawn towards the vortex around what turns in it."""

import math

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.world import FloatArray

SHARE = 0.25
"""Angular speed of the liquid within the stirrer's radius, in parts of the stirrer's; ours. A bar
slips through the liquid: at 600 rpm its core turns with 150 rpm, and dips by 4 mm at 25 mm."""
LAG = 0.5
"""Time constant with which the liquid is drawn along [s]; ours: beakers spin up within seconds."""


def stir(
    velocities: FloatArray,
    positions: FloatArray,
    wet: NDArray[np.bool_],
    at: FloatArray,
    speed: float,
    radius: float,
    duration: float,
) -> None:
    """Draw liquid towards a vortex with an upright axis.

    Within the radius of the stirrer the vortex is a rigid one, beyond it is free (Rankine). Only
    what goes round is drawn along: up, down and outwards the liquid goes as it does.

    Args:
        velocities: Shape (n, 3), m/s; changed in place.
        positions: Shape (n, 3), metres.
        wet: Which particles feel it, shape (n,).
        at: A point on the axis, shape (3,) [m].
        speed: Of the stirrer [rad/s], counterclockwise as seen from above.
        radius: Of the stirrer [m].
        duration: For how long [s].
    """
    off = positions[wet, :2] - at[:2]
    aside = np.maximum(np.hypot(off[:, 0], off[:, 1]), 1e-9)
    around = np.column_stack([-off[:, 1], off[:, 0]]) / aside[:, None]
    wanted = SHARE * speed * np.minimum(aside, radius**2 / aside)
    lacking = wanted - np.sum(velocities[wet, :2] * around, axis=1)
    gained = -math.expm1(-duration / LAG) * lacking
    velocities[wet, :2] += gained[:, None] * around
