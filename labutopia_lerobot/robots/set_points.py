"""Conversion of commands, thirty a second, to set-points for the servos at every physics step.

The commands are the control points of a uniform cubic B-spline in time, which moves on by one
segment per command. Its position lies among the last four commands, its speed, acceleration and
jerk among their first, second and third differences per control period (its derivatives are
B-splines of the differences, and the basis functions are positive and add up to one: Piegl and
Tiller, "The NURBS Book", sections 3.2 and 3.3). So limits of commands are limits of set-points. The
price is one control period: at its end the set-point is the mean of the last three commands,
weighted 1 : 4 : 1, and a command that is kept is reached after three.
"""

import numpy as np

from labutopia_lerobot.world import CONTROL_HZ, FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ

PHYSICS_STEPS = PHYSICS_HZ // CONTROL_HZ
"""Physics steps in a control period."""

SPAN = 4
"""Commands that act at any time."""


def _weights() -> tuple[FloatArray, FloatArray]:
    """Return the weights of the commands at the end of each physics step, and their rates [1/s].

    Both are of shape (PHYSICS_STEPS, SPAN).
    """
    t = np.arange(1, PHYSICS_STEPS + 1) / PHYSICS_STEPS
    ones, none = np.ones_like(t), np.zeros_like(t)
    powers = np.column_stack([ones, t, t**2, t**3])
    slopes = np.column_stack([none, ones, 2.0 * t, 3.0 * t**2]) * CONTROL_HZ
    basis = np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6.0
    return powers @ basis, slopes @ basis


_POSITIONS, _RATES = _weights()


def set_points(commands: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the set-points of a control period [rad or m], and their rates [rad/s or m/s].

    Args:
        commands: The last four, the oldest first, shape (SPAN, elements).

    Returns:
        Two arrays of shape (PHYSICS_STEPS, elements).
    """
    oldest = commands[0]
    # Relative to the oldest, that what does not move stays what it is to the last bit.
    change = commands[1:] - oldest
    return oldest + _POSITIONS[:, 1:] @ change, _RATES[:, 1:] @ change
