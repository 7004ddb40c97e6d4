"""Indices of a robot's elements in a compiled model: measuring and commanding, in one place."""

import mujoco
import numpy as np

from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import FloatArray


class Drives:
    """A robot in a model; arrays have the order of `Robot.elements`.

    The model may hold joints and servos of other things, in any order.

    Attributes:
        joint_dofs: Where the velocities of the arm's joints are, shape (joints,).
        lag: Time by which the joints' servos, whose damping brakes every motion, would follow late,
            shape (elements,) [s]: targets that are ahead by as much make them follow in time, all
            joints together. The fingers are to give way, and have none.

    Args:
        model: A model that the robot has been built into.
        robot: The robot.
    """

    def __init__(self, model: mujoco.MjModel, robot: Robot) -> None:
        self._roles, self._elements = robot.roles, len(robot.elements)
        joints = [model.joint(joint.name) for joint in robot.joints]
        fingers = [model.joint(name) for name in robot.gripper.finger_joints]
        self._joints = np.array([joint.qposadr[0] for joint in joints])
        self._fingers = np.array([finger.qposadr[0] for finger in fingers])
        self.joint_dofs = np.array([joint.dofadr[0] for joint in joints])
        self._servos = np.array([model.actuator(name).id for name in robot.names])
        stiffness, damping = (model.actuator_biasprm[self._servos, kind] for kind in (1, 2))
        self.lag: FloatArray = np.zeros(self._elements)
        self.lag[self._roles.joints] = (damping / stiffness)[self._roles.joints]

    def measured(self, data: mujoco.MjData) -> FloatArray:
        """Return joint angles [rad] and the opening [m], the sum of the fingers' slides."""
        positions = np.empty(self._elements)
        positions[self._roles.joints] = data.qpos[self._joints]
        positions[self._roles.gripper] = data.qpos[self._fingers].sum()
        return positions

    def command(self, data: mujoco.MjData, targets: FloatArray) -> None:
        """Give the servos their targets [rad or m]."""
        data.ctrl[self._servos] = targets

    def place(self, qpos: FloatArray, positions: FloatArray) -> None:
        """Write positions [rad or m] into an array like `data.qpos`; the fingers share evenly."""
        qpos[self._joints] = positions[self._roles.joints]
        qpos[self._fingers] = positions[self._roles.gripper] / len(self._fingers)
