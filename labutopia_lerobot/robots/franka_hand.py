"""The Franka Hand, a parallel gripper: names, limits and what skills need to know.

Stroke and speed are those of the Franka Hand product manual: 80 mm between the fingers, 50 mm/s per
finger. It gives no acceleration: chosen are full speed after 0.1 s, and jerk over acceleration as
of the Panda's joints.
"""

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.robot import ParallelGripper

FRANKA_HAND = ParallelGripper(
    element=Element("gripper", lower=0.0, upper=0.08, speed=0.1, acceleration=1.0, jerk=500.0),
    finger_reach=0.009,  # half a pad's height, franka_hand_model
    finger_thickness=0.0152,  # a pad's, franka_hand_model
    site="grasp",
    body="hand",
    finger_joints=("finger_joint1", "finger_joint2"),
    pads=("left_pad_collision", "right_pad_collision"),
)
