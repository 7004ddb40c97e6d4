"""Dilute: fill up what a gauge shows to a multiple of it."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.gauge import Beyond, Gauge
from labutopia_lerobot.skills.pour import Pourable
from labutopia_lerobot.skills.pour_measured import PourMeasured
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.world import OpenVessel, World


@dataclass(frozen=True)
class Dilute:
    """Pour until a gauge shows some times what it shows now: who has weighed too much adds more.

    Attributes:
        thing: The vessel in the hand, with what is added.
        into: What it is poured into.
        gauge: What shows how much is in there.
        times: How many times as much it is to show.
        within: How near is near enough, in the gauge's unit.
        coarse: Share of what is added that is shown when the pour eases back; ours: as much again
            is then on its way.
    """

    thing: Pourable
    into: OpenVessel
    gauge: Gauge
    times: float
    within: float
    coarse: float = 0.35

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield as `PourMeasured`."""
        already = self.gauge.shown(world)
        more, added = (self.times - 1.0) * already, Beyond(self.gauge, already)
        pour = PourMeasured(self.thing, self.into, added, more, self.within, coarse=self.coarse)
        yield from pour.phases(world)
