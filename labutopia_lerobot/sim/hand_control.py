"""Moving a robot's hand by its velocity: what a person with a keyboard or a gamepad does."""

from typing import Self

import mink
import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.robots.command_limits import CommandLimits
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.scenes.room import Room
from labutopia_lerobot.sim.scene import add_robot
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

_SHARE = 0.85
"""Share of the robot's speeds and accelerations that is used: commands are never clipped."""


class HandControl:
    """Differential inverse kinematics of a robot alone: it knows of no bench and no labware.

    Args:
        robot: The robot.
        room: Where it stands.
    """

    def __init__(self, robot: Robot, room: Room) -> None:
        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        add_robot(spec, robot, room)
        model = spec.compile()
        self._robot, self._drives = robot, Drives(model, robot)
        self._configuration = mink.Configuration(model)
        self._track = mink.FrameTask(
            robot.gripper.site, "site", position_cost=1.0, orientation_cost=0.3
        )
        still = dict.fromkeys(robot.other_joints, 0.0)
        self._limits = [mink.ConfigurationLimit(model), mink.VelocityLimit(model, still)]
        self._command_limits = CommandLimits(robot, _SHARE)
        self.begin()

    @classmethod
    def of(cls, robot: str, room: str) -> Self:
        """Return the control of a robot in a room, both by name.

        Raises:
            UnknownRobotError: If there is no such robot.
            UnknownRoomError: If there is no such room.
        """
        return cls(load_robot(robot), load_room(room))

    def begin(self) -> None:
        """Go back to where every episode begins."""
        self._before = self._last = np.array(self._robot.start)

    def move(self, velocity_w: FloatArray, turning_b: FloatArray, opening: float) -> FloatArray:
        """Return the command of the next control period, shape (elements,).

        It gathers speed, and brakes when nothing is wanted any more, as fast as the robot can.

        Args:
            velocity_w: Of the point between the pads, shape (3,) [m/s], world frame.
            turning_b: Angular velocity about it, shape (3,) [rad/s], gripper frame.
            opening: How fast the pads part [m/s].
        """
        limits, last, roles = self._command_limits, self._last, self._robot.roles
        least, greatest = limits.changes(self._before, last)
        if np.any(velocity_w) or np.any(turning_b):
            change: FloatArray = np.zeros(len(last))
            change[roles.joints] = self._joints(velocity_w, turning_b) / CONTROL_HZ
        else:
            change = limits.braking(last - self._before)
        change[roles.gripper] = opening / CONTROL_HZ
        self._before, self._last = last, last + np.clip(change, least, greatest)
        return self._last.copy()

    def _joints(self, velocity_w: FloatArray, turning_b: FloatArray) -> FloatArray:
        """Return the velocities of the joints, shape (joints,) [rad/s]."""
        configuration = self._configuration
        qpos = configuration.model.qpos0.copy()
        self._drives.place(qpos, self._last)
        configuration.update(qpos)
        now = configuration.get_transform_frame_to_world(self._robot.gripper.site, "site")
        turned = Rotation.from_rotvec(turning_b / CONTROL_HZ).as_quat(scalar_first=True)
        there = mink.SE3.from_rotation_and_translation(
            now.rotation() @ mink.SO3(turned), now.translation() + velocity_w / CONTROL_HZ
        )
        self._track.set_target(there)
        velocity = mink.solve_ik(
            configuration,
            [self._track],
            1.0 / CONTROL_HZ,
            solver="daqp",
            damping=1e-6,
            limits=self._limits,
        )
        joints: FloatArray = velocity[self._drives.joint_dofs]
        return joints
