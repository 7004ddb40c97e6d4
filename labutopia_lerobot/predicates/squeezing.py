"""Facts about a bottle that is squeezed, and about where its spout points."""

import math
from collections.abc import Mapping
from typing import Protocol

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import OpenVessel, Thing, World


class Squeezable(Thing, Protocol):
    """A bottle with a soft wall and a spout."""

    @property
    def squeezed(self) -> str:
        """Name of the reading of the volume that has left it [ml]."""
        ...

    @property
    def spout(self) -> str:
        """Name of the frame at the end of the spout; z the way that the liquid leaves."""
        ...


@predicate("{at_least_ml:g} ml squeezed out of {bottle} into {vessel}")
def dispensed(world: World, bottle: Squeezable, vessel: OpenVessel, *, at_least_ml: float) -> bool:
    """No less than this volume [ml] out of the bottle is in the vessel.

    Without liquid: the bottle's wall has displaced that much, and the spout is over the vessel.
    """
    if world.liquid is None:
        enough = world.reading(bottle.squeezed).value >= at_least_ml
        return enough and spout_over(bottle, vessel).holds(world)
    return world.liquid.from_in(bottle.name, vessel.name) * 1e6 >= at_least_ml


@dispensed.measure
def _amount_errors(
    world: World, bottle: Squeezable, vessel: OpenVessel, *, at_least_ml: float
) -> Mapping[str, float]:
    if world.liquid is None:
        return {}
    return {"ml": abs(1e6 * world.liquid.from_in(bottle.name, vessel.name) - at_least_ml)}


@predicate("spout of {bottle} over {vessel}")
def spout_over(world: World, bottle: Squeezable, vessel: OpenVessel) -> bool:
    """Liquid that falls from the spout falls into the vessel: it is above the mouth, inside it."""
    x, y, z = world.frame(bottle.spout).position_w - world.frame(vessel.rim).position_w
    return math.hypot(x, y) < vessel.mouth_radius and bool(z > 0.0)
