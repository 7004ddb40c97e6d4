"""What of a furnished room a robot gets to, found from its plan."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np

from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.path_planner import RADIUS
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.scenes.docks import docks, fixture_docks, largest_part
from labutopia_lerobot.scenes.ground import Fixture, Ground, Spot
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plan import Placed, Plan
from labutopia_lerobot.scenes.room_map import frame_around, map_around
from labutopia_lerobot.scenes.space.boxes import Boxes, joined
from labutopia_lerobot.scenes.space.claims import claims_of_piece, walls_inside
from labutopia_lerobot.scenes.space.ware_room import box_of
from labutopia_lerobot.scenes.within_reach import PREFIX
from labutopia_lerobot.world import BENCH, Dock, FloatArray, Floor

CLEARANCE = 0.68
"""Radius of the disc as which a robot gets to sinks [m]; ours: in a gap of the paper's 1.2 m
corners 0.62 m from the middle, as the Ridgeback's are, touch what stands on either side."""
_FROM_NEAREST = (0.05, 0.09, 0.13, 0.17)
"""Distances of places for things before the nearest at which the arm takes them well [m]; ours."""
_LEFT = (-0.08, -0.04, 0.0, 0.04, 0.08)
"""The same to the left of it [m]; ours: docks are 0.2 m apart."""
_HAND = ((-0.30, 0.10), (-0.16, 0.45))
"""Region around a thing that is free of other things, ahead of it and to its left [m]; ours: the
hand comes to vessels from the left (`Robot.vessel_approach`), with 0.35 m of wrist behind it and
0.10 m of approach."""
_HEADROOM = 0.50
"""Height over the bench that is free there [m]; ours: a beaker in a hand, lifted by 0.25 m."""
_FOOT = 0.05
"""Half the width of the level ground that a thing gets [m]; ours: a wide beaker's."""
_INSTRUMENT = 0.17
"""Half the width of the level ground, free of other things, on which an instrument stands [m];
ours: a top-pan balance is 0.32 m long."""
_OVEN = ((0.66, 1.32), (-0.45, 0.42))
"""Ground of a bench-top oven, ahead of an arm and to the left of it [m]: that of `DryingOven` where
level4/drying_beakers has it."""
_OPEN_OVEN = ((0.16, 1.32), (-0.45, 0.75))
"""The same with the door, up to 120 degrees open, and the arm that goes in."""
_OVEN_HEADROOM = 0.90
"""Height over the bench that is free there [m]: the oven's on its stand, and the arm's."""
_LOWEST, _HIGHEST = 0.6, 1.0
"""Heights of benches [m], as for docks."""


@cache
def surveyed(plan: Plan, base: MobileBase) -> Ground:
    """Return what of a furnished room a robot gets to, as the paper's disc of 0.6 m.

    Args:
        plan: The room; it has a work place.
        base: Of the robot.
    """
    place = plan.work_places[0]
    turn, moved = frame_around(place)
    yaw = -math.radians(place.heading)

    def in_world(dock: Dock) -> Dock:
        return replace(
            dock,
            bench=BENCH if dock.bench == place.bench else f"{PREFIX}{dock.bench}",
            position=turn @ dock.position + moved,
            before=turn @ dock.before + moved,
            yaw=math.remainder(dock.yaw + yaw, 2.0 * math.pi),
        )

    found = [(dock, in_world(dock)) for dock in docks(plan, base, RADIUS)]
    spots = [
        Spot(there, np.append(turn @ point[:2] + moved, point[2]), wide, above)
        for dock, there in found
        for point, wide, above in _points(plan, base, dock)
    ]
    occupancy: Occupancy = map_around(plan, place)
    # Where its corners have room, too: it begins with a turn.
    starts = largest_part(occupancy.passable(RADIUS)) & occupancy.passable(base.radius)
    corners = np.stack([corner[:, :2] @ turn.T + moved for corner in walls_inside(plan)])
    floor = Floor(
        occupancy.cells,
        occupancy.origin,
        occupancy.resolution,
        tuple(there for _, there in found),
        tuple(in_world(dock) for dock in fixture_docks(plan, base, CLEARANCE)),
        np.stack([corners.min(axis=0), corners.max(axis=0)], axis=1),
    )
    fixtures: dict[str, Fixture] = {}
    pieces = {f"{PREFIX}{piece.name}": piece for piece in plan.pieces}
    for dock in floor.fixture_docks:
        piece = pieces[dock.bench]
        at = turn @ (piece.x, piece.y) + moved
        above = np.append(at, piece.height - LABORATORY.bench.height)
        fixtures.setdefault(piece.kind, Fixture(piece.name, dock, above, dock.yaw))
    deep = [
        Spot(there, np.append(_axes(base, there)[2], height), wide=True, above=False)
        for dock, there in found
        if (height := _deep(plan, base, dock)) is not None
    ]
    return Ground(floor, tuple(spots), tuple(deep), fixtures, occupancy.middles(starts))


