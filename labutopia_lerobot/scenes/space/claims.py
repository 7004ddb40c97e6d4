"""Claims of a plan on its room: solids, and the space that must stay free of them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.scenes.plan import WALL_THICKNESS, Opening, Placed, Plan, Wall, WorkPlace
from labutopia_lerobot.scenes.space.boxes import Boxes, boxes, joined
from labutopia_lerobot.scenes.space.extent import extent

_DOUBLE = 1.25
"""Doors that are wider have two leaves [m] (DIN 18100: single ones up to 1.25 m)."""
_BEHIND_DOOR = 0.3
"""Depth of the free space on the side to which a passage's door does not open [m]."""
_BEFORE_WINDOW = 0.15
"""Depth of the free space before a window [m]."""
_VIEW_X, _VIEW_Y = (-0.9, 2.7), (-1.6, 1.9)
"""Region where nothing is higher than the bench, in the frame of the robot that looks along x [m]:
the fixed cameras of every task are in it (`scenes.views`)."""
_STAND = ((-0.35, 0.19), (-0.35, 0.35), (0.02, 2.0))
"""Region where nothing stands but the robot, in its frame [m]."""


@dataclass(frozen=True, eq=False)
class Claim:
    """Some of the room.

    Attributes:
        owner: Name of a piece or work place, or such as `door 1`.
        what: What cannot be if something solid is in it, such as `upper_door cannot open`; empty
            of what is itself solid.
        room: What it takes [m], room frame.
    """

    owner: str
    what: str
    room: Boxes


def claims(plan: Plan) -> Iterator[Claim]:
    """Yield all that a plan claims."""
    for piece in plan.pieces:
        yield from claims_of_piece(piece)
    yield from claims_of_openings(plan.openings, plan.size[2])
    for number, wall in enumerate(plan.walls, start=1):
        yield Claim(f"wall {number}", "", masonry(wall, plan.openings, plan.size[2]))
    for place in plan.work_places:
        yield from claims_of_work_place(place, bench_height(plan, place))


def claims_of_piece(piece: Placed) -> Iterator[Claim]:
    """Yield what a piece takes, and what moves out of it."""
    kind, by = extent(piece.kind), np.array([piece.x, piece.y, piece.height])
    yield Claim(piece.name, "", kind.solids.placed(piece.heading).moved(by))
    for swing in kind.swings:
        room = swing.room.placed(piece.heading).moved(by)
        yield Claim(piece.name, f"its {swing.name} cannot move freely", room)


def claims_of_openings(openings: tuple[Opening, ...], ceiling: float) -> Iterator[Claim]:
    """Yield what doors need to swing, and windows to let light in."""
    numbers = {"door": 0, "window": 0}
    for opening in openings:
        numbers[opening.kind] += 1
        name = f"{opening.kind} {numbers[opening.kind]}"
        if opening.kind == "window":
            yield Claim(name, "it is covered", _before(opening, -0.01, _BEFORE_WINDOW, ceiling))
        else:
            leaf = opening.width if opening.width < _DOUBLE else opening.width / 2
            free = WALL_THICKNESS / 2 + leaf
            yield Claim(name, "it cannot open", _before(opening, -_BEHIND_DOOR, free, ceiling))


def claims_of_work_place(place: WorkPlace, bench: float) -> Iterator[Claim]:
    """Yield where a robot stands, and what its cameras see.

    Args:
        place: The work place.
        bench: Height of its bench [m].
    """
    facing = (place.heading + 180) % 360  # boxes of a piece are turned by the way its front faces
    by = np.array([place.x, place.y, 0.0])
    view = boxes((_VIEW_X, _VIEW_Y, (bench + 0.03, 2.4)))
    for what, free in (("its view is blocked", view), ("its robot cannot stand", boxes(_STAND))):
        yield Claim(place.name, what, free.placed(facing).moved(by))  # type: ignore[arg-type]


def bench_height(plan: Plan, place: WorkPlace) -> float:
    """Return how high the bench of a work place is [m]."""
    bench = next(piece for piece in plan.pieces if piece.name == place.bench)
    return float(extent(bench.kind).hull.high[0, 2]) + bench.height


def _before(opening: Opening, start: float, end: float, ceiling: float) -> Boxes:
    """Return the room before an opening, along the way that it faces [m]."""
    half, top = opening.width / 2, min(opening.sill + opening.height, ceiling)
    spans = ((-end, -start), (-half, half), (opening.sill + 0.01, top))
    return boxes(spans).placed(opening.heading).moved(np.array([opening.x, opening.y, 0.0]))


def walls_inside(plan: Plan) -> Boxes:
    """Return what of the walls inside a room stands on the floor; of openings, doors alone."""
    doors = tuple(opening for opening in plan.openings if opening.kind == "door")
    walls = joined(*(masonry(wall, doors, plan.size[2]) for wall in plan.walls))
    standing = walls.low[:, 2] == 0.0
    return Boxes(walls.low[standing], walls.high[standing])


def masonry(wall: Wall, openings: tuple[Opening, ...], ceiling: float) -> Boxes:
    """Return what is left of a wall around the openings in it."""
    along = 0 if wall.start[1] == wall.end[1] else 1
    low, high = sorted((wall.start[along], wall.end[along]))
    across = wall.start[1 - along]
    holes = sorted(
        (
            opening
            for opening in openings
            if abs((opening.y, opening.x)[along] - across) < WALL_THICKNESS
            and low < (opening.x, opening.y)[along] < high
        ),
        key=lambda opening: (opening.x, opening.y)[along],
    )
    parts, start = [], low
    for hole in holes:
        middle = (hole.x, hole.y)[along]
        left, right = middle - hole.width / 2, middle + hole.width / 2
        parts += [(start, left, 0.0, ceiling), (left, right, hole.sill + hole.height, ceiling)]
        parts += [(left, right, 0.0, hole.sill)]
        start = right
    parts.append((start, high, 0.0, ceiling))
    sides = (across - WALL_THICKNESS / 2, across + WALL_THICKNESS / 2)
    spans = [
        ((one, other), sides, (bottom, top)) if along == 0 else (sides, (one, other), (bottom, top))
        for one, other, bottom, top in parts
        if other > one and top > bottom
    ]
    return boxes(*spans)
