"""Facts about a rod that stirs in a vessel."""

import math
from typing import Protocol

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.substances.filling import Fillable
from labutopia_lerobot.world import OpenVessel, Thing, World


class Filled(OpenVessel, Fillable, Protocol):
    """A vessel with a round mouth whose cavity is known."""


@predicate("{rod} in the {filling_ml:g} ml in {vessel}")
def immersed(world: World, rod: Thing, vessel: Filled, *, filling_ml: float) -> bool:
    """Tip of the rod is in the vessel, below the surface of the liquid.

    Without liquid: below where `filling_ml` millilitres would stand.
    """
    volume = filling_ml * 1e-6 if world.liquid is None else world.liquid.inside[vessel.name]
    surface = vessel.profile.bottom + vessel.profile.depth(volume)
    x, y, z = world.pose(vessel).local(world.pose(rod).position_w)
    return math.hypot(x, y) < vessel.mouth_radius and bool(z < surface)


@predicate("{rod} {by:g} m over {vessel}, within {within:g} m")
def over_mouth(world: World, rod: Thing, vessel: OpenVessel, *, within: float, by: float) -> bool:
    """Tip is more than `by` metres above the mouth, horizontally `within` metres of its middle."""
    x, y, z = world.pose(rod).position_w - world.frame(vessel.rim).position_w
    return math.hypot(x, y) < within and bool(z > by)
