"""Wait for something, the hand staying where it is."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.world import CONTROL_HZ, Pose, World


@dataclass(frozen=True)
class WaitUntil:
    """Stand still until a reading that changes steadily is about to reach a value.

    Attributes:
        reading: What is watched.
        value: What it is to reach, in its unit.
        ahead_s: How long before that the waiting ends [s]: what follows takes that long to act.
        at_most_s: How long is waited [s].
        over_s: Time over which the rate is measured [s].
    """

    reading: Readable
    value: float
    ahead_s: float
    at_most_s: float
    over_s: float = 2.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield waiting."""
        here, opening, shown = world.gripper, world.commanded_opening, list[float]()

        def about_there(world: World, target: Pose, elapsed: float) -> bool:
            shown.append(world.reading(self.reading.name).value)
            first = shown[-1 - round(self.over_s * CONTROL_HZ) :][0]
            rate = (shown[-1] - first) / self.over_s
            return (self.value - shown[-1]) * (self.value - shown[0]) <= 0.0 or (
                abs(self.value - shown[-1]) <= self.ahead_s * abs(rate)
            )

        yield Phase("wait", lambda w: here, opening, about_there, timeout_s=self.at_most_s)
