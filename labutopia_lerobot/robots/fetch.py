"""The Fetch Mobile Manipulator: names, limits and what skills need to know.

[FR] Fetch Robotics, data sheet "Fetch Mobile Manipulator": reach, payload.
[URDF] `fetch_description` (ZebraDevs/fetch_ros): ranges, speeds and torques of the joints.
"""

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.fetch_base import FETCH_BASE, FETCH_DIFFERENTIAL_BASE
from labutopia_lerobot.robots.fetch_gripper import FETCH_GRIPPER
from labutopia_lerobot.robots.mesh_package import FETCH_MESHES
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import Approach

if TYPE_CHECKING:
    import mujoco

_RUN_UP_S = 0.4
"""Time from rest to full speed [s]; ours: not published. `fetch_moveit_config` plans with 1.0 to
2.5 rad/s^2, less than half of that; half of the shoulder's torque turns a stretched arm."""
_JERK_SHARE = 500.0
"""Jerk over acceleration [1/s]: not published; that of all axes of the Panda."""
_TURN = math.pi
"""Range of the axes that turn on and on, to either side [rad]; ours: an angle has one number."""


def _joint(name: str, lower: float, upper: float, speed: float) -> Element:
    acceleration = speed / _RUN_UP_S
    return Element(name, lower, upper, speed, acceleration, _JERK_SHARE * acceleration)


_TORSO = _joint("torso_lift", 0.0, 0.38615, 0.1)
_ARM = (
    _joint("shoulder_pan", -1.6056, 1.6056, 1.256),
    _joint("shoulder_lift", -1.221, 1.518, 1.454),
    _joint("upperarm_roll", -_TURN, _TURN, 1.571),
    _joint("elbow_flex", -2.251, 2.251, 1.521),
    _joint("forearm_roll", -_TURN, _TURN, 1.571),
    _joint("wrist_flex", -2.16, 2.16, 2.268),
    _joint("wrist_roll", -_TURN, _TURN, 2.268),
)
"""Range [m or rad] and speed [m/s or rad/s] [URDF]."""


def _add_to(spec: "mujoco.MjSpec", parent: "mujoco.MjsBody") -> None:
    from labutopia_lerobot.robots.fetch_model import add_fetch  # here: it imports mujoco

    add_fetch(spec, parent, FETCH)


FETCH = Robot(
    name="fetch",
    add_to=_add_to,
    arm=_ARM,
    torso=_TORSO,
    gripper=FETCH_GRIPPER,
    home=(0.304, 0.688, -0.563, -0.277, 1.395, 1.545, -1.233, -0.723),
    elbow="elbow_flex",
    # Ours: 0.1 m less than the point between the pads of the stretched arm, which is 1.116 m from
    # the shoulder's axis [URDF]; the 0.9405 m of [FR] do not count shoulder and fingers.
    reach=1.0,
    hand_speed=1.38,  # not published; ours: the shoulder's speed with the arm stretched
    base_body="arm_mount",
    vessel_approach=Approach(yaw=math.radians(-45.0), pitch=math.radians(8.0)),
    handle_approach=Approach(yaw=math.radians(-25.0), pitch=math.radians(15.0)),
    # Turned by half the forearm would be at the end of its range, with the elbow up.
    deep_approach=Approach(yaw=0.0, pitch=math.pi / 2),
    # Measured: after its wrist has turned down the hand swings by 6 cm, there and back in 1.4 s.
    settling=0.5,
    base=FETCH_BASE,
    meshes=FETCH_MESHES,
    trunk=(FETCH_BASE.body, "torso_fixed", "torso_lift_link", "head_pan_link"),
    stowed=(0.345, 0.523, -1.089, 0.215, 2.03, 2.023, -1.822, -0.519),
)

FETCH_DIFFERENTIAL = replace(FETCH, name="fetch_differential", base=FETCH_DIFFERENTIAL_BASE)
"""The same on two driven wheels, as the real one is: it cannot go sideways."""
