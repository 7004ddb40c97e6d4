"""Filtering of a command by a robot's controller before it acts: make it finite and reachable."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.robots.command_limits import CommandLimits
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

if TYPE_CHECKING:
    from labutopia_lerobot.robots.hand_kinematics import HandKinematics

_HAND_SHARE = 0.9
"""Share of the hand's greatest speed that commands may ask for: the hand still gets faster while
joints that move against each other brake, each as fast as it can. Measured over bang-bang commands
to all robots: at most 1.7 m/s."""
_NEGLIGIBLE = 1e-6
"""Change of a command that is not counted as clipping [rad or m]."""


class ActionFilter:
    """Keeps commands within the limits of a robot and counts what it had to change.

    The command follows the actions as far as they move, and closes the gap to them as fast as it
    can and still stop there. Actions that the robot can follow, and still stop before its limits,
    leave no gap and pass unchanged, bit for bit: so does what is recorded, when it is replayed.

    Attributes:
        applied: The command in force, shape (elements,), float32: what is recorded.
        clipped: Commands of this episode that were beyond a limit.
        nonfinite: Commands of this episode with an infinite or undefined element.
    """

    def __init__(self, robot: Robot, hand: "HandKinematics") -> None:
        self._names = robot.names
        self._limits = CommandLimits(robot)
        self._hand, self._joints, self._base = hand, robot.roles.joints, robot.roles.base
        self._fastest = None if robot.base is None else robot.base.limits.speed
        self._of_the_arm = np.ones(len(robot.elements), dtype=np.float32)
        self._of_the_arm[self._base] = 0.0
        self._hand_step = _HAND_SHARE * robot.hand_speed / CONTROL_HZ

    def start(self, command: FloatArray) -> None:
        """Begin an episode with the command in force, shape (elements,)."""
        self.applied: NDArray[np.float32] = command.astype(np.float32)
        self._target = self.applied
        self.clipped = 0
        self.nonfinite = 0

    def __call__(self, action: NDArray[np.float32], commands: FloatArray) -> FloatArray:
        """Return the command that acts, shape (elements,); it is exactly representable in float32.

        Args:
            action: Commanded positions, shape (elements,).
            commands: What has been commanded, the last in the last row, shape (>= 2, elements).

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
        asked = np.where(finite, action, self._target * self._of_the_arm)  # a base stops
        wanted = self._limits.within(self._driven(asked)).astype(np.float32)
        self.applied = applied = self._reachable(wanted, *commands[-2:])
        self._target = wanted
        self.nonfinite += int(not finite.all())
        self.clipped += int((np.abs(applied - asked) > _NEGLIGIBLE).any())
        return applied.astype(np.float64)

    def _driven(self, asked: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return a command whose base is no faster than it can be, whichever way it goes."""
        if self._fastest is None:
            return asked
        driven = asked.copy()
        along = driven[self._base][:2]  # a view
        along *= min(1.0, self._fastest / max(float(np.hypot(*along)), self._fastest))
        return driven

    def _reachable(
        self, wanted: NDArray[np.float32], before: FloatArray, last: FloatArray
    ) -> NDArray[np.float32]:
        """Return the command next to the wanted one that the robot can follow."""
        limits, now, gap = self._limits, last - before, self._target - last
        change = wanted - self._target + limits.closing(gap)
        least, greatest = limits.changes(before, last)
        bounded = np.minimum(np.maximum(change, least), greatest)
        passes = np.abs(bounded - change) + np.abs(gap) <= limits.resolution
        jacobian = self._hand.jacobian((last + now)[self._joints])
        hand = jacobian @ bounded[self._joints]
        if hand @ hand > (self._hand_step + _NEGLIGIBLE) ** 2:
            driving, drives = bounded[self._base], passes[self._base]
            braking = np.clip(limits.braking(now * self._of_the_arm), least, greatest)
            bounded = braking + self._share(jacobian, braking, bounded) * (bounded - braking)
            passes = np.zeros_like(passes)
            bounded[self._base], passes[self._base] = driving, drives
        if passes.all():
            return wanted
        return np.where(passes, wanted, (last + bounded).astype(np.float32))

    def _share(self, jacobian: FloatArray, braking: FloatArray, change: FloatArray) -> float:
        """Return how much of the way from braking to a change leaves the hand slow enough."""
        start = jacobian @ braking[self._joints]
        way = jacobian @ change[self._joints] - start
        a, b, c = way @ way, start @ way, start @ start - self._hand_step**2
        return 0.0 if c > 0.0 else float((np.sqrt(b * b - a * c) - b) / a)
