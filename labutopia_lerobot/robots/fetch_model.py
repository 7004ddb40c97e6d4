"""The Fetch Mobile Manipulator as a MuJoCo spec: base, torso, head, arm.

All frames of its links are parallel to the base's where all joints are zero, x along the arm. The
head looks ahead and does not move.

Sources of its numbers:

- [URDF] `fetch_description` (ZebraDevs/fetch_ros): frames, masses, inertias and torques.
- [MJCF] `fetch/robot.xml` and `shared.xml` of gymnasium-robotics (MIT): which mesh is where, in
  which colour. Its meshes are the coarse ones of [URDF], whose package says CC BY-NC-SA 4.0.
"""

from typing import NamedTuple

import mujoco

from labutopia_lerobot.robots.fetch_base import FETCH_BASE
from labutopia_lerobot.robots.fetch_gripper_model import add_fetch_gripper
from labutopia_lerobot.robots.mesh_package import FETCH_MESHES
from labutopia_lerobot.robots.parts import (
    Capsule,
    Inertia,
    Vector,
    add_capsules,
    add_collision_box,
    add_joint_servo,
    add_visual_mesh,
    set_inertia,
)
from labutopia_lerobot.robots.planar_base import add_planar_base
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.world.model import COLLISION_GROUP


class _Link(NamedTuple):
    """A link of the arm: its joint's axis and place on the link before, mass, shape, colour."""

    place: Vector
    axis: Vector
    mass: float
    centre: Vector
    inertia: Inertia
    capsules: tuple[Capsule, ...]
    material: str


_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_GREY, _WHITE, _BLUE, _RED = "fetch_grey", "fetch_white", "fetch_blue", "fetch_red"
_COLOURS = (
    (_GREY, (0.356, 0.361, 0.376, 1.0)),
    (_WHITE, (0.92, 0.92, 0.92, 1.0)),
    (_BLUE, (0.086, 0.506, 0.767, 1.0)),
    (_RED, (0.8, 0.0, 0.0, 1.0)),
)
"""[MJCF]; its white is 1.0."""

_LINKS = {
    "shoulder_pan": _Link(
        (0.119525, 0.0, 0.34858), _Z,
        2.5587, (0.0927, -0.0056, 0.0564), (0.0043, 0.0087, 0.0087, -0.0001, 0.001, -0.0001),
        (((0.0, 0.0, 0.0), (0.117, -0.01, 0.060), 0.058),), _WHITE,
    ),
    "shoulder_lift": _Link(
        (0.117, 0.0, 0.060), _Y,
        2.6615, (0.1432, 0.0072, -0.0001), (0.0028, 0.0111, 0.0112, -0.0021, 0.0, 0.0),
        (((0.0, 0.018, 0.0), (0.12, 0.005, 0.0), 0.058),), _BLUE,
    ),
    "upperarm_roll": _Link(
        (0.219, 0.0, 0.0), _X,
        2.3311, (0.1165, 0.0014, 0.0), (0.0019, 0.0045, 0.0047, -0.0001, 0.0, 0.0),
        (((0.0, 0.0, 0.0), (0.125, -0.02, 0.0), 0.053),), _WHITE,
    ),
    "elbow_flex": _Link(
        (0.133, 0.0, 0.0), _Y,
        2.1299, (0.1279, 0.0073, 0.0), (0.0024, 0.0082, 0.0084, -0.0016, 0.0, 0.0),
        (((0.0, 0.018, 0.0), (0.12, 0.005, 0.0), 0.053),), _BLUE,
    ),
    "forearm_roll": _Link(
        (0.197, 0.0, 0.0), _X,
        1.6563, (0.1097, -0.0266, 0.0), (0.0016, 0.003, 0.0035, -0.0003, 0.0, 0.0),
        (((0.0, 0.0, 0.0), (0.125, -0.035, 0.0), 0.053),), _WHITE,
    ),
    "wrist_flex": _Link(
        (0.1245, 0.0, 0.0), _Y,
        1.725, (0.0882, 0.0009, -0.0001), (0.0018, 0.0042, 0.0042, -0.0001, 0.0, 0.0),
        (((0.0, 0.008, 0.0), (0.065, 0.002, 0.0), 0.053),), _BLUE,
    ),
    "wrist_roll": _Link(
        (0.1385, 0.0, 0.0), _X,
        0.1354, (0.0095, 0.0004, -0.0002), (0.0001, 0.0001, 0.0001, 0.0, 0.0, 0.0),
        (((-0.005, 0.0, 0.0), (0.005, 0.0, 0.0), 0.045),), _WHITE,
    ),
}  # fmt: skip
"""Places [m], masses [kg], centres of mass [m], inertias about these (xx, yy, zz, xy, xz, yz)
[kg m^2] [URDF]; capsules within 15 mm of the meshes."""

