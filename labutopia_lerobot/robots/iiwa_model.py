"""The KUKA LBR iiwa 14 R820 with the Franka Hand as a MuJoCo spec.

All frames of its links are parallel to the base's where all joints are zero; that of link i lies on
the axis of joint i.

Sources of its numbers:

- [KUKA] KUKA, data sheet "LBR iiwa 14 R820": lengths, directions and torques of the axes.
- [Drake] `iiwa14` of Drake's models (RobotLocomotion/drake), as in MuJoCo Menagerie
  (`kuka_iiwa_14`): masses, centres of mass and principal inertias, here turned into the frames
  above. They add up to 30.6 kg; KUKA states 29.9 kg.

Its meshes are those of ROS-Industrial (`kuka_lbr_iiwa_support` of kuka_experimental, Apache-2.0),
which `rtb-data` ships below `xacro/kuka_description`; the coarse ones, of about 600 triangles a
link, are in the format that can be loaded.
"""

import math

import mujoco

from labutopia_lerobot.robots.franka_hand_model import add_franka_hand
from labutopia_lerobot.robots.parts import (
    Capsule,
    Vector,
    add_capsules,
    add_collision_box,
    add_joint_servo,
    add_visual_mesh,
    set_inertia,
)
from labutopia_lerobot.robots.robot import Robot

_AXIS: tuple[Vector, ...] = (
    (0, 0, 1),
    (0, 1, 0),
    (0, 0, 1),
    (0, -1, 0),
    (0, 0, 1),
    (0, 1, 0),
    (0, 0, 1),
)
"""Directions of the joints' axes [KUKA]."""

_RISE = (0.0, 0.36, 0.0, 0.42, 0.0, 0.4, 0.0)
"""Height of each link's frame above the one before [m]: base to shoulder, shoulder to elbow, elbow
to wrist [KUKA]."""

_FLANGE_RISE = 0.126
"""Height of the flange above the wrist [m] [KUKA]."""

_MASS = (5.0, 5.76, 6.35, 3.5, 3.5, 3.5, 1.8, 1.2)
"""Masses of the base and links 1 to 7 [kg] [Drake]."""

_CENTRE_OF_MASS = (
    (-0.1, 0.0, 0.07),
    (0.0, -0.03, 0.2775),
    (-0.0003, 0.042, 0.059),
    (0.0, 0.03, 0.3345),
    (0.0, -0.034, 0.067),
    (-0.0001, -0.021, 0.2605),
    (0.0, 0.0004, 0.0006),
    (0.0, 0.0, 0.101),
)
"""Centres of mass in the frames of the base and links 1 to 7 [m] [Drake]."""

_INERTIA = (
    (0.05, 0.06, 0.03),
    (0.0333, 0.033, 0.0123),
    (0.0305, 0.011, 0.0304),
    (0.025, 0.0238, 0.0076),
    (0.017, 0.006, 0.0164),
    (0.01, 0.0087, 0.00449),
    (0.0049, 0.0036, 0.0047),
    (0.001, 0.001, 0.001),
)
"""xx, yy, zz about the centres of mass of the base and links 1 to 7 [kg m^2] [Drake]."""

_CAPSULES: tuple[tuple[Capsule, ...], ...] = (
    (((0.0, -0.019, 0.208), (0.0, -0.039, 0.372), 0.081),),
    (
        ((0.0, 0.046, -0.006), (0.0, 0.045, 0.013), 0.086),
        ((0.0, 0.055, 0.077), (0.0, 0.0, 0.18), 0.066),
    ),
    (
        ((0.0, 0.014, 0.257), (0.0, -0.003, 0.245), 0.072),
        ((0.0, 0.052, 0.356), (0.0, 0.04, 0.426), 0.069),
    ),
    (
        ((0.0, -0.049, 0.053), (0.0, -0.039, -0.007), 0.07),
        ((0.0, -0.024, 0.138), (0.0, 0.002, 0.158), 0.067),
    ),
    (
        ((0.0, 0.0, 0.211), (0.0, -0.004, 0.231), 0.068),
        ((0.0, -0.034, 0.267), (0.0, -0.063, 0.404), 0.047),
    ),
    (((0.0, -0.004, 0.025), (0.0, 0.003, -0.02), 0.072),),
    (((0.0, -0.002, 0.094), (0.0, 0.002, 0.093), 0.049),),
)
"""Collision geometry of links 1 to 7, fitted to the meshes by least squares: none of their surface
lies more than 12 mm outside."""

