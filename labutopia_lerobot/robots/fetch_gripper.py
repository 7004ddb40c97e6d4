"""The gripper of the Fetch: names, limits and what skills need to know.

[URDF] `fetch_description` (ZebraDevs/fetch_ros): 50 mm and 50 mm/s per finger.
[MJCF] `fetch/robot.xml` of gymnasium-robotics: fingers of 77 x 14 x 27 mm, the point between them.
"""

from labutopia_lerobot.robots.element import Element
from labutopia_lerobot.robots.robot import ParallelGripper

FETCH_GRIPPER = ParallelGripper(
    # No acceleration is published: full speed after 0.1 s, and jerk over acceleration as of the
    # Panda's joints, as for the Franka Hand.
    element=Element("gripper", lower=0.0, upper=0.10, speed=0.1, acceleration=1.0, jerk=500.0),
    finger_reach=0.0185,  # half a finger's length less the offset of the point between [MJCF]
    finger_thickness=0.014,
    site="grasp",
    body="gripper_link",
    finger_joints=("left_finger_joint", "right_finger_joint"),
    pads=("left_pad_collision", "right_pad_collision"),
)
