"""Pour onto a balance until it reads a wanted mass."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.pour import Pivot, Pourable
from labutopia_lerobot.skills.skill import Condition, Phase, Target, arrived, carrier, waited
from labutopia_lerobot.world import CONTROL_HZ, OpenVessel, Pose, World

_FURTHEST = math.radians(100.0)
"""Lean at which a beaker counts as empty [rad]."""
_DRY_LEAN = math.radians(35.0)
"""Lean up to which it goes fast [rad]: a vessel that is half full gives nothing yet."""
_STEEPEST = 200.0
"""What vessels give when they lean further, at rest [g/rad]; ours: beakers of 150 and 250 ml give
80 to 200. Where it is less, the flow settles lower, and the pouring takes longer."""
_FLOW_OVER = 0.4
"""Time over which the flow is measured [s]: the reading trembles by less than 0.01 g."""
_ROUNDS = 6
"""How often it pours at most."""


@dataclass(frozen=True)
class PourToMass:
    """Hold the lip over the mouth, lean as the flow and what is missing ask, and stop ahead.

    A balance lags behind what falls on its pan. So the flow is kept in proportion to what is still
    missing, less what is already on its way, and the vessel leans back when that is all. If it then
    turns out to be too little, it pours again.

    Attributes:
        thing: The vessel in the hand.
        into: What stands on the pan.
        reading: What the balance reads [g].
        mass: The wanted reading [g].
        within: How near is near enough [g].
        behind_s: How far the reading is behind what has left the vessel, and goes on leaving while
            it leans back [s]: 0.6 of averaging, 0.2 of falling, 0.2 of leaning back.
        wanted_s: What is missing, over this time, is the flow that is wanted [s].
        slowest: Least flow that is wanted while anything is missing [g/s].
        fastest: Greatest flow that is wanted [g/s].
        drop: Height of the lip above the other mouth [m].
        short: How far before the middle of the other mouth the lip is [m].
        hover: How much higher the start position is [m].
        ease: How far it leans back to stop the flow [rad].
        pause_s: Shortest wait for the reading to settle [s].
    """

    thing: Pourable
    into: OpenVessel
    reading: Readable
    mass: float
    within: float
    behind_s: float = 1.0
    wanted_s: float = 1.2
    slowest: float = 1.5
    fastest: float = 12.0
    drop: float = 0.06
    short: float = 0.012
    hover: float = 0.08
    ease: float = 0.25
    pause_s: float = 1.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield start, ready, lean, then pour, ease and read until the mass is there, tilt back."""
        thing, shut, own = self.thing, world.commanded_opening, frozenset({self.thing.name})
        pivot = Pivot.over(world, thing, world.frame(self.into.rim), self.drop, self.short)
        ready = carrier(world, thing)(pivot.tilted(0.0))
        above = ready.moved(z=self.hover)

        def phase(name: str, target: Target, done: Condition, speed: float = 1.2) -> Phase:
            return Phase(name, target, shut, done, own, thing, turn_speed=speed, timeout_s=60.0)

        yield phase("start", lambda w: above, arrived(within=0.015))
        yield phase("ready", lambda w: ready, arrived(within=0.006))
        leaning, lean = pivot.towards(world, _DRY_LEAN), _DRY_LEAN
        yield phase("lean", leaning, _leaning(thing, _DRY_LEAN - 0.05, beyond=True), 0.5)
        for _ in range(_ROUNDS):
            flow = _Flow(self, pivot, world, lean)
            yield phase("pour", flow.target, flow.enough)
            stopped, back = flow.lean, flow.lean - self.ease
            yield phase("ease", pivot.towards(world, back), _leaning(thing, back + 0.02))
            yield phase("read", pivot.towards(world, back), self._read)
            short = self.mass - world.reading(self.reading.name).value
            if short <= self.within or stopped >= _FURTHEST + thing.taper:
                break
            lean = stopped - 0.06
            again = _leaning(thing, lean - 0.02, beyond=True)
            yield phase("lean", pivot.towards(world, lean), again, 0.5)
        back_up = pivot.towards(world, 0.0)
        yield phase("tilt_back", back_up, arrived(within=0.006))
        yield phase("stabilise", back_up, waited(0.3))

    def _read(self, world: World, target: Pose, elapsed: float) -> bool:
        return elapsed >= self.pause_s and world.reading(self.reading.name).settled


@dataclass
class _Flow:
    """The lean that keeps the flow as it is wanted.

    Attributes:
        pouring: What is wanted.
        pivot: Turns the vessel about its lip.
        world: The world when it begins.
        lean: Commanded lean [rad].
        shown: What the balance has shown at each control step [g].
    """

    pouring: PourToMass
    pivot: Pivot
    world: World
    lean: float
    shown: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._carried = carrier(self.world, self.pouring.thing)

    def target(self, world: World) -> Pose:
        """Return where the hand goes."""
        return self._carried(self.pivot.tilted(self.lean))

    def enough(self, world: World, target: Pose, elapsed: float) -> bool:
        """Lean on for a control period; return whether what is on its way is enough."""
        pouring = self.pouring
        self.shown.append(world.reading(pouring.reading.name).value)
        before = self.shown[-1 - round(_FLOW_OVER * CONTROL_HZ) :][0]
        flow = (self.shown[-1] - before) / _FLOW_OVER
        missing = pouring.mass - self.shown[-1] - pouring.behind_s * max(flow, 0.0)
        wanted = min(max(missing / pouring.wanted_s, pouring.slowest), pouring.fastest)
        self.lean += (wanted - flow) / _STEEPEST / CONTROL_HZ
        furthest = _FURTHEST + pouring.thing.taper
        return missing < 0.5 * pouring.within or self.lean >= furthest


def _leaning(thing: Pourable, lean: float, *, beyond: bool = False) -> Condition:
    """Return whether a vessel leans by less than an angle [rad], or by more."""

    def done(world: World, target: Pose, elapsed: float) -> bool:
        tilt = world.pose(thing).tilt
        return tilt >= lean if beyond else tilt <= lean

    return done