_JOINT_TORQUE = (320.0, 320.0, 176.0, 176.0, 110.0, 40.0, 40.0)
"""Largest joint torques [N m] [KUKA]."""

_STIFFNESS = (4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0)
"""Servo gains [N m/rad]: those of the Panda, for the same reasons."""
_DAMPING = (233.0, 194.0, 125.0, 126.0, 32.0, 33.0, 29.0)
"""Servo damping [N m s/rad]: critical, 2 sqrt(k J), for the joint inertias J at home."""
_JOINT_DAMPING = 1.0
"""Passive damping [N m s/rad]: not published, as for the Panda."""
_JOINT_ARMATURE = 0.1
"""Inertia of the motors seen through the gears [kg m^2]; not published, a usual estimate."""

_HAND_TURN = math.pi / 2
"""Turn of the hand on the flange [rad]; upright vessels leave joint 7 near mid-range."""

_MESHES = "xacro/kuka_description/kuka_lbr_iiwa/meshes/lbr_iiwa_14_r820/collision"
_LINK_TRIANGLES = 900
"""More than any of the files has: they are kept as they are."""

_ORANGE, _GREY = "kuka_orange", "kuka_grey"
_COLOURS = (_GREY, _GREY, _ORANGE, _GREY, _ORANGE, _GREY, _ORANGE, "dark")
"""Colours of the base and links 1 to 7; on the real arm only the covers of its bends are orange."""

# Links that overlap at a joint, or sit two joints apart with little between them. MuJoCo skips
# parent and child by itself, except where the parent is fixed to the world.
_NEIGHBOURS = (
    ("base_link", "link1"),
    ("base_link", "link2"),
    ("link1", "link3"),
    ("link2", "link4"),
    ("link3", "link5"),
    ("link4", "link6"),
    ("link5", "link7"),
    ("link6", "hand"),
)


def add_iiwa(spec: mujoco.MjSpec, parent: mujoco.MjsBody, robot: Robot) -> None:
    """Build the arm with its hand onto a body (see `Robot.add_to`)."""
    for name, rgba in (
        (_GREY, (0.78, 0.79, 0.80, 1.0)),
        (_ORANGE, (0.95, 0.42, 0.05, 1.0)),
        ("dark", (0.22, 0.23, 0.25, 1.0)),
    ):
        spec.add_material(name=name, rgba=rgba, specular=0.3, shininess=0.4)
    hand = _add_arm(spec, parent, robot).add_body(
        name=robot.gripper.body,
        pos=(0, 0, _FLANGE_RISE),
        quat=(math.cos(_HAND_TURN / 2), 0, 0, math.sin(_HAND_TURN / 2)),
        gravcomp=1,
    )
    for i, joint in enumerate(robot.joints):
        add_joint_servo(spec, joint, _STIFFNESS[i], _DAMPING[i], _JOINT_TORQUE[i])
    add_franka_hand(spec, hand)
    for first, second in _NEIGHBOURS:
        spec.add_exclude(bodyname1=first, bodyname2=second)


def _add_arm(spec: mujoco.MjSpec, parent: mujoco.MjsBody, robot: Robot) -> mujoco.MjsBody:
    """Add the base and the links; return the last one."""
    body = parent.add_body(name=robot.base_body, gravcomp=1)
    add_collision_box(body, "base_collision", (-0.01, 0.0, 0.079), (0.125, 0.12, 0.079))
    _add_mass_and_mesh(spec, body, 0)
    for i, joint in enumerate(robot.joints):
        body = body.add_body(name=f"link{i + 1}", pos=(0, 0, _RISE[i]), gravcomp=1)
        body.add_joint(
            name=joint.name,
            axis=_AXIS[i],
            range=(joint.lower, joint.upper),
            armature=_JOINT_ARMATURE,
            damping=_JOINT_DAMPING,
        )
        add_capsules(body, _CAPSULES[i])
        _add_mass_and_mesh(spec, body, i + 1)
    return body


def _add_mass_and_mesh(spec: mujoco.MjSpec, body: mujoco.MjsBody, link: int) -> None:
    set_inertia(body, _MASS[link], _CENTRE_OF_MASS[link], (*_INERTIA[link], 0.0, 0.0, 0.0))
    file = f"{_MESHES}/link_{link}.stl" if link else f"{_MESHES}/base_link.stl"
    add_visual_mesh(spec, body, file, _LINK_TRIANGLES, _COLOURS[link])
