"""Facts about what instruments read."""

from collections.abc import Mapping
from typing import Protocol

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import World


class Readable(Protocol):
    """Something that gives a reading, such as a `Process`."""

    @property
    def name(self) -> str:
        """What the world calls the reading."""
        ...


@predicate("{instrument} reads {low:g} to {high:g}")
def reads(world: World, instrument: Readable, *, low: float, high: float) -> bool:
    """The shown value lies between two values, in the unit of the reading; dashes never do."""
    return low <= world.reading(instrument.name).shown <= high


@reads.measure
def _off_range(
    world: World, instrument: Readable, *, low: float, high: float
) -> Mapping[str, float]:
    reading = world.reading(instrument.name)
    return {reading.unit: abs(reading.value - (low + high) / 2)}


@predicate("{instrument} settled")
def settled(world: World, instrument: Readable) -> bool:
    """The instrument says that its reading stays."""
    return world.reading(instrument.name).settled
