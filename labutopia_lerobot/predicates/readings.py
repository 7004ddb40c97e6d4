"""Facts about what instruments read."""

import math
from collections.abc import Mapping
from typing import Protocol

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import World


class Readable(Protocol):
    """What has a reading: a balance's weighing, a drive, a timer, a scale."""

    @property
    def name(self) -> str:
        """What the world calls its reading."""
        ...


@predicate("{instrument} reads {low:g} to {high:g}")
def reads(world: World, instrument: Readable, *, low: float, high: float) -> bool:
    """Reading of an instrument, rounded as its display does, is within limits, in its unit."""
    shown = world.reading(instrument.name).shown
    return low <= shown <= high


@reads.measure
def _beyond(world: World, instrument: Readable, *, low: float, high: float) -> Mapping[str, float]:
    reading = world.reading(instrument.name)
    if not math.isfinite(reading.value):
        return {}
    return {reading.unit: max(low - reading.shown, reading.shown - high, 0.0)}


@predicate("{instrument} settled")
def settled(world: World, instrument: Readable) -> bool:
    """Instrument says that its reading stays."""
    return world.reading(instrument.name).settled
