"""The gripper of the Fetch as a MuJoCo spec: two fingers that one drive keeps even.

[URDF] `fetch_description` (ZebraDevs/fetch_ros): masses, 60 N.
[MJCF] `fetch/robot.xml` of gymnasium-robotics: the fingers are boxes; the point between them.

A camera for the wrist is added.
"""

import math

import mujoco

from labutopia_lerobot.robots.fetch_gripper import FETCH_GRIPPER
from labutopia_lerobot.robots.fingers import (
    FINGER_ARMATURE,
    add_pad,
    add_wrist_camera,
    couple_fingers,
)
from labutopia_lerobot.robots.parts import Vector, add_collision_box, set_inertia
from labutopia_lerobot.world.model import VISUAL_GROUP

_FORCE = 30.0
"""Largest force of each finger [N]; the 60 N of [URDF] are read as the sum of both."""
_HALF = (0.0385, 0.007, 0.0135)
"""Half lengths of a finger [m] [MJCF]."""
_BETWEEN = 0.02
"""Point between the pads along x of the gripper [m] [MJCF]."""


def add_fetch_gripper(spec: mujoco.MjSpec, gripper: mujoco.MjsBody, material: str) -> None:
    """Build it on a body: palm, fingers, pads, servo, grasp site and wrist camera.

    Args:
        spec: The spec of the body.
        gripper: A body whose frame is that of the gripper: x forward, y along the finger motion.
        material: Of the fingers.
    """
    set_inertia(
        gripper, 1.5175, (-0.0900, -0.0001, -0.0017), (0.0013, 0.0019, 0.0024, 0.0, 0.0, 0.0)
    )
    add_collision_box(gripper, "palm_collision", (-0.093, 0.0, 0.0), (0.061, 0.063, 0.040))
    half = math.sqrt(0.5)
    gripper.add_site(
        name=FETCH_GRIPPER.site, pos=(_BETWEEN, 0, 0), quat=(0, half, 0, half), group=4
    )
    eye: Vector = (_BETWEEN - 0.083, 0.0, 0.13)
    add_wrist_camera(gripper, eye, (_BETWEEN + 0.067, 0.0, 0.0), (0.0, -1.0, 0.0))
    left, right = FETCH_GRIPPER.finger_joints
    _add_finger(gripper, "left", left, (1, 0, 0, 0), material)
    _add_finger(gripper, "right", right, (0, 1, 0, 0), material)
    spec.add_exclude(bodyname1="left_finger", bodyname2="right_finger")
    couple_fingers(spec, FETCH_GRIPPER, _FORCE)


def _add_finger(
    gripper: mujoco.MjsBody,
    side: str,
    joint: str,
    quat_wxyz: tuple[float, float, float, float],
    material: str,
) -> None:
    """Add a finger that opens along its own +y; the face of its pad is the plane y = 0."""
    finger = gripper.add_body(name=f"{side}_finger", quat=quat_wxyz, gravcomp=1)
    finger.add_joint(
        name=joint,
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=(0, 1, 0),
        range=(0, FETCH_GRIPPER.element.upper / 2),
        armature=FINGER_ARMATURE,
    )
    # A box of that mass: the inertia of [URDF] has an axis without any.
    set_inertia(finger, 0.0798, (0.0, 0.007, 0.0), (6.1e-6, 4.4e-5, 4.1e-5, 0.0, 0.0, 0.0))
    centre = (0.0, _HALF[1], 0.0)
    finger.add_geom(
        name=f"{side}_finger_visual",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=centre,
        size=_HALF,
        material=material,
        mass=0,
        contype=0,
        conaffinity=0,
        group=VISUAL_GROUP,
    )
    add_pad(finger, f"{side}_pad_collision", centre, _HALF)
