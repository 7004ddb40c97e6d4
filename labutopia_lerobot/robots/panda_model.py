"""The Franka Emika Panda with the Franka Hand as a MuJoCo spec.

Sources of its numbers:

- [FCI] Franka Control Interface documentation, "Robot and interface specifications": modified
  Denavit-Hartenberg parameters, limits of torque.
- [Gaz] C. Gaz, M. Cognetti, A. Oliva, P. Robuffo Giordano, A. De Luca, "Dynamic Identification of
  the Franka Emika Panda Robot With Retrieval of Feasible Parameters Using Penalty-Based
  Optimization", IEEE RA-L 4(4), 2019: masses, centres of mass, inertias and friction, as
  expressed in link frames by `franka_description` (frankaemika/franka_ros).
"""

import math

import mujoco

from labutopia_lerobot.robots.franka_hand_model import (
    FRANKA_FINISH,
    FRANKA_MESHES,
    add_franka_hand,
)
from labutopia_lerobot.robots.parts import (
    Capsule,
    add_capsules,
    add_collision_box,
    add_joint_servo,
    add_visual_mesh,
    set_inertia,
)
from labutopia_lerobot.robots.robot import Robot

_DENAVIT_HARTENBERG = (
    (0.0, 0.333, 0.0),
    (0.0, 0.0, -math.pi / 2),
    (0.0, 0.316, math.pi / 2),
    (0.0825, 0.0, math.pi / 2),
    (-0.0825, 0.384, -math.pi / 2),
    (0.0, 0.0, math.pi / 2),
    (0.088, 0.0, math.pi / 2),
)
"""a [m] and alpha [rad] along and about the x axis of the frame before, d [m] along the joint's own
z axis: rows (a, d, alpha) for joints 1 to 7, modified convention [FCI]."""

_MASS = (0.629769, 4.970684, 0.646926, 3.228604, 3.587895, 1.225946, 1.666555, 0.735522)
"""Masses of links 0 to 7 [kg] [Gaz]."""

_CENTRE_OF_MASS = (
    (-0.041018, -0.00014, 0.049974),
    (0.003875, 0.002081, -0.04762),
    (-0.003141, -0.02872, 0.003495),
    (0.027518, 0.039252, -0.066502),
    (-0.05317, 0.104419, 0.027454),
    (-0.011953, 0.041065, -0.038437),
    (0.060149, -0.014117, -0.010517),
    (0.010517, -0.004252, 0.061597),
)
"""Centres of mass in the frames of links 0 to 7 [m] [Gaz]."""

_INERTIA = (
    (0.00315, 0.00388, 0.004285, 8.2904e-7, 0.00015, 8.2299e-6),
    (0.70337, 0.70661, 0.009117, -0.000139, 0.006772, 0.019169),
    (0.007962, 0.02811, 0.025995, -0.003925, 0.010254, 0.000704),
    (0.037242, 0.036155, 0.01083, -0.004761, -0.011396, -0.012805),
    (0.025853, 0.019552, 0.028323, 0.007796, -0.001332, 0.008641),
    (0.035549, 0.029474, 0.008627, -0.002117, -0.004037, 0.000229),
    (0.001964, 0.004354, 0.005433, 0.000109, -0.001158, 0.000341),
    (0.012516, 0.010027, 0.004815, -0.000428, -0.001196, -0.000741),
)
"""xx, yy, zz, xy, xz, yz about the centres of mass of links 0 to 7 [kg m^2] [Gaz]."""

_CAPSULES: tuple[tuple[Capsule, ...], ...] = (
    (
        ((0.0, 0.0, -0.16), (0.0, -0.025, -0.083), 0.058),
        ((0.0, -0.07, -0.003), (0.0, -0.034, -0.003), 0.06),
    ),
    (
        ((0.0, -0.163, 0.0), (0.0, -0.072, 0.027), 0.058),
        ((0.0, -0.003, 0.071), (0.0, -0.003, 0.032), 0.06),
    ),
    (
        ((0.0, 0.0, -0.099), (0.006, 0.0, -0.064), 0.055),
        ((0.08, 0.034, -0.002), (0.08, 0.054, -0.002), 0.061),
    ),
    (
        ((0.0, 0.0, 0.044), (-0.009, 0.006, 0.037), 0.065),
        ((-0.08, 0.102, 0.0), (-0.08, 0.066, 0.0), 0.055),
    ),
    (
        ((0.0, 0.0, -0.234), (0.0, 0.029, -0.206), 0.055),
        ((0.0, 0.071, -0.165), (0.0, 0.097, -0.06), 0.032),
        ((0.0, 0.041, 0.0), (0.0, 0.086, 0.0), 0.051),
    ),
    (
        ((0.002, 0.002, 0.01), (0.092, -0.014, -0.002), 0.051),
        ((0.068, 0.05, 0.002), (0.091, 0.043, 0.0), 0.041),
    ),
    (
        ((-0.003, -0.002, 0.075), (0.008, 0.006, 0.077), 0.046),
        ((0.029, 0.062, 0.083), (0.061, 0.032, 0.084), 0.021),
    ),
)
"""Collision geometry of links 1 to 7, fitted to the visual meshes by least squares: none of their
surface lies more than 1 cm outside."""

