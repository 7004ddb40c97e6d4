"""What the hands share: soft pads on two fingers, one drive that keeps these even, a camera."""

import mujoco
import numpy as np

from labutopia_lerobot.robots.parts import Vector, add_collision_box, add_servo
from labutopia_lerobot.robots.robot import ParallelGripper

_STIFFNESS = 3500.0
"""A target 10 mm below the width of a vessel gives the full force of 35 N [N/m]."""
_DAMPING = 100.0
"""Lets the fingers lag by damping / stiffness = 29 ms, one 30 Hz control step [N s/m]."""
FINGER_ARMATURE = 0.5
"""Mass of the drive felt at a finger [kg]: not published. With 0.1 the servo's damping outweighed
the fingers sixfold in a physics step, and pads that met a heavy flask bounced off and struck it."""


def add_pad(finger: mujoco.MjsBody, name: str, centre: Vector, half: Vector) -> None:
    """Add the pad of a finger, a box that what is held does not slip out of.

    Args:
        finger: The finger.
        name: Name of the geom.
        centre: Centre in the finger's frame [m].
        half: Half lengths along the axes of that frame [m].
    """
    pad = add_collision_box(finger, name, centre, half)
    # Tables give 1.0 for rubber on concrete and 0.94 for glass on glass (Serway and Jewett,
    # "Physics for Scientists and Engineers", table 5.1); smooth rubber on clean glass holds no
    # worse. The priority lets the pad decide, not what it holds. Contact dimension 4 adds friction
    # against spin about the normal, of a patch a few millimetres wide.
    pad.friction = (1.0, 0.005, 0.0001)
    pad.condim = 4
    pad.priority = 1
    # Harder than MuJoCo's defaults of 20 ms and 0.9 to 0.95: the full force sank the pads 0.44 mm
    # into a flask, now 0.10 mm. From 0.99 to 0.995 on they lose contact for steps and strike.
    pad.solref = (0.008, 1)
    pad.solimp = (0.98, 0.99, 0.0005, 0.5, 2)


def couple_fingers(spec: mujoco.MjSpec, gripper: ParallelGripper, force: float) -> None:
    """Keep the fingers even and drive their opening, the sum of both slides, by one servo.

    Args:
        spec: The spec; it has the slides.
        gripper: Names and limits.
        force: Largest force of each finger [N].
    """
    opening = spec.add_tendon(name="opening")
    for joint in gripper.finger_joints:
        opening.wrap_joint(joint, 1.0)
    add_servo(
        spec,
        name=gripper.element.name,
        target="opening",
        transmission=mujoco.mjtTrn.mjTRN_TENDON,
        control=(gripper.element.lower, gripper.element.upper),
        stiffness=_STIFFNESS,
        damping=_DAMPING,
        force=force,
    )
    one_to_one = np.zeros(mujoco.mjNEQDATA)
    one_to_one[1] = 1.0
    spec.add_equality(
        type=mujoco.mjtEq.mjEQ_JOINT,
        name1=gripper.finger_joints[0],
        name2=gripper.finger_joints[1],
        data=one_to_one,
        solref=(0.01, 1),
    )


def add_wrist_camera(hand: mujoco.MjsBody, eye: Vector, target: Vector, right: Vector) -> None:
    """Mount a camera above the hand, looking down past the fingers at what is held.

    LabUtopia's own hangs 0.2 m above the hand's axis and sees 93 degrees; this one is close enough
    for a bracket and keeps the hand out of most of the image.

    Args:
        hand: The hand, in whose frame all is said.
        eye: Where the camera is [m].
        target: What it looks at [m].
        right: Direction that is to the right in its picture, square to that in which it looks.
    """
    backward = np.subtract(eye, target)
    backward /= np.linalg.norm(backward)
    rotation = np.column_stack([right, np.cross(backward, right), backward])
    quat_wxyz = np.empty(4)
    mujoco.mju_mat2Quat(quat_wxyz, rotation.ravel())
    hand.add_camera(name="wrist", pos=eye, quat=quat_wxyz, fovy=75)
