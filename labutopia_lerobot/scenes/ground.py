"""A furnished room for a robot that drives: its map, places at benches, and what can stand there.

All of it in the frame of a task, in which the room's first work place is where the laboratory's is.
"""

from dataclasses import dataclass

from labutopia_lerobot.world import Dock, FloatArray, Floor


@dataclass(frozen=True, eq=False)
class Spot:
    """A place on a bench, and that of a base whose arm reaches it well.

    Attributes:
        dock: Where the base stands.
        position: Of the thing: x, y, and height above the room's first bench, shape (3,) [m].
        wide: Whether an instrument can stand there: a square of 0.34 m around is level and free.
    """

    dock: Dock
    position: FloatArray
    wide: bool


@dataclass(frozen=True, eq=False)
class Ground:
    """What of a room a robot gets to.

    Attributes:
        floor: Map and places at benches.
        spots: Places for things.
        deep: Places before which a bench-top oven can stand, with room for its open door; the
            position is that of the base of the arm.
        starts: Points from which it gets to all of them, shape (n, 2) [m].
    """

    floor: Floor
    spots: tuple[Spot, ...]
    deep: tuple[Spot, ...]
    starts: FloatArray

    @property
    def benches(self) -> tuple[str, ...]:
        """Benches with places for things, by their names in the world."""
        return tuple(dict.fromkeys(spot.dock.bench for spot in self.spots))

    @property
    def wide_benches(self) -> tuple[str, ...]:
        """Those of them with places for instruments."""
        return tuple(dict.fromkeys(spot.dock.bench for spot in self.spots if spot.wide))

    @property
    def deep_benches(self) -> tuple[str, ...]:
        """Benches with places for what is as large as an oven."""
        return tuple(dict.fromkeys(spot.dock.bench for spot in self.deep))
