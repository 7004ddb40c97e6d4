"""Positions of things at the start of an episode in which one drives: on benches of the room."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.scenes.ground import Ground, Spot
from labutopia_lerobot.scenes.placement import Placement
from labutopia_lerobot.scenes.room import NowhereToDriveError

APART = 0.25
"""Least distance of things on the same bench [m]; ours: an open hand is 0.2 m wide."""
AWAY = 2.0
"""Least distance of a robot that drives from where it is to go [m]; ours: from nearer it does not
have to drive."""
_TRIES = 100
"""Places that are drawn until one is far enough; in small rooms the farthest of them is taken."""

# Of each start: `shuffled`, no bodies of it change places; `described`, how it is turned, in words.


@dataclass(frozen=True)
class OnSomeBench:
    """Anywhere on a bench of the room that a robot drives to; things that say so are on different.

    All benches are equally likely, and so are all places on each, but for those from which a robot
    that stands before them would not have to drive to what is elsewhere.

    Attributes:
        instrument: Whether it is an instrument, up to 0.34 m long and wide: it stands where there
            is room for that, its back to the bench, its front to the robot. Things are of any yaw.
        things: How many things there must be room for, this one among them (see `OnTheSameBench`).
        from_above: Whether the arm is to reach it from above.
    """

    instrument: bool = False
    things: int = 1
    from_above: bool = False
    shuffled: ClassVar[tuple[str, ...]] = ()

    @property
    def described(self) -> str:
        return "facing the robot" if self.instrument else "any"

    def sample(
        self,
        rng: np.random.Generator,
        placed: Mapping[Piece, Placement],
        ground: Ground | None = None,
    ) -> Placement:
        """Draw one placement; its height is that above the bench of the room.

        Raises:
            NowhereToDriveError: If the room does not have that many benches.
        """
        taken = {placement.bench for placement in placed.values()}
        spots = () if ground is None else ground.spots
        spots = tuple(
            spot
            for spot in spots
            if (spot.wide or not self.instrument) and (spot.above or not self.from_above)
        )
        free = list(dict.fromkeys(s.dock.bench for s in spots if s.dock.bench not in taken))
        if self.things > 1 and ground is not None:
            roomy = ground.benches_for(self.things, APART, from_above=self.from_above)
            free = [bench for bench in free if bench in roomy]
        if not free:
            raise NowhereToDriveError(
                f"The task needs {len(taken) + 1} benches that a robot drives to. Choose a robot "
                "and a room for that"
            )
        drawn: list[Spot] = []
        for _ in range(_TRIES):
            bench = free[int(rng.integers(len(free)))]
            there = [spot for spot in spots if spot.dock.bench == bench]
            drawn.append(there[int(rng.integers(len(there)))])
            if _way_off(drawn[-1], placed) >= AWAY:
                break
        spot = max(drawn, key=lambda spot: _way_off(spot, placed))
        x, y, height = spot.position
        yaw = spot.dock.yaw if self.instrument else rng.uniform(-math.pi, math.pi)
        return Placement(x, y, yaw, height, bench=spot.dock.bench)


def _way_off(spot: Spot, placed: Mapping[Piece, Placement]) -> float:
    """Return how far a base that docks for a place is from the next thing that is placed [m]."""
    things = ((thing.x, thing.y) for thing in placed.values())
    return min((math.dist(spot.dock.position, thing) for thing in things), default=math.inf)


@dataclass(frozen=True)
class OnTheSameBench:
    """Anywhere on the bench of another thing, 0.25 m or more from all that a task has there.

    Attributes:
        as_thing: The other thing; it comes earlier in the task's start, with `things` for all.
        from_above: Whether the arm is to reach it from above.
    """

    as_thing: Piece
    from_above: bool = False
    shuffled: ClassVar[tuple[str, ...]] = ()
    described: ClassVar[str] = "any"

    def sample(
        self,
        rng: np.random.Generator,
        placed: Mapping[Piece, Placement],
        ground: Ground | None = None,
    ) -> Placement:
        """Draw one placement; where there is no room it is that of the other thing.

        Raises:
            NowhereToDriveError: If nobody drives there.
        """
        if ground is None:
            raise NowhereToDriveError(f"'{self.as_thing.name}' is on no bench of a room")
        bench = placed[self.as_thing].bench
        others = [(other.x, other.y) for other in placed.values() if other.bench == bench]
        there = [
            spot.position
            for spot in ground.spots
            if spot.dock.bench == bench
            and (spot.above or not self.from_above)
            and all(math.dist(spot.position[:2], other) >= APART for other in others)
        ]
        if not there:
            return placed[self.as_thing]
        x, y, height = there[int(rng.integers(len(there)))]
        return Placement(x, y, rng.uniform(-math.pi, math.pi), height, bench=bench)


@dataclass(frozen=True)
class OfTheRoom:
    """Where the room has a piece of this kind that one reaches into, such as a sink: in its place.

    Attributes:
        kind: Of the instruments' catalogue.
    """

    kind: str
    shuffled: ClassVar[tuple[str, ...]] = ()
    described: ClassVar[str] = "as it is"

    def sample(
        self,
        rng: np.random.Generator,
        placed: Mapping[Piece, Placement],
        ground: Ground | None = None,
    ) -> Placement:
        """Return its placement; its height is that above the bench of the room.

        Raises:
            NowhereToDriveError: If the room has no such piece that a robot gets to.
        """
        fixture = None if ground is None else ground.fixtures.get(self.kind)
        if fixture is None:
            raise NowhereToDriveError(
                f"The task needs a {self.kind} to which a robot drives. Choose a robot and a room "
                "for that"
            )
        x, y, height = fixture.position
        return Placement(x, y, fixture.yaw, height, bench=fixture.dock.bench, dock=fixture.dock)


@dataclass(frozen=True)
class OnDeepBench:
    """On a bench as deep as a laboratory's work bench: something as large as a bench-top oven.

    Uniform over the places before which a robot can dock, and there over ranges relative to its
    arm; nothing else stands on that bench.

    Attributes:
        ahead: Least and greatest distance of the thing's origin ahead of the base of the arm [m].
        left: The same to the left of that [m].
        yaw: Least and greatest angle by which it is turned to the left; at 0 its front faces the
            robot [rad].
    """

    ahead: tuple[float, float]
    left: tuple[float, float]
    yaw: tuple[float, float]
    shuffled: ClassVar[tuple[str, ...]] = ()

    @property
    def described(self) -> str:
        least, greatest = (math.degrees(angle) for angle in self.yaw)
        return f"{least:.0f} to {greatest:.0f} from facing the robot"

    def sample(
        self,
        rng: np.random.Generator,
        placed: Mapping[Piece, Placement],
        ground: Ground | None = None,
    ) -> Placement:
        """Draw one placement; its height is that above the bench of the room.

        Raises:
            NowhereToDriveError: If the room does not have such a bench.
        """
        taken = {placement.bench for placement in placed.values()}
        places = () if ground is None else ground.deep
        free = [place for place in places if place.dock.bench not in taken]
        if not free:
            raise NowhereToDriveError(
                "The task needs a bench to which a robot drives, deep enough for an oven. Choose "
                "a robot and a room for that"
            )
        place = free[int(rng.integers(len(free)))]
        ahead, left, yaw = (rng.uniform(*bounds) for bounds in (self.ahead, self.left, self.yaw))
        c, s = math.cos(place.dock.yaw), math.sin(place.dock.yaw)
        x, y, height = place.position
        return Placement(
            x + c * ahead - s * left,
            y + s * ahead + c * left,
            place.dock.yaw + yaw,
            height,
            bench=place.dock.bench,
            dock=place.dock,
        )
