"""The Franka Hand as a MuJoCo spec: two fingers that one drive keeps even.

Frames, masses and the shape of the finger tips are those of `franka_description`
(frankaemika/franka_ros); the force is that of the Franka Hand product manual: 70 N continuous
grasping force. A camera for the wrist is added.
"""

import mujoco

from labutopia_lerobot.robots.fingers import (
    FINGER_ARMATURE,
    add_pad,
    add_wrist_camera,
    couple_fingers,
)
from labutopia_lerobot.robots.franka_hand import FRANKA_HAND
from labutopia_lerobot.robots.parts import (
    add_collision_box,
    add_tones,
    add_visual_mesh,
    set_inertia,
)

_FINGER_OFFSET = 0.0584
"""Slide of the fingers along z of the hand [m]."""
_GRASP_OFFSET = 0.1034
"""Point between the pads along z of the hand [m]."""

_FORCE = 35.0
"""Largest force of each finger [N]; the manual's 70 N is read as the sum of both, as is usual."""

FRANKA_MESHES = "xacro/qut_frankie_description/meshes/visual"
"""Folder of the meshes of `franka_description` in `rtb-data`, in colour."""
FRANKA_FINISH = "franka"
"""Material of all that is Franka's."""

_WHITE = (0.93, 0.93, 0.92)
_GREY = (0.66, 0.68, 0.70)
_ANTHRACITE = (0.27, 0.28, 0.30)
"""Shells, fingers and flange, covers and pads; the shades in the files are 1, 0.92 and 0.25."""

_TONES = ((0.5, _ANTHRACITE), (0.9, _GREY), (0.95, _GREY), (0.98, _WHITE))

_TRIANGLES_HAND = 600
_TRIANGLES_FINGER = 180


def add_franka_hand(spec: mujoco.MjSpec, hand: mujoco.MjsBody) -> None:
    """Build the hand on a body: fingers, pads, gripper servo, grasp site and wrist camera.

    Args:
        spec: The spec of the body; it gets the material `FRANKA_FINISH`, too.
        hand: A body whose frame is that of the hand: z forward, y along the finger motion.
    """
    add_tones(spec, FRANKA_FINISH, *_TONES, specular=0.35, shininess=0.5)
    set_inertia(hand, 0.73, (-0.01, 0.0, 0.03), (0.001, 0.0025, 0.0017, 0.0, 0.0, 0.0))
    add_visual_mesh(spec, hand, f"{FRANKA_MESHES}/hand.dae", _TRIANGLES_HAND, FRANKA_FINISH)
    add_collision_box(hand, "hand_collision", (0.0, 0.0, 0.022), (0.028, 0.1, 0.042))
    # Half a turn from the hand's own axes, so that x, on the side of the camera, is up where joint
    # 7 is in the middle of its range and can tilt a held vessel either way.
    hand.add_site(name=FRANKA_HAND.site, pos=(0, 0, _GRASP_OFFSET), quat=(0, 0, 0, 1), group=4)
    add_wrist_camera(hand, (-0.13, 0.0, 0.02), (0.0, 0.0, 0.17), (0.0, -1.0, 0.0))
    _add_finger(spec, hand, "left", FRANKA_HAND.finger_joints[0], (1, 0, 0, 0))
    _add_finger(spec, hand, "right", FRANKA_HAND.finger_joints[1], (0, 0, 0, 1))
    spec.add_exclude(bodyname1="left_finger", bodyname2="right_finger")
    couple_fingers(spec, FRANKA_HAND, _FORCE)


def _add_finger(
    spec: mujoco.MjSpec,
    hand: mujoco.MjsBody,
    side: str,
    joint: str,
    quat_wxyz: tuple[float, float, float, float],
) -> None:
    """Add a finger that opens along its own +y; the face of its pad is the plane y = 0."""
    finger = hand.add_body(
        name=f"{side}_finger", pos=(0, 0, _FINGER_OFFSET), quat=quat_wxyz, gravcomp=1
    )
    finger.add_joint(
        name=joint,
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=(0, 1, 0),
        range=(0, FRANKA_HAND.element.upper / 2),
        armature=FINGER_ARMATURE,
    )
    set_inertia(finger, 0.015, (0.0, 0.0, 0.0), (2.375e-6, 2.375e-6, 7.5e-7, 0.0, 0.0, 0.0))
    add_visual_mesh(spec, finger, f"{FRANKA_MESHES}/finger.dae", _TRIANGLES_FINGER, FRANKA_FINISH)
    add_collision_box(
        finger, f"{side}_finger_collision", (0.0, 0.0175, 0.018), (0.0105, 0.0085, 0.018)
    )
    add_pad(finger, f"{side}_pad_collision", (0.0, 0.0076, 0.0445), (0.00875, 0.0076, 0.00925))
