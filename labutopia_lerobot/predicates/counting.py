"""What adds up as an episode goes on: turns of a rod, swings of a vessel.

Predicates have no memory. What must be gone through on the way to a milestone has: `Progress`
begins it anew for every episode and shows it the world once per control step.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World

_FIRST_STROKE = 0.5
"""Turns before which a rod only looks for its place; ours."""


class Counter(Protocol):
    """The memory of a count in one episode."""

    def add(self, world: World) -> float:
        """Take the next control step into account; return the count so far."""
        ...


@dataclass(frozen=True)
class Count:
    """Something that is to happen a number of times.

    Attributes:
        name: What is counted; it carries every threshold.
        counter: Returns a memory that has seen nothing yet.
        needed: How much of it is enough.
    """

    name: str
    counter: Callable[[], Counter]
    needed: float


def turns(rod: Thing, vessel: OpenVessel, *, needed: float, beyond: float) -> Count:
    """Count how often the tip has gone round the axis of the vessel, in the sense that prevails.

    Args:
        rod: What stirs; the origin of its frame is its tip.
        vessel: What it stirs in.
        needed: How many turns are enough.
        beyond: Distance from the axis, across it, below which nothing counts [m].
    """
    name = f"turns of {rod.name} in {vessel.name} beyond {beyond:g} m"
    return Count(name, lambda: _Turns(rod, vessel, beyond), needed)


def swings(vessel: Thing, *, needed: float, beyond_deg: float) -> Count:
    """Count how often the vessel has been tilted to one side and to the other.

    The first tilt fixes the axis, which has nothing to do with the hand; one that goes aside of it
    by as much is the first about another.

    Args:
        vessel: What is swung.
        needed: How many swings, one tilt to each side, are enough.
        beyond_deg: How far it must lean to each side [deg].
    """
    name = f"swings of {vessel.name} beyond {beyond_deg:g} deg"
    return Count(name, lambda: _Swings(vessel, np.radians(beyond_deg)), needed)


@dataclass
class _Turns:
    rod: Thing
    vessel: OpenVessel
    beyond: float
    angle: float = 0.0
    last: float | None = None

    def add(self, world: World) -> float:
        x, y, _ = (world.frame(self.vessel.rim).inverse() @ world.pose(self.rod)).position_w
        now = float(np.arctan2(y, x)) if np.hypot(x, y) > self.beyond else None
        if now is not None and self.last is not None:
            step = (now - self.last + np.pi) % (2 * np.pi) - np.pi
            if abs(step) < np.pi / 2:  # more in one control step is a way across, not round
                self.angle += step
        self.last = now
        count = abs(self.angle) / (2 * np.pi)
        return count if count > _FIRST_STROKE else 0.0


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
