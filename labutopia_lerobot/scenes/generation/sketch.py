"""A plan that is being made: what stands already, and whether another piece fits."""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.scenes.generation.family import Need
from labutopia_lerobot.scenes.generation.footprint import Footprint, Region
from labutopia_lerobot.scenes.generation.required_space import (
    WORK_BENCH,
    RequiredSpace,
    required_space,
    work_place,
)
from labutopia_lerobot.scenes.generation.where import StandingPieces
from labutopia_lerobot.scenes.plan import Heading, Placed, WorkPlace
from labutopia_lerobot.scenes.space.boxes import TOUCHING, Boxes, joined
from labutopia_lerobot.scenes.space.claims import claims_of_openings, masonry
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.scenes.space.reach import Reach
from labutopia_lerobot.world import FloatArray


@dataclass(frozen=True, eq=False)
class Entry:
    """A piece in a sketch.

    Attributes:
        piece: What it will be in the plan.
        need: What it meets.
        region: Where it is.
        place: Where its robot stands, of a work bench.
        room: What it takes.
    """

    piece: Placed
    need: Need
    region: Region
    place: WorkPlace | None
    room: RequiredSpace


@dataclass
class Sketch:
    """The pieces that stand in a footprint so far.

    Attributes:
        footprint: Where.
        entries: In the order in which they came.
    """

    footprint: Footprint
    entries: list[Entry] = field(default_factory=list)

    def __post_init__(self) -> None:
        openings, ceiling = self.footprint.openings, self.footprint.size[2]
        self._openings = joined(*(c.room for c in claims_of_openings(openings, ceiling)))
        self._maps = [Occupancy.empty(self.footprint.size[:2])]
        walls = (masonry(wall, openings, ceiling) for wall in self.footprint.walls)
        self._maps[0].add(*joined(*walls))
        self._reaches = [Reach.of(self._maps[0], openings[0])]

    def standing(self, region: Region) -> StandingPieces:
        """Return what stands in a region."""
        return StandingPieces(
            tuple(entry.piece for entry in self.entries if entry.region == region)
        )

    def fitting(
        self, need: Need, region: Region, rng: np.random.Generator | None, tries: int
    ) -> Iterator[Entry]:
        """Yield pieces that would fit: inside, near what they need, and free of all others.

        Args:
            need: What they meet.
            region: Where.
            rng: Draws their order; else they are taken evenly from the whole grid.
            tries: How many spots of the grid are tried at most.
        """
        patches = list(need.where.patches(extent(need.kind), region, self.standing(region)))
        ends = np.cumsum([0, *(len(patch) for patch in patches)])
        total = int(ends[-1])
        if rng is None:
            numbers = np.unique(np.linspace(0, total - 1, min(total, tries)).astype(int))
        else:
            numbers = rng.permutation(total)[:tries]
        which = np.searchsorted(ends, numbers, side="right") - 1
        spots = np.empty((len(numbers), 3))
        inside = np.zeros(len(numbers), bool)
        at_openings = np.zeros(len(numbers), bool)
        close = np.zeros((len(numbers), len(self.entries)), bool)
        hulls = joined(*(entry.room.hull for entry in self.entries))
        for index in np.unique(which):
            patch, those = patches[index], which == index
            spots[those] = patch.offsets(numbers[those] - ends[index])
            room = required_space(need, patch.heading)
            inside[those] = self._inside(room, spots[those], region)
            at_openings[those] = _close(room.outline, spots[those], self._openings).any(axis=1)
            close[those] = _close(room.hull, spots[those], hulls)
        inside &= self._near(need, region, spots)
        for number in np.flatnonzero(inside):
            patch = patches[which[number]]
            room = required_space(need, patch.heading).moved(spots[number])
            others = (self.entries[other].room for other in np.flatnonzero(close[number]))
            closed = at_openings[number] and room.solids.meet(self._openings)
            if not closed and not any(map(room.conflicts, others)):
                x, y, height = spots[number].tolist()
                yield self._entry(need, region, room, x, y, height, patch.heading, patch.on)

    def _entry(
        self,
        need: Need,
        region: Region,
        room: RequiredSpace,
        x: float,
        y: float,
        height: float,
        heading: Heading,
        on: str | None,
    ) -> Entry:
        number = 1 + sum(entry.piece.kind == need.kind for entry in self.entries)
        piece = Placed(need.kind, f"{need.kind}_{number}", x, y, heading, on, height)
        place = work_place(piece, number) if need.kind == WORK_BENCH else None
        return Entry(piece, need, region, place, room)

    def _inside(self, room: RequiredSpace, spots: FloatArray, region: Region) -> NDArray[np.bool_]:
        """Return at which spots all that a piece takes is in a region, shape (n,)."""
        taken = joined(room.solids, room.frees).hull
        low = np.array([region.x[0], region.y[0], 0.0]) - TOUCHING
        high = np.array([region.x[1], region.y[1], self.footprint.size[2]]) + TOUCHING
        inside: NDArray[np.bool_] = (spots + taken.low >= low) & (spots + taken.high <= high)
        return np.asarray(inside.all(axis=1))

    def _near(self, need: Need, region: Region, spots: FloatArray) -> NDArray[np.bool_]:
        """Return which spots are near one of what is needed beside it, shape (n,)."""
        if need.near is None:
            return np.ones(len(spots), bool)
        wanted = [(piece.x, piece.y) for piece in self.standing(region).of_kind(need.near)]
        away = np.abs(spots[:, None, :2] - np.reshape(wanted, (-1, 2))).sum(axis=2)
        return np.asarray((away <= need.within).any(axis=1))

    def add(self, entry: Entry) -> bool:
        """Add a piece, unless a robot would not get to it or to something else any more."""
        occupancy, reach = self._maps[-1].copy(), self._reaches[-1]
        occupancy.add(*entry.room.solids)
        checked = [entry]
        if (occupancy.cells != self._maps[-1].cells).any():  # not above a bench, as a rule
            reach = Reach.of(occupancy, self.footprint.openings[0])
            checked = [*self.entries, entry]
        if not all(_gets_to(reach, one) for one in checked):
            return False
        self.entries.append(entry)
        self._maps.append(occupancy)
        self._reaches.append(reach)
        return True

    def take_back(self) -> None:
        """Take away what was added last."""
        self.entries.pop()
        self._maps.pop()
        self._reaches.pop()


def _gets_to(reach: Reach, entry: Entry) -> bool:
    sides = extent(entry.piece.kind).tops
    return (
        reach.front_of(entry.piece)
        and (entry.place is None or reach.gets_to(entry.place))
        and all(reach.side_of(entry.piece, top) for top in sides)
    )


def _close(hull: Boxes, spots: FloatArray, others: Boxes) -> NDArray[np.bool_]:
    """Return at which spots a box meets which others, shape (n, number of others)."""
    low, high = spots + hull.low, spots + hull.high
    meeting = low[:, None] + TOUCHING < others.high
    meeting &= others.low + TOUCHING < high[:, None]
    return meeting[..., 0] & meeting[..., 1] & meeting[..., 2]
