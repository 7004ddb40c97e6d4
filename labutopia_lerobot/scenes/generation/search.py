"""Finding a place for everything: the best of random samples; where that fails, depth first.

Budgets are numbers of tries, not of seconds: the same seed gives the same room on any machine.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.generation.family import Family, Need
from labutopia_lerobot.scenes.generation.footprint import Footprint, Region
from labutopia_lerobot.scenes.generation.score import score
from labutopia_lerobot.scenes.generation.sketch import Entry, Sketch
from labutopia_lerobot.scenes.plan import Placed
from labutopia_lerobot.scenes.space.extent import extent

TRIES = 240
"""Spots that are drawn for a piece."""
SAMPLES = 10
"""Spots among them that fit, of which the best is taken."""
PASSES = 2
"""Number of fresh starts before places are searched depth first."""
GRID_TRIES = 700
"""Spots of the whole grid that the search looks at for a piece, evenly spread."""
BRANCHES = 6
"""Spots of a piece that the search tries, from the best, as far as they are apart."""
STEPS = 55
"""Pieces that the search puts down before it gives up: of 500 rooms none needed more than 48."""


class RoomTooSmallError(UserError, ValueError):
    """A room that is too small for what it needs; the message names what does not fit."""


@dataclass(frozen=True)
class Wanted:
    """One piece that is to be placed.

    Attributes:
        need: What it meets.
        region: Where it goes.
        vital: Whether the room cannot be without it.
    """

    need: Need
    region: Region
    vital: bool


def wanted(footprint: Footprint, rng: np.random.Generator) -> list[Wanted]:
    """Draw how many of everything are wanted: by importance, then by size; extras at the end."""
    least, more = [], []
    for region in footprint.regions:
        for need in region.needs:
            low, high = need.count
            count = int(rng.integers(low, high + 1))
            least += [Wanted(need, region, True)] * low
            more += [Wanted(need, region, False)] * (count - low)
    return [*sorted(least, key=_rank), *sorted(more, key=_rank)]


def _rank(one: Wanted) -> tuple[int, bool, float]:
    hull = extent(one.need.kind).hull
    depth, width = (hull.high - hull.low)[0, :2]
    follows = one.need.near is not None
    return -one.need.importance, follows, -round(float(depth * width), 4)


def furnish(
    family: Family, footprint: Footprint, pieces: Sequence[Wanted], rng: np.random.Generator
) -> Sketch:
    """Find a place for every piece.

    Raises:
        RoomTooSmallError: If something vital does not fit.
    """
    for _ in range(PASSES):
        if (sketch := by_sampling(footprint, pieces, rng)) is not None:
            return sketch
    vital = [one for one in pieces if one.vital]
    sketch = depth_first(family, footprint, vital)
    for one in pieces:
        if not one.vital:
            _sampled(sketch, one, rng)
    return sketch


def by_sampling(
    footprint: Footprint, pieces: Sequence[Wanted], rng: np.random.Generator
) -> Sketch | None:
    """Place piece after piece, each at the best of random spots; None if one finds none."""
    sketch = Sketch(footprint)
    for one in pieces:
        if not _sampled(sketch, one, rng) and one.vital:
            return None
    return sketch


def _sampled(sketch: Sketch, one: Wanted, rng: np.random.Generator) -> bool:
    """Add a piece at the best of some random spots, if one fits."""
    fitting = list(islice(sketch.fitting(one.need, one.region, rng, TRIES), SAMPLES))
    return any(sketch.add(entry) for entry in _best_first(sketch, fitting))


def _best_first(sketch: Sketch, entries: Sequence[Entry]) -> list[Entry]:
    """Return entries by their scores; of equals, which came first."""
    return sorted(entries, key=lambda entry: -score(entry, sketch))


def depth_first(family: Family, footprint: Footprint, pieces: Sequence[Wanted]) -> Sketch:
    """Search places for all pieces, taking back what leaves no room for the next.

    Raises:
        RoomTooSmallError: If there are none, or none was found within the budget.
    """
    sketch = Sketch(footprint)
    branches: list[Iterator[Entry]] = []
    steps = furthest = 0
    while len(sketch.entries) < len(pieces):
        depth = len(sketch.entries)
        furthest = max(furthest, depth)
        if len(branches) == depth:
            branches.append(_branches(sketch, pieces[depth]))
        if steps < STEPS and any(sketch.add(entry) for entry in branches[-1]):
            steps += 1
            continue
        branches.pop()
        if not branches or steps >= STEPS:
            raise RoomTooSmallError(_too_small(family, footprint, pieces, furthest))
        sketch.take_back()
    return sketch


def _branches(sketch: Sketch, one: Wanted) -> Iterator[Entry]:
    """Yield the best spots for a piece, from the best, none beside one that was yielded."""
    fitting = list(sketch.fitting(one.need, one.region, None, GRID_TRIES))
    taken: list[Placed] = []
    for entry in _best_first(sketch, fitting):
        piece = entry.piece
        if all(
            other.heading != piece.heading or abs(other.x - piece.x) + abs(other.y - piece.y) > 0.2
            for other in taken
        ):
            taken.append(piece)
            yield entry
        if len(taken) == BRANCHES:
            return


def _too_small(family: Family, footprint: Footprint, pieces: Sequence[Wanted], placed: int) -> str:
    """Say what does not fit, and how much room it needs."""
    one = pieces[placed]
    width, depth = (round(side[1] - side[0], 3) for side in (one.region.x, one.region.y))
    same = [other for other in pieces if other.need == one.need and other.region == one.region]
    number = pieces[: placed + 1].count(one)
    which = f"{one.need.kind} ({number} of {len(same)})" if len(same) > 1 else one.need.kind
    room = f" {one.region.name}" if one.region.name else ""
    near = f", at most {one.need.within:g} m from a {one.need.near}" if one.need.near else ""
    room_needed = one.need.where.describe(extent(one.need.kind))
    return (
        f"{family.name}: in a room{room} of {width:g} x {depth:g} m there is no place for {which} "
        f"beside the {placed} pieces before it. It needs {room_needed}{near}, and a robot "
        f"of 0.6 m has to get there. Make the room larger or the list shorter."
    )
