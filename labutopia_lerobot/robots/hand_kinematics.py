"""Motion of the hand by the motion of the joints."""

import mujoco
import numpy as np

from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import FloatArray


class HandKinematics:
    """The hand of a robot in a model, wherever its joints are commanded to be.

    Args:
        model: A model that the robot has been built into.
        robot: The robot.
    """

    def __init__(self, model: mujoco.MjModel, robot: Robot) -> None:
        self._model, self._data = model, mujoco.MjData(model)
        joints = [model.joint(joint.name) for joint in robot.joints]
        self._joints = np.array([joint.qposadr[0] for joint in joints])
        self._dofs = np.array([joint.dofadr[0] for joint in joints])
        self._site = model.site(robot.gripper.site).id
        self._jacobian = np.empty((3, model.nv))

    def jacobian(self, joints: FloatArray) -> FloatArray:
        """Return the derivative of the grasp point's position, shape (3, joints) [m/rad].

        Args:
            joints: Joint angles [rad].
        """
        self._data.qpos[self._joints] = joints
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_jacSite(self._model, self._data, self._jacobian, None, self._site)
        return self._jacobian[:, self._dofs]
