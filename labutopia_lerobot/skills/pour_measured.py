"""Pour until a gauge shows a wanted amount."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.gauge import Gauge
from labutopia_lerobot.skills.pour import Pivot, Pourable
from labutopia_lerobot.skills.skill import Condition, Phase, Target, arrived, carrier, waited
from labutopia_lerobot.world import OpenVessel, Pose, World

_FURTHEST = math.radians(100.0)
"""Lean at which a straight vessel counts as empty [rad]; one that tapers, further by its taper."""
_DRY_LEAN = math.radians(35.0)
"""Lean up to which it goes fast [rad]: a vessel that is half full gives nothing yet."""
_WATER = 1e6
"""What a cubic metre of water is [g or ml]."""
_WIDEST_STEP = 0.05
"""The largest step [rad]; ours."""


@dataclass(frozen=True)
class PourMeasured:
    """Hold the lip over the mouth, lean until the gauge shows some of it, then in small steps.

    A balance lags behind what falls on its pan, by about 0.6 s. So the vessel leans slowly until
    the gauge shows `coarse` of the amount, and eases back; then it leans a little further each
    time, as far as gives `share` of what is missing by what the step before gave, and waits until
    the liquid has come to rest at its lip. Liquid clings to the lip and comes in a gulp: when a
    balance that is still moving shows nearly all of it, the vessel is righted at once.

    Attributes:
        thing: The vessel in the hand.
        into: What it is poured into.
        gauge: What shows how much has arrived.
        amount: What it is to show, in its unit.
        within: How near is near enough.
        coarse: Share of the amount that is shown when it eases back.
        share: Share of what is missing that a step is to give.
        ease: How far it leans back then [rad].
        drop: Height of the lip above the other mouth [m].
        short: How far before the middle of the other mouth the lip is [m].
        hover: How much higher the start position is, and the end of one that tapers [m].
        turn_speed: How fast it leans at first [rad/s].
    """

    thing: Pourable
    into: OpenVessel
    gauge: Gauge
    amount: float
    within: float
    coarse: float = 0.1
    share: float = 0.7
    ease: float = 0.15
    drop: float = 0.06
    short: float = 0.012
    hover: float = 0.08
    turn_speed: float = 0.12

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield start, ready, pour, ease, then add until it is there, tilt back, perhaps rise."""
        thing, shut, own = self.thing, world.commanded_opening, frozenset({self.thing.name})
        pivot = Pivot.over(world, thing, world.frame(self.into.rim), self.drop, self.short)
        ready = carrier(world, thing)(pivot.tilted(0.0))
        above = ready.moved(z=self.hover)

        def phase(name: str, target: Target, done: Condition, speed: float = 1.2) -> Phase:
            return Phase(name, target, shut, done, own, thing, turn_speed=speed, timeout_s=40.0)

        yield phase("start", lambda w: above, arrived(within=0.015))
        yield phase("ready", lambda w: ready, arrived(within=0.006))
        leaning = pivot.towards(world, _DRY_LEAN)
        yield phase("lean", leaning, _leaning(thing, _DRY_LEAN - 0.05, beyond=True), 0.5)
        furthest = _FURTHEST + thing.taper
        tilt = pivot.towards(world, furthest)
        yield phase("pour", tilt, self._shows(self.coarse * self.amount), self.turn_speed)
        lean, slope = world.pose(thing).tilt - self.ease, self._least_slope
        yield phase("ease", pivot.towards(world, lean), _leaning(thing, lean + 0.02))
        yield phase("read", pivot.towards(world, lean), self._read)
        shown = self.gauge.shown(world)
        while self.amount - shown > self.within and lean < furthest:
            further = min(_WIDEST_STEP, self.share * (self.amount - shown) / slope)
            lean += further
            held = pivot.towards(world, lean)
            yield phase("add", held, _leaning(thing, lean - 0.005, beyond=True), 0.1)
            yield phase("read", held, self._read_or_nearly_there)
            before, shown = shown, self.gauge.shown(world)
            slope = max(self._least_slope, slope / 2, (shown - before) / further)
        back = pivot.towards(world, 0.0)
        yield phase("tilt_back", back, arrived(within=0.006))
        yield phase("stabilise", back, waited(0.3))
        if thing.taper:  # wider below, it hangs over the other mouth
            clear = world.gripper.moved(z=self.hover)
            yield phase("rise", lambda w: clear, arrived(within=0.015))

    @property
    def _least_slope(self) -> float:
        """Least that a vessel gives when it leans further [g/rad or ml/rad].

        A surface from wall to wall, of radius r, gives pi r^3 / cos(lean)^2: about an axis in the
        lip it turns as a whole. Twice pi r^3 is that at 45 degrees.
        """
        return 2 * _WATER * math.pi * self.thing.footprint_radius**3

    def _read(self, world: World, target: Pose, elapsed: float) -> bool:
        return elapsed >= self.gauge.pause_s and self.gauge.settled(world)

    def _read_or_nearly_there(self, world: World, target: Pose, elapsed: float) -> bool:
        nearly = self.gauge.shown(world) >= self.amount - self.within / 2
        return self._read(world, target, elapsed) or (nearly and not self.gauge.settled(world))

    def _shows(self, amount: float) -> Condition:
        def done(world: World, target: Pose, elapsed: float) -> bool:
            return self.gauge.shown(world) >= amount

        return done


def _leaning(thing: Pourable, lean: float, *, beyond: bool = False) -> Condition:
    """Return whether a vessel leans by less than an angle [rad], or by more."""

    def done(world: World, target: Pose, elapsed: float) -> bool:
        tilt = world.pose(thing).tilt
        return tilt >= lean if beyond else tilt <= lean

    return done
