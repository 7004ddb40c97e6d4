"""Inverse kinematics of an attacker's own: straight lines, and nothing in the way counts."""

from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.world import CONTROL_HZ, Pose

type Actions = Iterator[NDArray[np.float32]]
"""What a play commands, control step by control step."""

_DAMPING = 0.01
"""Of the least squares [m or rad per rad]; keeps joints slow near singular postures."""
_ROUNDS = 5


class Arm:
    """Commands the hand of an environment's robot; knows its model and nothing of the labware."""

    def __init__(self, env: LabEnv) -> None:
        self._simulation = simulation = env.workcell.simulation
        self._roles = simulation.scene.robot.roles
        self._model, self._data = simulation.scene.model, mujoco.MjData(simulation.scene.model)
        self._drives = Drives(self._model, simulation.scene.robot)
        self._site = self._model.site(simulation.scene.robot.gripper.site).id
        self.command = simulation.command.copy()
        self._limits = simulation.scene.robot.lower, simulation.scene.robot.upper

    @property
    def pose(self) -> Pose:
        """Where the command in force brings the gripper frame."""
        self._drives.place(self._data.qpos, self.command)
        self._drives.stand(self._data.qpos, self._simulation.base_pose)
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        rotation = self._data.site_xmat[self._site].reshape(3, 3)
        return Pose(self._data.site_xpos[self._site].copy(), rotation.copy())

    def go(self, target: Pose, *, speed: float = 0.25, opening: float | None = None) -> Actions:
        """Move in a straight line, turning on the way, to a gripper pose; `speed` in m/s."""
        start = self.pose
        turn = Rotation.from_matrix(target.rotation_w @ start.rotation_w.T).as_rotvec()
        reach = max(start.distance_to(target) / speed, float(np.linalg.norm(turn)) / 2.0)
        steps = max(1, round(reach * CONTROL_HZ))
        for part in np.arange(1, steps + 1) / steps:
            way = Rotation.from_rotvec(part * turn).as_matrix() @ start.rotation_w
            yield self.at(
                Pose(start.position_w * (1 - part) + part * target.position_w, way), opening
            )

    def stay(self, seconds: float, opening: float | None = None) -> Actions:
        """Keep the hand where it is commanded to be."""
        for _ in range(round(seconds * CONTROL_HZ)):
            if opening is not None:
                self.command[self._roles.gripper] = opening
            yield self.command.astype(np.float32)

    def at(self, target: Pose, opening: float | None = None) -> NDArray[np.float32]:
        """Return the action that brings the gripper frame to a pose, damped least squares."""
        dofs, joints = self._drives.joint_dofs, self._roles.joints
        for _ in range(_ROUNDS):
            now, jacobian = self.pose, np.zeros((6, self._model.nv))
            mujoco.mj_jacSite(self._model, self._data, jacobian[:3], jacobian[3:], self._site)
            turn = Rotation.from_matrix(target.rotation_w @ now.rotation_w.T).as_rotvec()
            error = np.concatenate([target.position_w - now.position_w, turn])
            arm = jacobian[:, dofs]
            damped = arm @ arm.T + _DAMPING**2 * np.eye(6)
            self.command[joints] += arm.T @ np.linalg.solve(damped, error)
            self.command = np.clip(self.command, *self._limits)
        if opening is not None:
            self.command[self._roles.gripper] = opening
        return self.command.astype(np.float32)
