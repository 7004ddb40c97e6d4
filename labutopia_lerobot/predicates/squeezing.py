"""Facts about a bottle that is squeezed, and about where its spout points."""

from typing import Protocol

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import OpenVessel, Thing, World


class Squeezable(Thing, Protocol):
    """A bottle with a soft wall and a spout."""

    @property
    def spout(self) -> str:
        """Name of the frame at the end of the spout; z the way that the liquid leaves."""
        ...


def dispensed(bottle: Squeezable, vessel: OpenVessel, *, at_least_ml: float) -> Predicate:
    """No less than this volume [ml] out of the bottle is in the vessel.

    Without liquid: the bottle's wall has displaced that much, and the spout is over the vessel.
    """
    aimed = spout_over(bottle, vessel)

    def holds(world: World) -> bool:
        if world.liquid is None:
            return world.displaced(bottle) * 1e6 >= at_least_ml and aimed.holds(world)
        return world.liquid.from_in(bottle.name, vessel.name) * 1e6 >= at_least_ml

    def off(world: World) -> dict[str, float]:
        if world.liquid is None:
            return {}
        return {"ml": abs(1e6 * world.liquid.from_in(bottle.name, vessel.name) - at_least_ml)}

    return Predicate(f"{at_least_ml:g} ml squeezed into {vessel.name}", holds, off)


def spout_over(bottle: Squeezable, vessel: OpenVessel) -> Predicate:
    """Liquid that falls from the spout falls into the vessel: it is above the mouth, inside it."""

    def holds(world: World) -> bool:
        spout, rim = world.frame(bottle.spout), world.frame(vessel.rim)
        x, y, z = spout.position_w - rim.position_w
        return bool(np.hypot(x, y) < vessel.mouth_radius and z > 0.0)

    return Predicate(f"spout of {bottle.name} over {vessel.name}", holds)
