"""What a robot's controller does to a command before it acts: make it finite and reachable."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import CONTROL_HZ, FloatArray


class ActionFilter:
    """Clips commands to position and velocity limits and counts what it had to change.

    Attributes:
        applied: The command in force, shape (elements,), float32: what is recorded.
        clipped: Commands of this episode that were beyond a limit.
        nonfinite: Commands of this episode with an infinite or undefined element.
    """

    def __init__(self, robot: Robot) -> None:
        self._names = robot.names
        self._low, self._high = np.array(robot.lower), np.array(robot.upper)
        self._reach = np.array(robot.speed) / CONTROL_HZ

    def start(self, command: FloatArray) -> None:
        """Begin an episode with the command in force, shape (elements,)."""
        self.applied: NDArray[np.float32] = command.astype(np.float32)
        self._target = self.applied
        self.clipped = 0
        self.nonfinite = 0

    def __call__(self, action: NDArray[np.float32]) -> FloatArray:
        """Return the command that acts, shape (elements,); it is exactly representable in float32.

        Raises:
            ValueError: If the action does not have as many elements as the robot.
        """
        action = np.asarray(action, dtype=np.float32)
        if action.shape != self.applied.shape:
            raise ValueError(
                f"An action has shape {self.applied.shape} ({', '.join(self._names)}), "
                f"not {action.shape}"
            )
        finite = np.isfinite(action)
        self._target = wanted = np.where(finite, action, self._target)
        low = np.maximum(self._low, self.applied - self._reach)
        high = np.minimum(self._high, self.applied + self._reach)
        applied = np.clip(wanted, low, high).astype(np.float32)
        self.nonfinite += int(not finite.all())
        self.clipped += int(not np.allclose(applied, wanted, rtol=0.0, atol=1e-6))
        self.applied = applied
        return applied.astype(np.float64)
