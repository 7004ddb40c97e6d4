"""What an expert pours by: the amount that has arrived, and whether it stays."""

from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.world import Thing, World


class Gauge(Protocol):
    """Something that shows how much has been poured."""

    @property
    def pause_s(self) -> float:
        """Shortest time after which what has left the lip is shown [s]."""
        ...

    def shown(self, world: World) -> float:
        """Return how much has arrived, in the gauge's unit."""
        ...

    def settled(self, world: World) -> bool:
        """Return whether that stays, if nothing more is poured."""
        ...


@dataclass(frozen=True)
class Weighed:
    """A balance below what is poured into.

    Attributes:
        reading: What it reads [g].
        pause_s: Shortest time after which it shows what has left the lip [s]; ours.
    """

    reading: Readable
    pause_s: float = 1.0

    def shown(self, world: World) -> float:
        """Return what the balance reads [g]."""
        return world.reading(self.reading.name).value

    def settled(self, world: World) -> bool:
        """Return whether the balance says that its reading stays."""
        return world.reading(self.reading.name).settled


@dataclass(frozen=True)
class Received:
    """Lines on the glass: how much of one vessel's filling is in another.

    Attributes:
        origin: What it was filled into.
        into: What it is poured into.
        pause_s: Shortest time after which what has left the lip is there [s]; ours: it falls 0.1 m
            in 0.15 s.
    """

    origin: Thing
    into: Thing
    pause_s: float = 0.4

    def shown(self, world: World) -> float:
        """Return what has arrived [ml]."""
        liquid = world.liquid
        return 0.0 if liquid is None else 1e6 * liquid.from_in(self.origin.name, self.into.name)

    def settled(self, world: World) -> bool:
        """Return True: liquid falls sooner than `PourMeasured` looks again, by a drop or so."""
        return True


@dataclass(frozen=True)
class Beyond:
    """What a gauge shows more than at some moment.

    Attributes:
        gauge: The gauge.
        already: What it showed then.
    """

    gauge: Gauge
    already: float

    @property
    def pause_s(self) -> float:
        """Shortest time after which what has left the lip is shown [s]."""
        return self.gauge.pause_s

    def shown(self, world: World) -> float:
        """Return how much more it shows now."""
        return self.gauge.shown(world) - self.already

    def settled(self, world: World) -> bool:
        """Return whether that stays."""
        return self.gauge.settled(world)
