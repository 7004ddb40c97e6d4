"""Places of a robot that drives, at the benches of a furnished room, found by program."""

import math
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.navigation.docking import FloorRectangle, approach_to
from labutopia_lerobot.navigation.path_planner import BlockedPlaceError, PathPlanner
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.scenes.plan import Placed, Plan
from labutopia_lerobot.scenes.room_map import room_map
from labutopia_lerobot.scenes.space.boxes import Boxes, joined
from labutopia_lerobot.scenes.space.claims import claims_of_piece
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.scenes.space.ware_room import box_of
from labutopia_lerobot.world import Dock, FloatArray, ReachedInto

_WIDEST, _LOWEST, _HIGHEST = 0.6, 0.6, 1.0
"""Least width of a top that one works at, and between which heights it is [m]; ours: desks and
benches, no shelves."""
_GAPS = (0.02, 0.06, 0.10)
"""Distances from the edge of a top to the base that are tried [m]; ours. With its arm at its front
the farthest leaves it 0.28 m before the edge: it reaches over more than 40 cm of the bench."""
_FARTHER = (0.14, 0.18)
"""Further ones before what one reaches into [m]; ours: its opening is near its front."""
_ASIDE = (0.0, 0.05, -0.05, 0.10, -0.10)
"""Distances of such places from straight before the middle [m]; ours."""
_APART = 0.2
"""Distance between places along an edge [m], and of the first from its end."""


def docks(plan: Plan, base: MobileBase, radius: float) -> tuple[Dock, ...]:
    """Return the places in the largest part of a room that is in one piece for a robot.

    Doors are open; what stands on the floor is where the plan has it.

    Args:
        plan: The room.
        base: Of the robot.
        radius: Of the disc as which it drives [m]; the paper's is 0.6.
    """
    return tuple(_reachable(plan, base, radius, _candidates(plan, base)))


def fixture_docks(plan: Plan, base: MobileBase, radius: float) -> tuple[Dock, ...]:
    """Return the nearest place straight before each piece that one reaches into; see `docks`."""
    nearest: dict[str, Dock] = {}
    for dock in _reachable(plan, base, radius, _before_fixtures(plan, base)):
        nearest.setdefault(dock.bench, dock)
    return tuple(nearest.values())


def largest_part(free: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the largest part of what is free that is in one piece."""
    regions, count = ndimage.label(free, structure=np.ones((3, 3)))
    if not count:
        return free
    sizes = ndimage.sum_labels(free, regions, np.arange(1, count + 1))
    part: NDArray[np.bool_] = regions == 1 + int(np.argmax(sizes))
    return part


def _reachable(
    plan: Plan,
    base: MobileBase,
    radius: float,
    candidates: Iterable[tuple[Placed, FloatArray, float]],
) -> Iterator[Dock]:
    """Yield those places of a base before pieces, with headings, that can be driven to."""
    occupancy, footprint = room_map(plan), FloorRectangle(*base.size)
    planner = PathPlanner.of(occupancy, base.limits, radius)
    largest = largest_part(occupancy.passable(radius))
    for piece, position, yaw in candidates:
        if base.folded and _met(plan, piece, base.folded, position, yaw):
            continue
        try:
            before = approach_to(planner, occupancy, footprint, position, yaw)
        except BlockedPlaceError:
            continue
        row, column = occupancy.cell(*before)
        if largest[max(row - 1, 0) : row + 2, max(column - 1, 0) : column + 2].any():
            yield Dock(piece.name, position, yaw, before)


def _met(
    plan: Plan,
    piece: Placed,
    folded: tuple[tuple[float, float], ...],
    position: FloatArray,
    yaw: float,
) -> bool:
    """Return whether the arm that a base before a piece has folded would be in what stands there.

    Of what is reached into, which is a single box here, it may be above.
    """
    c, s = math.cos(yaw), math.sin(yaw)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    corners = turn @ folded + np.append(position, 0.0)[:, None]
    arm = Boxes(corners.min(axis=1)[None], corners.max(axis=1)[None])
    reached_into = piece.name if isinstance(instrument(piece.kind), ReachedInto) else None
    return _standing(plan, reached_into).meet(arm)


@cache
def _standing(plan: Plan, without: str | None) -> Boxes:
    """Return all that stands in a room, its doors shut, but for a piece [m], room frame."""
    claims = (claim for piece in plan.pieces for claim in claims_of_piece(piece))
    solids = (claim.room for claim in claims if not claim.what and claim.owner != without)
    return joined(*solids, *(box_of(ware) for ware in plan.ware))


def _before_fixtures(plan: Plan, base: MobileBase) -> Iterator[tuple[Placed, FloatArray, float]]:
    """Yield what stands on the floor and is reached into, and places straight before it."""
    for piece in plan.pieces:
        if piece.on is None and isinstance(instrument(piece.kind), ReachedInto):
            for along, gap in product(_ASIDE, (*_GAPS, *_FARTHER)):
                yield piece, *_before(piece, _whole(piece), along, gap + base.size[0] / 2)


def _candidates(plan: Plan, base: MobileBase) -> Iterator[tuple[Placed, FloatArray, float]]:
    """Yield pieces with places of a base before them, and headings there."""
    worked_at = {place.bench for place in plan.work_places}
    for piece in plan.pieces:
        for top in _tops(piece, whole=piece.name in worked_at):
            low, high = top.y
            if high - low < _WIDEST or not _LOWEST <= piece.height + top.height <= _HIGHEST:
                continue
            for along in np.arange(low + _APART, high - _APART + 1e-6, _APART):
                for gap in _GAPS:
                    yield piece, *_before(piece, top, float(along), gap + base.size[0] / 2)


def _tops(piece: Placed, *, whole: bool) -> tuple[Top, ...]:
    """Return the tops of what stands on the floor; that of a work place, which is kept free, too.

    Args:
        piece: Of a plan.
        whole: Whether it is the bench of a work place.
    """
    kind = extent(piece.kind)
    if piece.on:
        return ()
    if not whole:
        return kind.tops
    return (_whole(piece),)


def _whole(piece: Placed) -> Top:
    """Return the box around a piece as a top."""
    hull = extent(piece.kind).hull
    (west, south, _), (east, north, height) = hull.low[0], hull.high[0]
    return Top(float(height), (float(west), float(east)), (float(south), float(north)))


def _before(piece: Placed, top: Top, along: float, away: float) -> tuple[FloatArray, float]:
    """Return the point before the edge of a top at which one works, and the heading to it.

    Args:
        piece: That has the top.
        top: On whose side one works.
        along: Where along the edge [m], frame of the piece.
        away: How far from the edge [m].
    """
    facing = math.radians(piece.heading)
    ahead = np.array([-math.cos(facing), -math.sin(facing)])  # x of the piece, away from its front
    left = np.array([-ahead[1], ahead[0]])
    x, yaw = (top.x[1] + away, facing) if top.behind else (top.x[0] - away, facing + math.pi)
    return np.array([piece.x, piece.y]) + x * ahead + along * left, yaw
