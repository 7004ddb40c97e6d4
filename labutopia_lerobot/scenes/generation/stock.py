"""Ware for a room that is furnished: in groups on benches, in rows on shelves, in racks and rings.

It comes after the pieces and has a generator of its own: no piece is elsewhere because of it.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from labutopia_lerobot.labware.glass.catalogue import catalogue
from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.scenes.generation.family import WareNeed
from labutopia_lerobot.scenes.generation.words import BENCHES
from labutopia_lerobot.scenes.plan import Heading, Placed, PlacedWare, Plan
from labutopia_lerobot.scenes.room_map import room_map
from labutopia_lerobot.scenes.space.boxes import Boxes, boxes, joined
from labutopia_lerobot.scenes.space.claims import claims
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.scenes.space.reach import Reach
from labutopia_lerobot.scenes.space.ware_room import box_of, made, spots_in

_PER_BENCH, _BENCH = (3.0, 8.0), 1.5
"""Least and greatest number of pieces on a bench of a working laboratory, and its length [m]."""
_FILLED = 0.6
"""Share of the shelves that bear ware."""
_TRIES = 12
"""Spots that are tried for a piece on a bench."""
_GROUP, _SPREAD = 3, 0.14
"""Pieces of a group on a bench, and how far along it they are from its middle [m]."""
_APART, _IN_A_ROW = 0.012, (0.006, 0.025)
"""Between two pieces on a bench, and in a row on a shelf [m]."""
_ROW = (2, 6)
"""Pieces of one kind beside each other on a shelf."""
_BETWEEN_ROWS = (0.02, 0.12)
"""Between two such rows [m]."""
_TUBES = (2, 7)
"""Tubes in a rack."""
_FULL = (0.25, 0.8)
"""Level of what is in a bottle, as a share of its height."""


def stocked(plan: Plan, stock: Sequence[WareNeed]) -> Plan:
    """Return a plan with ware on its benches and shelves; racks come behind its pieces.

    Args:
        plan: Furnished, without ware.
        stock: What such a laboratory works with.
    """
    rng = np.random.default_rng([plan.seed, *plan.family.encode(), *b"ware"])
    stocking = _Stocking(plan, rng)
    for piece in plan.pieces:
        kind = extent(piece.kind)
        if piece.kind in BENCHES:
            for top in kind.tops:
                stocking.lay_bench(piece, top, [one for one in stock if one.where == "bench"])
        for shelf in kind.boards:
            if rng.random() < _FILLED:
                stocking.fill_shelf(piece, shelf, [one for one in stock if one.where == "shelf"])
    return replace(plan, pieces=(*plan.pieces, *stocking.holders), ware=tuple(stocking.ware))


class _Stocking:
    """Ware that is being put into a room.

    Attributes:
        holders: Racks and rings that it needs.
        ware: What stands so far.
    """

    def __init__(self, plan: Plan, rng: np.random.Generator) -> None:
        self.holders: list[Placed] = []
        self.ware: list[PlacedWare] = []
        self._rng = rng
        self._reach = Reach.of(room_map(plan), plan.openings[0])
        self._taken = joined(*(claim.room for claim in claims(plan)))
        self._named = Counter(piece.kind for piece in plan.pieces)

    def lay_bench(self, piece: Placed, top: Top, stock: Sequence[WareNeed]) -> None:
        """Put groups of ware on a bench top, most of it towards the back."""
        if not stock:
            return
        rng, length = self._rng, top.y[1] - top.y[0]
        count = round(length / _BENCH * rng.uniform(*_PER_BENCH))
        groups = rng.uniform(*top.y, size=max(1, round(count / _GROUP)))
        for _ in range(count):
            one, size = self._drawn(stock)
            group = groups[int(rng.integers(len(groups)))]
            for _ in range(_TRIES):
                x = top.x[0] + (top.x[1] - top.x[0]) * rng.beta(1.6, 1.1)
                x = top.x[0] + top.x[1] - x if top.behind else x
                spot = _spot(piece, top, x, group + rng.normal(0.0, _SPREAD))
                if self._put(one, size, spot, piece, top):
                    break

    def fill_shelf(self, piece: Placed, shelf: Top, stock: Sequence[WareNeed]) -> None:
        """Put ware on a shelf in rows of one kind, from one end to the other."""
        if not stock:
            return
        rng = self._rng
        y = shelf.y[0] + rng.uniform(*_BETWEEN_ROWS)
        while y < shelf.y[1]:
            one, size = self._drawn(stock)
            radius = made(one.kind, size).footprint_radius
            x = float(np.clip(shelf.x[0] + radius + 0.035, *shelf.x))
            for _ in range(int(rng.integers(_ROW[0], _ROW[1] + 1))):
                spot = _spot(piece, shelf, x + rng.uniform(0.0, 0.01), y + radius)
                self._put(one, size, spot, piece, shelf)
                y += 2 * radius + rng.uniform(*_IN_A_ROW)
            y += rng.uniform(*_BETWEEN_ROWS)

    def _drawn(self, stock: Sequence[WareNeed]) -> tuple[WareNeed, str]:
        """Draw what comes next, and its size."""
        often = np.array([one.often for one in stock], float)
        one = stock[int(self._rng.choice(len(stock), p=often / often.sum()))]
        return one, one.sizes[int(self._rng.integers(len(one.sizes)))]

    def _put(
        self, one: WareNeed, size: str, spot: tuple[float, float, float], piece: Placed, top: Top
    ) -> bool:
        """Put a piece, or a holder with some in it, where there is room for it."""
        if holder := catalogue()[one.kind].holder:
            return self._put_holder(one, size, holder, spot, piece, top)
        ware = self._piece(one, size, spot, piece.name)
        gap = _APART if one.where == "bench" else 0.0
        if not self._has_room(box_of(ware), gap, piece, top):
            return False
        self._keep(ware)
        return True

    def _put_holder(
        self,
        one: WareNeed,
        size: str,
        holder: str,
        spot: tuple[float, float, float],
        piece: Placed,
        top: Top,
    ) -> bool:
        """Put a rack or a ring with ware in it."""
        turn: Heading = (piece.heading + (180 if top.behind else 0)) % 360  # type: ignore[assignment]
        x, y, height = spot
        name = f"{holder}_{self._named[holder] + 1}"
        held = Placed(holder, name, x, y, turn, piece.name, height)
        room = extent(holder).hull.placed(turn).moved(np.array(spot))
        spots = spots_in(held, one.kind, size)
        drawn = self._rng.permutation(len(spots))[: int(self._rng.integers(*_TUBES))]
        inside = [self._piece(one, size, spots[number], name) for number in sorted(drawn)]
        around = joined(room, *(box_of(ware) for ware in inside)).hull
        reached = inside and self._reach.front_of(held)
        if not reached or not self._has_room(around, _APART, piece, top):
            return False
        self._named[holder] += 1
        self.holders.append(held)
        for ware in inside:
            self._keep(ware)
        self._taken = joined(self._taken, room)
        return True

    def _piece(
        self, one: WareNeed, size: str, spot: tuple[float, float, float], on: str
    ) -> PlacedWare:
        contents = ""
        if one.contents and self._rng.random() < 0.75:
            contents = one.contents[int(self._rng.integers(len(one.contents)))]
        level = round(float(self._rng.uniform(*_FULL)), 2) if contents else 0.0
        return PlacedWare(one.kind, size, "", *spot, on, one.closed, contents, level)

    def _has_room(self, box: Boxes, gap: float, piece: Placed, top: Top) -> bool:
        """Return whether a box is wholly over a top, and a gap away from all that is there."""
        area = boxes((top.x, top.y, (-9.0, 9.0))).placed(piece.heading)
        area = area.moved(np.array([piece.x, piece.y, 0.0]))
        around = np.array([gap, gap, 0.0])
        inside = (box.low >= area.low).all() and (box.high <= area.high).all()
        return bool(inside) and not Boxes(box.low - around, box.high + around).meet(self._taken)

    def _keep(self, ware: PlacedWare) -> None:
        self._named[ware.kind] += 1
        self.ware.append(replace(ware, name=f"{ware.kind}_{self._named[ware.kind]}"))
        self._taken = joined(self._taken, box_of(ware))


def _spot(piece: Placed, top: Top, x: float, y: float) -> tuple[float, float, float]:
    """Return a point of a top, said in the frame of its piece, as one of the room [m]."""
    there = boxes(((x, x), (y, y), (top.height,) * 2)).placed(piece.heading).low[0]
    at = there + np.array([piece.x, piece.y, piece.height])
    across, along, height = np.round(at, 3).tolist()
    return across, along, height
