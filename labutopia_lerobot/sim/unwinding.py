"""Arms that have wound themselves up go back to where they started, and try again."""

import numpy as np

from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_AT_END = 0.01
"""Distance from the end of its range from which on a joint is wound up [rad]; ours."""
_STILL = 0.06 / CONTROL_HZ
"""Greatest change of a joint in a control period of an arm that stands [rad]; ours."""
_PATIENCE = CONTROL_HZ // 2
"""Control periods that an arm stands wound up until it goes back; ours."""


class Unwinding:
    """Says when an arm is to go back: it stands with a joint at an end of its range.

    Differential kinematics goes the nearest way, and from some starts that ends there, short of the
    target, where another turn of the wrist would have led on.

    Attributes:
        active: Whether the arm is on its way back.

    Args:
        robot: Whose arm it is.
    """

    def __init__(self, robot: Robot) -> None:
        joints = robot.roles.joints
        self._least = np.array(robot.lower[joints]) + _AT_END
        self._greatest = np.array(robot.upper[joints]) - _AT_END
        self.begin()

    def begin(self) -> None:
        """Forget what the arm did."""
        self.active = False
        self._stands = 0

    def see(self, joints: FloatArray, change: FloatArray, *, short: bool) -> None:
        """Look at a command.

        Args:
            joints: Where they are, shape (joints,) [rad].
            change: What the command changes, shape (joints,) [rad].
            short: Whether the hand is short of its target, and free to go back.
        """
        still = bool(np.abs(change).max() < _STILL)
        at_end = bool(((joints < self._least) | (joints > self._greatest)).any())
        self._stands = self._stands + 1 if still and at_end and short else 0
        self.active = not still if self.active else self._stands >= _PATIENCE
