"""A robot of six joints that no file of the package knows."""

import math

import mujoco

from labutopia_lerobot.robots import Element, Robot
from labutopia_lerobot.robots.franka_hand import FRANKA_HAND
from labutopia_lerobot.robots.franka_hand_model import add_franka_hand
from labutopia_lerobot.robots.parts import add_joint_servo
from labutopia_lerobot.world import Approach

JOINTS = tuple(Element(f"axis{i}", -3.0, 3.0, 2.0 + 0.1 * i, 10.0, 5000.0) for i in range(6))
# Axis, place of the link on the one before [m], end of the link [m]: a turret, upper arm, forearm
# and three axes of a wrist, as most arms in industry have them.
LINKS = (
    ((0, 0, 1), (0.0, 0.0, 0.10), (0.0, 0.0, 0.20)),
    ((0, 1, 0), (0.0, 0.0, 0.20), (0.0, 0.0, 0.42)),
    ((0, 1, 0), (0.0, 0.0, 0.42), (0.35, 0.0, 0.0)),
    ((1, 0, 0), (0.35, 0.0, 0.0), (0.08, 0.0, 0.0)),
    ((0, 1, 0), (0.08, 0.0, 0.0), (0.06, 0.0, 0.0)),
    ((1, 0, 0), (0.06, 0.0, 0.0), (0.04, 0.0, 0.0)),
)


def build(spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> None:
    """An arm of six joints, after a fan with a motor of its own, which is no element of it."""
    body = parent.add_body(name="socket", gravcomp=1)
    fan = body.add_body(name="fan", pos=(-0.2, 0, 0.1))
    fan.add_joint(name="fan", axis=(0, 0, 1))
    fan.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.01, 0.01), contype=0, conaffinity=0)
    spec.add_actuator(name="fan", target="fan", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    for joint, (axis, place, end) in zip(JOINTS, LINKS, strict=True):
        body = body.add_body(name=f"{joint.name}_link", pos=place, gravcomp=1)
        limits = (joint.lower, joint.upper)
        body.add_joint(name=joint.name, axis=axis, range=limits, armature=0.1, damping=1.0)
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=(0, 0, 0, *end),
            size=(0.04, 0, 0),
            mass=1.5,
            contype=0,
            conaffinity=0,
        )
        add_joint_servo(spec, joint, stiffness=2000.0, damping=60.0, force=100.0)
    half = math.sqrt(0.5)  # of the hand: z along the last axis, fingers side by side
    hand = body.add_body(name="hand", pos=(0.06, 0, 0), quat=(half, 0, half, 0), gravcomp=1)
    add_franka_hand(spec, hand)


SIX = Robot(
    name="six",
    add_to=build,
    arm=JOINTS,
    gripper=FRANKA_HAND,
    home=(0.3, -0.3, 0.3, 0.0, 0.0, 0.0),
    elbow="axis2",
    reach=0.9,
    hand_speed=1.7,
    base_body="socket",
    vessel_approach=Approach(yaw=0.0, pitch=0.1),
    handle_approach=Approach(yaw=0.0, pitch=0.1),
    deep_approach=Approach(yaw=0.0, pitch=1.5),
)
