"""What the rest of the house needs to know about an arm with a parallel gripper."""

from collections.abc import Callable
from dataclasses import dataclass

import mujoco


@dataclass(frozen=True)
class Robot:
    """An arm with a parallel gripper: what to build, and the names and limits that go with it.

    Attributes:
        name: Short name, also the model name of the spec.
        add_to: Builds the robot into a spec (angles in radians) as a child of a body: base frame at
            the parent's, z up, arm towards +x, no free joint. Each arm joint has a position servo
            of the same name [rad]; the servo `gripper` takes the opening between the pads [m].
        arm_joints: Joint names from base to hand.
        joint_lower: Lower joint limits [rad].
        joint_upper: Upper joint limits [rad].
        joint_velocity_limits: Largest joint speeds [rad/s].
        home: Joint angles at rest [rad].
        reach: How far the hand gets from the base, horizontally [m].
        gripper_max_opening: Largest distance between the pads [m].
        gripper_max_speed: Largest rate of that distance [m/s].
        grasp_site: Site between the pads: z forward, y along the finger motion, x up at home.
        base_body: Root body.
        hand_body: Body that carries the fingers.
        finger_joints: Slides of the fingers; their sum is the opening.
        pads: Geoms of the left and the right finger that touch what is held.
        cameras: Cameras mounted on the robot.
    """

    name: str
    add_to: Callable[[mujoco.MjSpec, mujoco.MjsBody], None]
    arm_joints: tuple[str, ...]
    joint_lower: tuple[float, ...]
    joint_upper: tuple[float, ...]
    joint_velocity_limits: tuple[float, ...]
    home: tuple[float, ...]
    reach: float
    gripper_max_opening: float
    gripper_max_speed: float
    grasp_site: str
    base_body: str
    hand_body: str
    finger_joints: tuple[str, str]
    pads: tuple[str, str]
    cameras: tuple[str, ...]
