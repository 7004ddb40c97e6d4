"""A furnished room for a robot that drives: its map, places at benches, and what can stand there.

All of it in the frame of a task, in which the room's first work place is where the laboratory's is.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.world import Dock, FloatArray, Floor


@dataclass(frozen=True, eq=False)
class Spot:
    """A place on a bench, and that of a base whose arm reaches it well.

    Attributes:
        dock: Where the base stands.
        position: Of the thing: x, y, and height above the room's first bench, shape (3,) [m].
        wide: Whether an instrument can stand there: a square of 0.34 m around is level and free.
        above: Whether the arm reaches it from above, too.
    """

    dock: Dock
    position: FloatArray
    wide: bool
    above: bool


@dataclass(frozen=True, eq=False)
class Fixture:
    """A piece of the room that a robot reaches into, such as a sink.

    Attributes:
        name: That of the piece in the plan.
        dock: Where the base stands for that.
        position: Of its origin: x, y, and height above the room's first bench, shape (3,) [m].
        yaw: How it is turned [rad].
    """

    name: str
    dock: Dock
    position: FloatArray
    yaw: float


@dataclass(frozen=True, eq=False)
class Ground:
    """What of a room a robot gets to.

    Attributes:
        floor: Map and places at benches.
        spots: Places for things.
        deep: Places before which a bench-top oven can stand, with room for its open door; the
            position is that of the base of the arm.
        fixtures: Kind -> the first of that kind that a robot gets to.
        starts: Points from which it gets to all of them, shape (n, 2) [m].
    """

    floor: Floor
    spots: tuple[Spot, ...]
    deep: tuple[Spot, ...]
    fixtures: Mapping[str, Fixture]
    starts: FloatArray

    @property
    def benches(self) -> tuple[str, ...]:
        """Benches with places for things, by their names in the world."""
        return tuple(dict.fromkeys(spot.dock.bench for spot in self.spots))

    @property
    def wide_benches(self) -> tuple[str, ...]:
        """Those of them with places for instruments."""
        return tuple(dict.fromkeys(spot.dock.bench for spot in self.spots if spot.wide))

    def benches_for(self, count: int, apart: float, *, from_above: bool) -> tuple[str, ...]:
        """Return benches with places for several things.

        Args:
            count: How many.
            apart: Least distance of one from another [m].
            from_above: Whether the arm is to reach them from above.
        """
        spots = [spot for spot in self.spots if spot.above or not from_above]
        benches = dict.fromkeys(spot.dock.bench for spot in spots)
        return tuple(each for each in benches if len(_spread(spots, each, apart)) >= count)

    @property
    def deep_benches(self) -> tuple[str, ...]:
        """Benches with places for what is as large as an oven."""
        return tuple(dict.fromkeys(spot.dock.bench for spot in self.deep))


def _spread(spots: Sequence[Spot], bench: str, apart: float) -> list[FloatArray]:
    """Return places on a bench that are apart, from one of its ends to the other."""
    points = np.array([spot.position[:2] for spot in spots if spot.dock.bench == bench])
    along = points[np.argsort(points @ np.linalg.svd(points - points.mean(axis=0))[2][0])]
    chosen: list[FloatArray] = []
    for point in along:
        if all(math.dist(point, other) >= apart for other in chosen):
            chosen.append(point)
    return chosen
