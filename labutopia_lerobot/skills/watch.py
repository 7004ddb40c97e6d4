"""Keep the hand where it is while an instrument runs."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.skill import Phase, waited
from labutopia_lerobot.world import Pose, World


@dataclass(frozen=True)
class Watch:
    """Wait until an instrument reads between two values, and then for some time.

    Attributes:
        instrument: What is read.
        low: Least value, in the unit of the reading.
        high: Greatest value.
        seconds: How long the hand stays from then on [s].
        patience: How long it may take until then [s].
    """

    instrument: Readable
    low: float
    high: float
    seconds: float
    patience: float = 30.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield wait and stay."""
        here, opening = world.gripper, world.commanded_opening
        yield Phase("wait", lambda w: here, opening, self._reads, timeout_s=self.patience)
        long = self.seconds + 1.0
        yield Phase("stay", lambda w: here, opening, waited(self.seconds), timeout_s=long)

    def _reads(self, world: World, target: Pose, elapsed: float) -> bool:
        return self.low <= world.reading(self.instrument.name).value <= self.high
