"""The KUKA LBR iiwa 14 R820 with the Franka Hand: names, limits and what skills need to know.

[KUKA] KUKA, data sheet "LBR iiwa 14 R820": axis data.
"""

import math
from typing import TYPE_CHECKING

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.franka_hand import FRANKA_HAND
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import Approach

if TYPE_CHECKING:
    import mujoco


_RUN_UP_S = 0.25
"""Time from rest to full speed [s]. KUKA publishes no accelerations; the Panda, a lighter arm,
needs 0.13 to 0.29 s."""
_JERK_SHARE = 500.0
"""Jerk over acceleration [1/s]: not published either; that of all axes of the Panda."""


def _axis(name: str, range_deg: float, speed_deg_s: float) -> Element:
    limit, speed = math.radians(range_deg), math.radians(speed_deg_s)
    acceleration = speed / _RUN_UP_S
    return Element(name, -limit, limit, speed, acceleration, _JERK_SHARE * acceleration)


_JOINTS = (
    _axis("joint1", 170.0, 85.0),
    _axis("joint2", 120.0, 85.0),
    _axis("joint3", 170.0, 100.0),
    _axis("joint4", 120.0, 75.0),
    _axis("joint5", 170.0, 130.0),
    _axis("joint6", 120.0, 135.0),
    _axis("joint7", 175.0, 135.0),
)
"""KUKA's axes A1 to A7: range to either side [deg], speed [deg/s] [KUKA]."""


def _add_to(spec: "mujoco.MjSpec", parent: "mujoco.MjsBody") -> None:
    from labutopia_lerobot.robots.iiwa_model import add_iiwa  # here: it imports mujoco

    add_iiwa(spec, parent, IIWA)


IIWA = Robot(
    name="iiwa",
    add_to=_add_to,
    arm=_JOINTS,
    gripper=FRANKA_HAND,
    # Grasp point at (0.45, -0.50, 0.45) m, hand level, turned 70 degrees to the right, the elbow to
    # the left: above what stands on the bench, to the right of doors and drawers that are open.
    home=(0.302, 1.272, -1.521, -1.695, -0.608, 0.263, 0.328),
    elbow="joint4",
    # Flange of the stretched arm, 0.946 m from the shoulder [KUKA], at the height of the bench; the
    # data sheet's "maximum reach" of 0.82 m ends at the wrist.
    reach=0.90,
    hand_speed=1.7,  # not published; that of the Panda, which carries the same hand
    base_body="base_link",
    # Straight ahead the elbow would have to bend further than it can (joint 4). Like this no joint
    # comes nearer to its ends than 4 % of its range, measured over twenty runs of pick and
    # of place. The pitch keeps the wrist, of 72 mm radius, off the bench.
    vessel_approach=Approach(yaw=math.radians(-70.0), pitch=math.radians(9.0)),
    # For the same reason; joint 4 comes as near to its end as 1.0 % of its range when a drawer is
    # opened, 2.7 % when it is closed, measured over twenty runs each. Straighter, or with less
    # pitch, the elbow turns over before an open drawer, and the hand comes in a rush; with more
    # pitch it does not come 8 cm clear of an upright handle.
    handle_approach=Approach(yaw=math.radians(-35.0), pitch=math.radians(26.0)),
    deep_approach=Approach(yaw=math.pi, pitch=math.pi / 2),  # as the Panda
)
