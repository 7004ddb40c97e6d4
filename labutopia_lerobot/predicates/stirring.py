"""Facts about a rod that stirs in a vessel."""

from typing import Literal

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World

type Side = Literal["ahead", "left", "behind", "right"]

_SIDES: dict[Side, tuple[float, float]] = {
    "ahead": (1.0, 0.0),
    "left": (0.0, 1.0),
    "behind": (-1.0, 0.0),
    "right": (0.0, -1.0),
}
"""Directions along the x and y axis of the robot's base."""


def dipped(rod: Thing, vessel: OpenVessel, *, by: float) -> Predicate:
    """Tip of the rod is in the vessel, more than `by` metres below its mouth."""

    def holds(world: World) -> bool:
        x, y, z = (world.frame(vessel.rim).inverse() @ world.pose(rod)).position_w
        return bool(np.hypot(x, y) < vessel.mouth_radius and z < -by)

    return Predicate(f"{rod.name} dipped {by:g} m into {vessel.name}", holds)


def over_mouth(rod: Thing, vessel: OpenVessel, *, within: float, by: float) -> Predicate:
    """Tip is more than `by` metres above the mouth, horizontally `within` metres of its middle."""

    def holds(world: World) -> bool:
        x, y, z = _offset(world, rod, vessel)
        return bool(np.hypot(x, y) < within and z > by)

    return Predicate(f"{rod.name} {by:g} m over {vessel.name}", holds)


def off_axis(rod: Thing, vessel: OpenVessel, *, beyond: float) -> Predicate:
    """Tip is, horizontally, further than `beyond` metres from the middle of the vessel's mouth."""
    return Predicate(
        f"{rod.name} {beyond:g} m off the axis of {vessel.name}",
        lambda world: bool(np.hypot(*_offset(world, rod, vessel)[:2]) > beyond),
    )


def on_side(rod: Thing, vessel: OpenVessel, side: Side, *, beyond: float) -> Predicate:
    """Tip is further than `beyond` metres off the vessel's axis, to a side as the robot sees it.

    Each side is a quarter of the circle; from above, ahead, left, behind and right follow one
    another counterclockwise.
    """
    forward, leftward = _SIDES[side]

    def holds(world: World) -> bool:
        base, offset = world.robot_base, _offset(world, rod, vessel)
        direction = forward * base.x_axis + leftward * base.y_axis
        distance = float(np.hypot(*offset[:2]))
        return bool(distance > beyond and offset @ direction > distance * np.sqrt(0.5))

    return Predicate(f"{rod.name} {side} in {vessel.name}", holds)


def moving(thing: Thing, *, above: float) -> Predicate:
    """Centre of mass of the thing moves faster than `above` metres per second."""
    return Predicate(
        f"{thing.name} moving above {above:g} m/s",
        lambda world: bool(np.linalg.norm(world.velocity(thing)) > above),
    )


def _offset(world: World, rod: Thing, vessel: OpenVessel) -> FloatArray:
    """Tip of the rod from the middle of the vessel's mouth, shape (3,), metres, world frame."""
    mouth = world.frame(vessel.rim)
    offset: FloatArray = world.pose(rod).position_w - mouth.position_w
    return offset