_COLUMN = (-0.086875, 0.0, 0.37743)
"""Frame of the torso where it is down, base frame [m] [URDF]."""
_GRIPPER = (0.16645, 0.0, 0.0)
"""Frame of the gripper on the last link [m] [URDF]."""

_TORQUE = (33.82, 131.76, 76.94, 66.18, 29.35, 25.7, 7.36)
"""Largest joint torques [N m] [URDF]."""
_STIFFNESS = (4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0)
"""Servo gains [N m/rad]: those of the Panda, for the same reasons."""
_DAMPING = (270.0, 225.0, 115.0, 120.0, 35.0, 41.0, 29.0)
"""Servo damping [N m s/rad]: critical, 2 sqrt(k J), for the joint inertias J at home."""
_JOINT_DAMPING = 1.0
"""Passive damping [N m s/rad] [URDF]; some of its joints have 5."""
_JOINT_ARMATURE = 0.1
"""Inertia of the motors seen through the gears [kg m^2]; not published, a usual estimate."""
_LIFT_STIFFNESS, _LIFT_DAMPING, _LIFT_FORCE = 3.0e4, 1860.0, 450.0
"""Servo of the torso [N/m], [N s/m], [N]: a kilogram in the hand lowers it by 0.3 mm; critical for
the 33 kg that it lifts; the force is that of [URDF], weight apart."""

_SLIDING, _TURNING = (1.2e4, 700.0), (1.5e3, 200.0)
"""Gains and limits of the base's velocity servos; ours: 125 kg follow within 10 ms; a friction of
0.6 under it."""

_TRIANGLES = 1600
"""More than any link's mesh has but the base's and the head's, which are thinned to as many."""

_NEIGHBOURS = (
    ("torso_fixed", "torso_lift_link"),
    ("base", "torso_lift_link"),
    ("torso_lift_link", "shoulder_lift_link"),
    ("shoulder_pan_link", "upperarm_roll_link"),
    ("upperarm_roll_link", "forearm_roll_link"),
    ("forearm_roll_link", "wrist_roll_link"),
    ("wrist_flex_link", "gripper_link"),
)
"""Links that overlap at a joint, or sit two joints apart with little between them."""


def add_fetch(spec: mujoco.MjSpec, parent: mujoco.MjsBody, robot: Robot) -> None:
    """Build the robot onto a body in the room's frame (see `Robot.add_to`)."""
    for name, rgba in _COLOURS:
        spec.add_material(name=name, rgba=rgba, specular=0.4, shininess=0.3)
    torso = _add_torso(spec, _add_base(spec, parent), robot)
    wrist = _add_arm(spec, torso, robot)
    gripper = wrist.add_body(name=robot.gripper.body, pos=_GRIPPER, gravcomp=1)
    for i, joint in enumerate(robot.arm):
        add_joint_servo(spec, joint, _STIFFNESS[i], _DAMPING[i], _TORQUE[i])
    _draw(spec, gripper, "gripper_link", _WHITE)
    add_fetch_gripper(spec, gripper, _GREY)
    for first, second in _NEIGHBOURS:
        spec.add_exclude(bodyname1=first, bodyname2=second)