_JOINT_TORQUE = (87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0)
"""Largest joint torques [N m] [FCI]."""

_STIFFNESS = (4500.0, 4500.0, 3500.0, 3500.0, 2000.0, 2000.0, 2000.0)
"""Servo gains [N m/rad]. The real arm's inner position loop is stiffer than any 30 Hz policy can
notice; these sag about a millimetre under a 1 kg vessel, and the servos' natural periods (over
45 ms) stay well above the physics step."""
_DAMPING = (160.0, 185.0, 130.0, 120.0, 35.0, 35.0, 30.0)
"""Servo damping [N m s/rad]: critical, 2 sqrt(k J), for the joint inertias J at home."""
_JOINT_DAMPING = 1.0
"""Passive damping [N m s/rad]. The slope at rest of the friction torques of [Gaz], phi1 phi2 / 4,
lies between 0.7 and 2.0. Their dry part is left out: the real controller compensates it [FCI]."""
_JOINT_ARMATURE = 0.1
"""Inertia of the motors seen through the gears [kg m^2]; not published, a usual estimate."""

_FLANGE_OFFSET = 0.107
"""Distance from joint 7 to the flange along its axis [m] [FCI]."""
_HAND_TURN = -math.pi / 4
"""Turn of the hand on the flange [rad] (franka_description)."""

_LINK_TRIANGLES = 520
"""Triangles of each link's mesh: few, for rendering speed, yet smooth at 256 x 256 pixels."""

# Links that overlap at a joint, or sit two joints apart with little between them. MuJoCo skips
# parent and child by itself, except where the parent is fixed to the world.
_NEIGHBOURS = (
    ("link0", "link1"),
    ("link0", "link2"),
    ("link1", "link3"),
    ("link2", "link4"),
    ("link3", "link5"),
    ("link5", "link7"),
)


def add_panda(spec: mujoco.MjSpec, parent: mujoco.MjsBody, robot: Robot) -> None:
    """Build the arm with its hand onto a body (see `Robot.add_to`)."""
    hand = _add_arm(spec, parent, robot).add_body(
        name=robot.gripper.body,
        pos=(0, 0, _FLANGE_OFFSET),
        quat=(math.cos(_HAND_TURN / 2), 0, 0, math.sin(_HAND_TURN / 2)),
        gravcomp=1,
    )
    for i, joint in enumerate(robot.joints):
        add_joint_servo(spec, joint, _STIFFNESS[i], _DAMPING[i], _JOINT_TORQUE[i])
    add_franka_hand(spec, hand)
    for first, second in _NEIGHBOURS:
        spec.add_exclude(bodyname1=first, bodyname2=second)


def _add_arm(spec: mujoco.MjSpec, parent: mujoco.MjsBody, robot: Robot) -> mujoco.MjsBody:
    """Add the base and the seven links; return the last one."""
    body = parent.add_body(name=robot.base_body, gravcomp=1)
    add_collision_box(body, "link0_collision", (-0.041, 0.0, 0.07), (0.1, 0.08, 0.07))
    _add_mass_and_mesh(spec, body, 0)
    for i, (a, d, alpha) in enumerate(_DENAVIT_HARTENBERG):
        body = body.add_body(
            name=f"link{i + 1}",
            pos=(a, -d * math.sin(alpha), d * math.cos(alpha)),
            quat=(math.cos(alpha / 2), math.sin(alpha / 2), 0, 0),
            gravcomp=1,
        )
        body.add_joint(
            name=robot.joints[i].name,
            axis=(0, 0, 1),
            range=(robot.joints[i].lower, robot.joints[i].upper),
            armature=_JOINT_ARMATURE,
            damping=_JOINT_DAMPING,
        )
        add_capsules(body, _CAPSULES[i])
        _add_mass_and_mesh(spec, body, i + 1)
    return body


def _add_mass_and_mesh(spec: mujoco.MjSpec, body: mujoco.MjsBody, link: int) -> None:
    set_inertia(body, _MASS[link], _CENTRE_OF_MASS[link], _INERTIA[link])
    add_visual_mesh(spec, body, f"{FRANKA_MESHES}/link{link}.dae", _LINK_TRIANGLES, FRANKA_FINISH)