def _points(plan: Plan, base: MobileBase, dock: Dock) -> Iterator[tuple[FloatArray, bool, bool]]:
    """Yield the places for things that a robot at a dock reaches, shape (3,) [m], room frame.

    Their heights are those above the bench of the work place. With each comes whether an instrument
    can stand there, and whether the arm reaches it from above.
    """
    solids, own = _solids(plan), _bench(plan, dock.bench)
    ahead, left, arm = _axes(base, dock)
    for along in (round(base.ahead[0] + more, 3) for more in _FROM_NEAREST):
        for beside in _LEFT:
            point = arm + along * ahead + beside * left
            height = _level(own, point, _FOOT)
            if not _LOWEST <= height <= _HIGHEST:
                continue
            (back, front), (right, far_left) = _HAND
            corners = np.array([point + back * ahead + right * left,
                                point + front * ahead + far_left * left])  # fmt: skip
            if _clear(solids, corners.min(axis=0), corners.max(axis=0), height):
                wide = _level(own, point, _INSTRUMENT) == height and _clear(
                    solids, point - _INSTRUMENT, point + _INSTRUMENT, height
                )
                at = np.append(point, height - LABORATORY.bench.height)
                yield at, wide, along <= base.above


def _deep(plan: Plan, base: MobileBase, dock: Dock) -> float | None:
    """Return how high the ground is for a bench-top oven before a dock; None if none can stand.

    That is above the bench of the work place [m].
    """
    ahead, left, arm = _axes(base, dock)
    ground, room = (
        np.sort([arm + near * ahead + right * left, arm + far * ahead + far_left * left], axis=0)
        for (near, far), (right, far_left) in (_OVEN, _OPEN_OVEN)
    )
    own = _bench(plan, dock.bench)
    height = _level(own, ground.mean(axis=0), np.ptp(ground, axis=0) / 2)
    level = _LOWEST <= height <= _HIGHEST
    if not level or not _clear(_solids(plan), room[0], room[1], height, _OVEN_HEADROOM):
        return None
    return height - LABORATORY.bench.height


def _axes(base: MobileBase, dock: Dock) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return ahead and left of a base at a dock, and where the base of its arm is, shape (2,)."""
    ahead = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
    left = np.array([-ahead[1], ahead[0]])
    return ahead, left, dock.position + base.arm[0] * ahead + base.arm[1] * left


def _level(bench: Boxes, point: FloatArray, half: float | FloatArray) -> float:
    """Return how high the ground is that reaches so far around a point [m], 0 if there is none."""
    below = (bench.low[:, :2] < point - half) & (bench.high[:, :2] > point + half)
    return float(bench.high[below.all(axis=1), 2].max(initial=0.0))


def _clear(
    solids: Boxes, low: FloatArray, high: FloatArray, height: float, headroom: float = _HEADROOM
) -> bool:
    """Return whether nothing stands on a rectangle of ground of a height [m], or just above it."""
    inside = ((solids.low[:, :2] < high) & (solids.high[:, :2] > low)).all(axis=1)
    standing = solids.high[:, 2] > height + 0.005
    return not (inside & standing & (solids.low[:, 2] < height + headroom)).any()


@cache
def _solids(plan: Plan) -> Boxes:
    """Return all that stands in a room, and what opens out of it [m], room frame."""
    claimed = (claim.room for piece in plan.pieces for claim in claims_of_piece(piece))
    return joined(*claimed, *(box_of(ware) for ware in plan.ware))


@cache
def _bench(plan: Plan, name: str) -> Boxes:
    """Return what a piece of a room consists of [m], room frame."""
    piece: Placed = next(piece for piece in plan.pieces if piece.name == name)
    return joined(*(claim.room for claim in claims_of_piece(piece) if not claim.what))
