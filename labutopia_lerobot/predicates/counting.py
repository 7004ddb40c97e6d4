"""Counts that add up in an episode: turns of a rod, swings of a vessel, travel of a drawer.

Predicates have no memory. What must be gone through on the way to a substep has: `Progress`
begins it anew for every episode and shows it the world once per control step.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from labutopia_lerobot.predicates.openables import Bar, Openable, grasped
from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World

_TURN = 2 * math.pi

_TURNED_BACK = math.radians(90)
"""Angle that a rod goes back before it is another run the other way; ours: a tremble is less."""

_STIRS = math.radians(10)
"""Least angle that it goes round before a pause is over; ours: a tremble is less."""


class Counter(Protocol):
    """The memory of a count in one episode."""

    def add(self, world: World) -> float:
        """Take the next control step into account; return the count so far."""
        ...


@dataclass(frozen=True)
class Count:
    """Something that is to happen a number of times, or to add up to an amount.

    Attributes:
        name: Name of the count; it shows every threshold.
        counter: Returns a memory that has counted nothing yet.
        needed: How much of it is enough.
    """

    name: str
    counter: Callable[[], Counter]
    needed: float


def turns(rod: Thing, vessel: OpenVessel, *, needed: float, beyond: float, pause: float) -> Count:
    """Count how often the tip goes round the axis of the vessel, one way or the other.

    A run goes one way, without a pause and without coming near the axis; it counts from its first
    full turn on, so that rocking to and fro on one side of the axis is none.

    Args:
        rod: What stirs; the origin of its frame is its tip.
        vessel: What it stirs in.
        needed: How many turns are enough, all runs together.
        beyond: Distance from the axis, across it, within which a run ends [m].
        pause: Time without going on after which a run ends [s].
    """
    name = f"turns of {rod.name} in {vessel.name} beyond {beyond:g} m, pauses below {pause:g} s"
    return Count(name, lambda: _Turns(rod, vessel, beyond, pause), needed)


def swings(vessel: Thing, *, needed: float, beyond_deg: float) -> Count:
    """Count how often the vessel has been tilted to one side and to the other.

    The first tilt fixes the axis, which has nothing to do with the hand; one that goes aside of it
    by as much is the first about another.

    Args:
        vessel: The swung vessel.
        needed: How many swings, one tilt to each side, are enough.
        beyond_deg: How far it must lean to each side [deg].
    """
    name = f"swings of {vessel.name} beyond {beyond_deg:g} deg"
    return Count(name, lambda: _Swings(vessel, np.radians(beyond_deg)), needed)


def pulled(part: Openable, by: Bar, *, to: float, slack: float) -> Count:
    """Measure how far a door or drawer has been pulled open by its handle, in one pull or several.

    What it moves while the handle is not grasped does not count, until it is moved back.

    Args:
        part: The door or drawer.
        by: Its handle.
        to: Position of its joint that is far enough [rad or m].
        slack: How far it may move by itself [rad or m].
    """
    name = f"{part.name} pulled by {by.name}, slack {part.format_position(slack)}"
    return Count(name, lambda: _Pulled(part, by, slack), to)


def lasted(*facts: Predicate, needed: float) -> Count:
    """Measure for how long facts have held together without a break [s].

    Args:
        *facts: What must hold.
        needed: How long is enough [s].
    """
    name = f"seconds of {' and '.join(fact.name for fact in facts)}"
    return Count(name, lambda: _Lasted(facts), needed)


@dataclass
class _Run:
    """A way round the axis in one sense.

    Attributes:
        began: Angle at which it began [rad].
        furthest: Angle up to which it has come [rad].
        paused: Angle and time at which the present pause began, if it is one [rad, s].
    """

    began: float
    furthest: float
    paused: tuple[float, float]

    @property
    def turns(self) -> float:
        """Turns that count: none of less than one."""
        way = abs(self.furthest - self.began) / _TURN
        return way if way >= 1.0 else 0.0


@dataclass
class _Turns:
    rod: Thing
    vessel: OpenVessel
    beyond: float
    pause: float
    before: float = 0.0
    run: _Run | None = None
    angle: float = 0.0

    def add(self, world: World) -> float:
        x, y, _ = world.frame(self.vessel.rim).local(world.pose(self.rod).position_w)
        direction = math.atan2(y, x)
        step = (direction - self.angle + math.pi) % _TURN - math.pi
        self.angle += step  # unwound: it goes on beyond a full turn
        if math.hypot(x, y) < self.beyond:
            self._end()
        elif self.run is None:
            self.run = _Run(self.angle, self.angle, (self.angle, world.time))
        elif abs(step) > math.pi / 2:  # in one control step: across the axis, not round it
            self._end()
        else:
            self._go_on(self.run, world.time)
        return self.before + (self.run.turns if self.run is not None else 0.0)

    def _go_on(self, run: _Run, now: float) -> None:
        onward = self.angle - run.furthest
        paused_at, since = run.paused
        if abs(self.angle - paused_at) > _STIRS:
            run.paused = self.angle, now
        elif now - since > self.pause:
            self._end()
            return
        if run.furthest == run.began or onward * (run.furthest - run.began) > 0.0:
            run.furthest = self.angle
        elif abs(onward) > _TURNED_BACK:
            self._end()
            self.run = _Run(run.furthest, self.angle, (self.angle, now))

    def _end(self) -> None:
        if self.run is not None:
            self.before += self.run.turns
            self.run = None


@dataclass
class _Swings:
    vessel: Thing
    beyond: float
    tilts: int = 0
    towards: FloatArray | None = None

    def add(self, world: World) -> float:
        axis = world.pose(self.vessel).z_axis
        if self.towards is None:
            if np.arccos(np.clip(axis[2], -1.0, 1.0)) > self.beyond:
                self._begin(axis)
            return self.tilts / 2
        aside = np.array([-self.towards[1], self.towards[0], 0.0])
        if abs(np.arctan2(axis @ aside, axis[2])) > self.beyond:
            self._begin(axis)
        elif np.arctan2(axis @ self.towards, axis[2]) < -self.beyond:
            self.towards = -self.towards
            self.tilts += 1
        return self.tilts / 2

    def _begin(self, axis: FloatArray) -> None:
        """Take the present lean for the first tilt."""
        self.tilts = 1
        self.towards = axis * (1.0, 1.0, 0.0) / np.hypot(axis[0], axis[1])


@dataclass
class _Pulled:
    part: Openable
    by: Bar
    slack: float
    reached: float = 0.0
    before: float = field(default=math.inf)

    def add(self, world: World) -> float:
        now = world.joint(self.part.joint)
        # Only a pull that begins where the last one ended, or before, gets further.
        if grasped(self.by).holds(world) and self.before <= self.reached + self.slack:
            self.reached = max(self.reached, now)
        self.before = now
        return self.reached


@dataclass
class _Lasted:
    facts: tuple[Predicate, ...]
    since: float | None = None

    def add(self, world: World) -> float:
        if not all(fact.holds(world) for fact in self.facts):
            self.since = None
            return 0.0
        self.since = world.time if self.since is None else self.since
        return world.time - self.since