def _add_base(spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
    """Add the base with its wheels and the fixed part of the torso; return its body."""
    base = FETCH_BASE
    body = add_planar_base(spec, parent, base, _SLIDING, _TURNING)
    # Chassis, and two wheels 0.187 m to either side of the middle: 4.3542 kg each [URDF].
    mass, wheels = 70.1294, 2 * 4.3542
    across = wheels * 0.18738**2
    inertia = (1.225 + across, 1.2853, 0.987 + across, 0.0099, 0.0062, -0.0034)
    set_inertia(body, mass + wheels, (-0.0031, 0.0, 0.0073), inertia)
    lowest = 0.02  # the floor is clear of it
    body.add_geom(
        name="base_collision",
        type=mujoco.mjtGeom.mjGEOM_CYLINDER,
        pos=(0.0, 0.0, (base.height + lowest) / 2),
        size=(base.size[0] / 2, (base.height - lowest) / 2, 0.0),
        group=COLLISION_GROUP,
    )
    _draw(spec, body, "base_link_collision", _GREY)
    for side, y in (("l", 0.18738), ("r", -0.18738)):
        wheel = body.add_body(name=f"{side}_wheel", pos=(0.0012914, y, 0.055325))
        _draw(spec, wheel, f"{side}_wheel_link_collision", _BLUE)
    fixed = body.add_body(name="torso_fixed", pos=_COLUMN, gravcomp=1)
    set_inertia(
        fixed, 13.2775, (-0.0722, 0.0057, 0.2656), (0.3861, 0.3388, 0.1018, 0.0015, -0.0102, 0.0117)
    )
    add_collision_box(fixed, "torso_fixed_collision", (-0.1, 0.0, 0.212), (0.068, 0.155, 0.231))
    _draw(spec, fixed, "torso_fixed_link", _BLUE)
    return body


def _add_torso(spec: mujoco.MjSpec, base: mujoco.MjsBody, robot: Robot) -> mujoco.MjsBody:
    """Add the place of the arm, fixed to the base, and what lifts it; return the latter."""
    assert robot.torso is not None
    mount = base.add_body(name=robot.base_body, pos=FETCH_BASE.arm)
    down = [a - b for a, b in zip(_COLUMN, FETCH_BASE.arm, strict=True)]
    body = mount.add_body(name="torso_lift_link", pos=down, gravcomp=1)
    body.add_joint(
        name=robot.torso.name,
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=_Z,
        range=(robot.torso.lower, robot.torso.upper),
        damping=100.0,  # [URDF]
    )
    add_joint_servo(spec, robot.torso, _LIFT_STIFFNESS, _LIFT_DAMPING, _LIFT_FORCE)
    set_inertia(
        body, 10.7796, (-0.0013, -0.0009, 0.2935), (0.3354, 0.3354, 0.0954, 0.0, -0.0162, -0.0006)
    )
    add_collision_box(body, "column_collision", (-0.074, 0.0, 0.315), (0.111, 0.171, 0.285))
    add_collision_box(body, "shoulder_collision", (0.105, 0.0, 0.23), (0.066, 0.09, 0.08))
    _draw(spec, body, "torso_lift_link_collision", _WHITE)
    _add_head(spec, body)
    return body


def _add_head(spec: mujoco.MjSpec, torso: mujoco.MjsBody) -> None:
    head = torso.add_body(name="head_pan_link", pos=(0.053125, 0.0, 0.603), gravcomp=1)
    set_inertia(
        head, 2.2556, (0.0321, 0.0161, 0.0390), (0.0129, 0.0095, 0.0184, 0.0002, 0.0007, 0.0)
    )
    add_collision_box(head, "head_collision", (0.036, 0.0, 0.055), (0.161, 0.143, 0.058))
    _draw(spec, head, "head_pan_link_collision", _GREY)
    tilt = head.add_body(name="head_tilt_link", pos=(0.14253, 0.0, 0.057999), gravcomp=1)
    set_inertia(
        tilt, 0.9087, (0.0081, 0.0025, 0.0113), (0.0061, 0.0014, 0.0061, 0.0, 0.0002, -0.0001)
    )
    _draw(spec, tilt, "head_tilt_link_collision", _BLUE)


def _add_arm(spec: mujoco.MjSpec, torso: mujoco.MjsBody, robot: Robot) -> mujoco.MjsBody:
    """Add the seven links; return the last one."""
    body = torso
    for joint, link in zip(robot.arm, _LINKS.values(), strict=True):
        body = body.add_body(name=f"{joint.name}_link", pos=link.place, gravcomp=1)
        body.add_joint(
            name=joint.name,
            axis=link.axis,
            range=(joint.lower, joint.upper),
            armature=_JOINT_ARMATURE,
            damping=_JOINT_DAMPING,
        )
        add_capsules(body, link.capsules)
        set_inertia(body, link.mass, link.centre, link.inertia)
        _draw(spec, body, f"{body.name}_collision", link.material)
    return body


def _draw(spec: mujoco.MjSpec, body: mujoco.MjsBody, mesh: str, material: str) -> None:
    add_visual_mesh(spec, body, f"{mesh}.stl", _TRIANGLES, material, FETCH_MESHES)
