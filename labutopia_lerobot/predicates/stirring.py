"""Facts about a rod that stirs in a vessel."""

from typing import Protocol

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.substances.filling import Fillable
from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World


class Filled(OpenVessel, Fillable, Protocol):
    """A vessel with a round mouth whose cavity is known."""


def immersed(rod: Thing, vessel: Filled, *, filling_ml: float) -> Predicate:
    """Tip of the rod is in the vessel, below the surface of the liquid.

    Without liquid: below where `filling_ml` millilitres would stand.
    """

    def holds(world: World) -> bool:
        volume = filling_ml * 1e-6 if world.liquid is None else world.liquid.inside[vessel.name]
        surface = vessel.profile.bottom + vessel.profile.depth(volume)
        x, y, z = (world.pose(vessel).inverse() @ world.pose(rod)).position_w
        return bool(np.hypot(x, y) < vessel.mouth_radius and z < surface)

    return Predicate(f"{rod.name} in the {filling_ml:g} ml in {vessel.name}", holds)


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
