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
            joints together. The fingers are to give way, and have none, nor has the base.

    Args:
        model: A model that the robot has been built into.
        robot: The robot.
    """

    def __init__(self, model: mujoco.MjModel, robot: Robot) -> None:
        self._roles, self._elements = robot.roles, len(robot.elements)
        joints = [model.joint(joint.name) for joint in robot.joints]
        fingers = [model.joint(name) for name in robot.gripper.finger_joints]
        base = [] if robot.base is None else [model.joint(name) for name in robot.base.joints]
        self._joints = np.array([joint.qposadr[0] for joint in joints])
        self._fingers = np.array([finger.qposadr[0] for finger in fingers])
        self._base = np.array([joint.qposadr[0] for joint in base], dtype=np.intp)
        self.joint_dofs = np.array([joint.dofadr[0] for joint in joints])
        self._base_dofs = np.array([joint.dofadr[0] for joint in base], dtype=np.intp)
        self._servos = np.array([model.actuator(name).id for name in robot.names])
        servos = self._servos[self._roles.joints]
        stiffness, damping = (model.actuator_biasprm[servos, kind] for kind in (1, 2))
        self.lag: FloatArray = np.zeros(self._elements)
        self.lag[self._roles.joints] = damping / stiffness

    def measured(self, data: mujoco.MjData) -> FloatArray:
        """Return joint angles [rad], the opening [m], the sum of the fingers' slides, velocities.

        Those of a base are in its own frame [m/s and rad/s].
        """
        elements = np.empty(self._elements)
        elements[self._roles.joints] = data.qpos[self._joints]
        elements[self._roles.gripper] = data.qpos[self._fingers].sum()
        if len(self._base):
            elements[self._roles.base] = _turned(data.qvel[self._base_dofs], -self._yaw(data))
        return elements

    def command(self, data: mujoco.MjData, targets: FloatArray) -> None:
        """Give the servos their targets [rad or m, rad/s or m/s]."""
        data.ctrl[self._servos] = targets
        if len(self._base):
            driving = _turned(targets[self._roles.base], self._yaw(data))
            data.ctrl[self._servos[self._roles.base]] = driving

    def place(self, qpos: FloatArray, elements: FloatArray) -> None:
        """Write positions [rad or m] into an array like `data.qpos`; the fingers share evenly."""
        qpos[self._joints] = elements[self._roles.joints]
        qpos[self._fingers] = elements[self._roles.gripper] / len(self._fingers)

    def stand(self, qpos: FloatArray, pose: FloatArray) -> None:
        """Write the pose of the base, x, y [m] and heading [rad], into an array like `data.qpos`.

        Args:
            qpos: The array.
            pose: As `base_pose` has it: empty for an arm on a stand.
        """
        qpos[self._base] = pose

    def base_pose(self, data: mujoco.MjData) -> FloatArray:
        """Return x, y [m] and heading [rad] of the base; empty for an arm on a stand."""
        pose: FloatArray = data.qpos[self._base]
        return pose

    def _yaw(self, data: mujoco.MjData) -> float:
        return float(data.qpos[self._base[2]])


def _turned(velocity: FloatArray, angle: float) -> FloatArray:
    """Return a velocity over the floor in a frame that is turned by the negative of an angle."""
    c, s = np.cos(angle), np.sin(angle)
    x, y, turning = velocity
    return np.array([c * x - s * y, s * x + c * y, turning])
