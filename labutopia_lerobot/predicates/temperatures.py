"""Facts about heat: how warm something is, and whether a hand is where it burns."""

from collections.abc import Mapping

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import Thing, World


@predicate("{vessel} between {low_c:g} and {high_c:g} C")
def temperature_between(world: World, vessel: Thing, *, low_c: float, high_c: float) -> bool:
    """What a thermometer in a vessel reads [degrees C]: the liquid in it, or else its wall."""
    return low_c <= world.reading(f"{vessel.name}_temperature").value <= high_c


@temperature_between.measure
def _celsius(world: World, vessel: Thing, *, low_c: float, high_c: float) -> Mapping[str, float]:
    return {"c": world.reading(f"{vessel.name}_temperature").value}


@predicate("{vessel} hotter than {than_c:g} C")
def hotter(world: World, vessel: Thing, *, than_c: float) -> bool:
    """What a thermometer in a vessel reads is above a temperature [degrees C]."""
    return world.reading(f"{vessel.name}_temperature").value > than_c


@predicate("hand on a surface above {above_c:g} C")
def on_hot_surface(world: World, *, above_c: float) -> bool:
    """The hand touches a surface that would burn a person's [degrees C]."""
    return world.reading("surface_at_hand").value > above_c
