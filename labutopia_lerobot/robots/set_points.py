"""From commands, thirty a second, to set-points for the servos at every physics step.

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

SUBSTEPS = PHYSICS_HZ // CONTROL_HZ
"""Physics steps in a control period."""

SPAN = 4
"""Commands that act at any time."""


def _basis() -> FloatArray:
    """Return the weights of the commands at the end of each physics step, (SUBSTEPS, SPAN)."""
    t = np.arange(1, SUBSTEPS + 1) / SUBSTEPS
    falling = (1.0 - t) ** 3
    first = 3.0 * t**3 - 6.0 * t**2 + 4.0
    second = -3.0 * t**3 + 3.0 * t**2 + 3.0 * t + 1.0
    return np.column_stack([falling, first, second, t**3]) / 6.0


_BASIS = _basis()


def set_points(commands: FloatArray) -> FloatArray:
    """Return the set-points of a control period, shape (SUBSTEPS, elements) [rad or m].

    Args:
        commands: The last four, the oldest first, shape (SPAN, elements).
    """
    oldest = commands[0]
    # Relative to the oldest, that what does not move stays what it is to the last bit.
    points: FloatArray = oldest + _BASIS[:, 1:] @ (commands[1:] - oldest)
    return points
