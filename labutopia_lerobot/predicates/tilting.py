"""Facts about tilting a held vessel."""

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World


def tilted(thing: Thing, *, beyond_deg: float) -> Predicate:
    """Axis of the thing leans more than `beyond_deg` degrees from the vertical."""
    limit = np.radians(beyond_deg)
    return Predicate(
        f"{thing.name} tilted beyond {beyond_deg:g} deg",
        lambda world: world.pose(thing).tilt > limit,
    )


def tilted_left(thing: Thing, *, beyond_deg: float) -> Predicate:
    """The thing leans to the left, seen along the horizontal direction of the hand."""
    limit = np.radians(beyond_deg)
    return Predicate(
        f"{thing.name} tilted left beyond {beyond_deg:g} deg",
        lambda world: _lean(world, thing) > limit,
    )


def tilted_right(thing: Thing, *, beyond_deg: float) -> Predicate:
    """The thing leans to the right, seen along the horizontal direction of the hand."""
    limit = np.radians(beyond_deg)
    return Predicate(
        f"{thing.name} tilted right beyond {beyond_deg:g} deg",
        lambda world: _lean(world, thing) < -limit,
    )


def lip_over(vessel: OpenVessel, target: OpenVessel) -> Predicate:
    """Lowest point of the vessel's lip is above the mouth of the target, inside its edge."""
    return Predicate(
        f"{vessel.name} lip over {target.name}", lambda world: _lip_over(world, vessel, target)
    )


def _lean(world: World, thing: Thing) -> float:
    """Angle from the vertical, positive to the left of the hand's horizontal direction [rad]."""
    forward, axis = world.gripper.z_axis, world.pose(thing).z_axis
    left = np.array([-forward[1], forward[0], 0.0]) / np.hypot(forward[0], forward[1])
    return float(np.arctan2(axis @ left, axis[2]))


def _lip_over(world: World, vessel: OpenVessel, target: OpenVessel) -> bool:
    mouth = world.frame(target.rim).position_w
    offset = _lip(world, vessel) - mouth
    return bool(np.hypot(offset[0], offset[1]) < target.mouth_radius and offset[2] > 0.0)


def _lip(world: World, vessel: OpenVessel) -> FloatArray:
    """Lowest point of the vessel's lip, shape (3,), metres, world frame."""
    rim = world.frame(vessel.rim)
    # The part of "down" that lies in the plane of the rim.
    slope: FloatArray = rim.z_axis * rim.z_axis[2] - (0.0, 0.0, 1.0)
    lip: FloatArray = slope * vessel.mouth_radius / max(float(np.linalg.norm(slope)), 1e-9)
    return rim.position_w + lip
