"""Try each: pour a little of what is in the hand into one vessel after the other, and watch."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.skills.gauge import Received
from labutopia_lerobot.skills.pour import Pourable
from labutopia_lerobot.skills.pour_measured import PourMeasured
from labutopia_lerobot.skills.skill import Phase, at
from labutopia_lerobot.world import OpenVessel, Pose, World


@dataclass(frozen=True)
class TryEach:
    """Pour a little, wait whether it shows, and go on to the next one if it does not.

    Attributes:
        thing: The vessel in the hand.
        vessels: What it is poured into, in this order, each with what would show there.
        ml: How much is poured into each.
        within_ml: How near to that is near enough.
        wait_s: How long it is waited for.
    """

    thing: Pourable
    vessels: tuple[tuple[OpenVessel, Predicate], ...]
    ml: float
    within_ml: float
    wait_s: float = 8.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield as `PourMeasured`, and watch, until something shows."""
        for vessel, shows in self.vessels:
            gauge = Received(self.thing, vessel)
            pour = PourMeasured(self.thing, vessel, gauge, self.ml, self.within_ml, drop=0.05)
            yield from pour.phases(world)
            yield self._watching(world, shows)
            if shows.holds(world):
                return

    def _watching(self, world: World, shows: Predicate) -> Phase:
        """Return the phase in which the hand stays until something shows, or long enough."""
        here, opening, own = world.gripper, world.commanded_opening, frozenset({self.thing.name})

        def done(world: World, target: Pose, elapsed: float) -> bool:
            return shows.holds(world) or elapsed >= self.wait_s

        limit = self.wait_s + 1.0
        return Phase("watch", at(here), opening, done, own, self.thing, timeout_s=limit)
