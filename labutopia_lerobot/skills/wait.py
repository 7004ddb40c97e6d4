"""Wait for an instrument or for something to come true, the hand staying where it is."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.skill import Phase, waited
from labutopia_lerobot.world import CONTROL_HZ, Pose, Thing, World


@dataclass(frozen=True)
class WaitUntil:
    """Stand still until something is so.

    Attributes:
        fact: The fact to wait for.
        holding: The thing in the gripper meanwhile, if any.
        at_most_s: How long it may take [s].
    """

    fact: Predicate
    holding: Thing | None = None
    at_most_s: float = 30.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield wait."""
        here, opening = world.gripper, world.commanded_opening
        own = frozenset() if self.holding is None else frozenset({self.holding.name})

        def so(world: World, target: Pose, elapsed: float) -> bool:
            return self.fact.holds(world)

        yield Phase(
            "wait", lambda w: here, opening, so, own, self.holding, timeout_s=self.at_most_s
        )


@dataclass(frozen=True)
class WaitUntilReads:
    """Stand still until an instrument reads between two values, and then for some time.

    Attributes:
        instrument: The instrument that is read.
        low: Least value, in the unit of the reading.
        high: Greatest value.
        seconds: How long the hand stays from then on [s].
        at_most_s: How long it may take until then [s].
    """

    instrument: Readable
    low: float
    high: float
    seconds: float
    at_most_s: float = 30.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield wait and stay."""
        here, opening = world.gripper, world.commanded_opening
        yield Phase("wait", lambda w: here, opening, self._reads, timeout_s=self.at_most_s)
        long = self.seconds + 1.0
        yield Phase("stay", lambda w: here, opening, waited(self.seconds), timeout_s=long)

    def _reads(self, world: World, target: Pose, elapsed: float) -> bool:
        return self.low <= world.reading(self.instrument.name).value <= self.high


@dataclass(frozen=True)
class WaitUntilDue:
    """Stand still until a reading that changes steadily is about to reach a value.

    Attributes:
        instrument: The instrument that is read.
        value: The value that it is to reach, in its unit.
        ahead_s: How long before that the waiting ends [s]: what follows takes that long to act.
        at_most_s: How long is waited [s].
        over_s: Time over which the rate is measured [s].
    """

    instrument: Readable
    value: float
    ahead_s: float
    at_most_s: float
    over_s: float = 2.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield waiting."""
        here, opening, shown = world.gripper, world.commanded_opening, list[float]()

        def due(world: World, target: Pose, elapsed: float) -> bool:
            shown.append(world.reading(self.instrument.name).value)
            first = shown[-1 - round(self.over_s * CONTROL_HZ) :][0]
            rate = (shown[-1] - first) / self.over_s
            return (self.value - shown[-1]) * (self.value - shown[0]) <= 0.0 or (
                abs(self.value - shown[-1]) <= self.ahead_s * abs(rate)
            )

        yield Phase("wait", lambda w: here, opening, due, timeout_s=self.at_most_s)
