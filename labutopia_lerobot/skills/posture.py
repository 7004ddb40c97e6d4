"""Orientations of the hand and of what it holds in which the robot reaches vessels comfortably."""

import math

import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.world import Approach, FloatArray, Pose, Thing, World

UP = np.array([0.0, 0.0, 1.0])

FROM_ABOVE = Approach(yaw=0.0, pitch=math.pi / 2)
"""The hand points down, the fingers close across the bearing: the pose in which arms are shown."""


def horizontal(direction: FloatArray) -> FloatArray:
    """Return the horizontal part of a direction, shape (3,), as a unit vector."""
    level: FloatArray = direction * (1.0, 1.0, 0.0)
    return level / np.linalg.norm(level)


def hand_at(world: World, point_w: FloatArray, approach: Approach | None = None) -> Pose:
    """Return the gripper pose at a point, shape (3,), metres, world frame, the fingers level.

    The hand (z) points as the approach says, relative to the bearing of the point from the robot's
    base: by default as the robot's arm likes it for vessels, to the right and a little down.

    Args:
        world: Where the robot stands.
        point_w: Where the point between the pads should be.
        approach: Relative to the bearing from the robot's base; the robot's own for vessels when
            None.
    """
    dx, dy, _ = point_w - world.robot_base.position_w
    approach = approach or world.robot.vessel_approach
    return pointing(point_w, math.atan2(dy, dx) + approach.yaw, approach.pitch)


def pointing(point_w: FloatArray, yaw: float, pitch: float) -> Pose:
    """Return the gripper pose at a point whose fingers close horizontally.

    Args:
        point_w: Where the point between the pads should be, shape (3,), metres, world frame.
        yaw: Where the hand points, to the left of the world's x axis [rad].
        pitch: Below the horizontal [rad].
    """
    level = math.cos(pitch)
    forward = np.array([level * math.cos(yaw), level * math.sin(yaw), -math.sin(pitch)])
    side = np.array([math.sin(yaw), -math.cos(yaw), 0.0])
    return Pose(point_w, np.column_stack([np.cross(side, forward), side, forward]))


def upright_in_hand(
    world: World, thing: Thing, point_w: FloatArray, yaw_above: float = 0.0
) -> Pose:
    """Return the pose of a held thing that stands upright at a point with a comfortable hand.

    Args:
        world: Where the thing is in the hand now.
        thing: The held thing.
        point_w: Where the centre of its base should be, shape (3,), metres, world frame.
        yaw_above: How far to the left of the bearing from the robot's base a hand points that
            points down by more than 45 degrees [rad].
    """
    now = world.pose(thing)
    righted, _ = Rotation.align_vectors(UP, now.z_axis)
    # The heading of a hand is that of its forward axis, or of its back if it points down.
    down = righted.apply(world.gripper.z_axis)[2] < -math.cos(math.pi / 4)
    above = Approach(yaw_above, FROM_ABOVE.pitch)
    axis, approach = (0, above) if down else (2, None)
    heading = righted.apply(world.gripper.rotation_w[:, axis])
    wanted = hand_at(world, point_w, approach).rotation_w[:, axis]
    yaw = math.atan2(wanted[1], wanted[0]) - math.atan2(heading[1], heading[0])
    turned = Rotation.from_rotvec(yaw * UP) * righted
    return Pose(point_w, turned.as_matrix() @ now.rotation_w)
