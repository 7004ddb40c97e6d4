"""The Franka Emika Panda with the Franka Hand: names, limits and what skills need to know.

[FCI] Franka Control Interface documentation, "Robot and interface specifications".
"""

import math
from typing import TYPE_CHECKING

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.franka_hand import FRANKA_HAND
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world import Approach

if TYPE_CHECKING:
    import mujoco

_JOINTS = (
    Element("joint1", -2.8973, 2.8973, 2.175, 15.0, 7500.0),
    Element("joint2", -1.7628, 1.7628, 2.175, 7.5, 3750.0),
    Element("joint3", -2.8973, 2.8973, 2.175, 10.0, 5000.0),
    Element("joint4", -3.0718, -0.0698, 2.175, 12.5, 6250.0),
    Element("joint5", -2.8973, 2.8973, 2.61, 15.0, 7500.0),
    Element("joint6", -0.0175, 3.7525, 2.61, 20.0, 10000.0),
    Element("joint7", -2.8973, 2.8973, 2.61, 20.0, 10000.0),
)
"""Limits of position [rad], velocity [rad/s], acceleration [rad/s^2] and jerk [rad/s^3] [FCI]."""


def _add_to(spec: "mujoco.MjSpec", parent: "mujoco.MjsBody") -> None:
    from labutopia_lerobot.robots.panda_model import add_panda  # here: it imports mujoco

    add_panda(spec, parent, PANDA)


PANDA = Robot(
    name="panda",
    add_to=_add_to,
    arm=_JOINTS,
    gripper=FRANKA_HAND,
    # Grasp point at (0.45, 0.2, 0.35) m, hand horizontal, turned 60 degrees to the right: one that
    # pointed straight away from the base would need joint 6 beyond its limit.
    home=(0.812, 0.159, 0.067, -2.209, -1.319, 1.318, 0.046),
    elbow="joint4",
    reach=0.855,  # Franka Emika Panda data sheet, "maximum reach"
    hand_speed=1.7,  # [FCI], limits in the Cartesian space: translation
    base_body="link0",
    # Pointing straight ahead, the wrist cannot reach low and level (joint 6 ends at 3.75 rad);
    # turned by 60 degrees all joints stay a fifth of their range from their ends over the whole
    # start region. The wrist behind a level hand reaches 54 mm below it, too far for a beaker of
    # 90 mm; pitched by 7 degrees it passes 15 mm above the bench, and the palm still fits below the
    # beaker's lip.
    vessel_approach=Approach(yaw=math.radians(-60.0), pitch=math.radians(7.0)),
    # Level and straight ahead the wrist cannot reach either; like this no joint comes nearer to its
    # ends than 8 % of its range, measured over a hundred runs of the four tasks.
    handle_approach=Approach(yaw=math.radians(-25.0), pitch=math.radians(20.0)),
    # Turned by half the hand has its joints near their middles, and the elbow is up.
    deep_approach=Approach(yaw=math.pi, pitch=math.pi / 2),
)
