"""Is a plan a room that one can work in? Every fault by name."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from labutopia_lerobot.scenes.plan import Placed, Plan
from labutopia_lerobot.scenes.plans import PlanError
from labutopia_lerobot.scenes.room_map import room_map
from labutopia_lerobot.scenes.space.boxes import TOUCHING, Boxes, boxes, joined
from labutopia_lerobot.scenes.space.claims import Claim, claims
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.scenes.space.reach import BENCH_SIDE, REACH, ROBOT_RADIUS, Reach
from labutopia_lerobot.scenes.space.ware_room import box_of, in_a_holder, on_a_board

HUNG_WITHIN = 0.05
"""Greatest distance from a hanging piece to the wall behind it [m]."""


def proven(plan: Plan, source: str) -> Plan:
    """Return a plan that has no fault.

    Args:
        plan: To be proven.
        source: Where it is from, for the message.

    Raises:
        PlanError: If it has any; the message lists them.
    """
    if problems := faults(plan):
        raise PlanError("\n".join((f"{source} cannot be furnished so:", *problems)))
    return plan


def faults(plan: Plan) -> list[str]:
    """Return what is wrong with a plan, a sentence each; nothing if it is proven.

    Nothing overlaps or is outside, everything stands on something, openings, views, doors, drawers
    and lids are free over their whole range, ware stands wholly on a board or in its holder and
    in the way of nothing, and a robot of 0.6 m gets from the entrance to every
    work place, to every side of a bench, and to within its reach of every front.
    """
    claimed = list(claims(plan))
    return [
        *_outside(plan, claimed),
        *_conflicts(claimed),
        *_hanging(plan, claimed),
        *_unreached(plan),
        *_ware(plan, claimed),
    ]


def _outside(plan: Plan, claimed: list[Claim]) -> Iterator[str]:
    low, high = np.full(3, -TOUCHING), np.array(plan.size) + TOUCHING
    for claim in claimed:
        if claim.owner.startswith(("door ", "window ", "wall ")):
            continue
        if (claim.room.low < low).any() or (claim.room.high > high).any():
            yield f"{claim.owner}: {claim.what or 'it is not inside'}: the room ends there"
    for number, opening in enumerate(plan.openings, start=1):
        half, along = opening.width / 2, (opening.x, opening.y)[opening.heading % 180 == 0]
        side = plan.size[opening.heading % 180 == 0]
        top = opening.sill + opening.height
        if along < half or along + half > side or top > plan.size[2]:
            yield f"{opening.kind} (openings[{number - 1}]): it is wider or higher than its wall"


def _conflicts(claimed: list[Claim]) -> Iterator[str]:
    for one, other in combinations(claimed, 2):
        if one.owner == other.owner or (one.what and other.what):
            continue
        if one.owner.startswith("wall ") and other.owner.startswith("wall "):
            continue  # they meet
        if one.room.hull.meet(other.room.hull) and one.room.meet(other.room):
            if one.what or other.what:
                free, solid = (one, other) if one.what else (other, one)
                yield f"{free.owner}: {free.what}: {solid.owner} is in its way"
            else:
                yield f"{one.owner} and {other.owner} overlap"


def _hanging(plan: Plan, claimed: list[Claim]) -> Iterator[str]:
    """Yield what stands on nothing."""
    named = {piece.name: piece for piece in plan.pieces}
    masonry = [claim.room for claim in claimed if claim.owner.startswith("wall ")]
    for piece in plan.pieces:
        if piece.on is not None:
            if not stands_on(piece, named[piece.on]):
                yield f"{piece.name}: it does not stand on a top of {piece.on}"
        elif abs(piece.height) > TOUCHING and not _hangs(plan, piece, masonry):
            yield f"{piece.name}: it is {piece.height:g} m above the floor and hangs at no wall"


def stands_on(piece: Placed, carrier: Placed) -> bool:
    """Return whether what of a piece touches the ground is all on one top of another."""
    base = extent(piece.kind).sole.placed(piece.heading)
    base = base.moved(np.array([piece.x, piece.y, 0.0]))
    for top in extent(carrier.kind).tops:
        area = boxes((top.x, top.y, (-1.0, 1.0))).placed(carrier.heading)
        area = area.moved(np.array([carrier.x, carrier.y, 0.0]))
        inside = (base.low[:, :2] >= area.low[:, :2] - TOUCHING).all()
        inside &= (base.high[:, :2] <= area.high[:, :2] + TOUCHING).all()
        if inside and abs(carrier.height + top.height - piece.height) <= TOUCHING:
            return True
    return False


def _ware(plan: Plan, claimed: list[Claim]) -> Iterator[str]:
    """Yield what is wrong with ware: where it stands, and what it is in the way of."""
    named = {piece.name: piece for piece in plan.pieces}
    rooms = [box_of(ware) for ware in plan.ware]
    solid = [claim for claim in claimed if len(claim.room.low)]
    hulls = joined(*(claim.room.hull for claim in solid))
    for ware, room in zip(plan.ware, rooms, strict=True):
        carrier = named[ware.on]
        held = in_a_holder(ware, carrier)
        if not held and not on_a_board(ware, carrier):
            yield f"{ware.name}: it stands on no top and no shelf of {ware.on}, nor in its places"
        for claim in (solid[number] for number in np.flatnonzero(room.meets(hulls))):
            if claim.room.meet(room) and not (held and claim.owner == ware.on):
                fault = f": {claim.what}: {ware.name} is in its way" if claim.what else ""
                yield f"{claim.owner}{fault or f' and {ware.name} overlap'}"
    taken = joined(*rooms)
    for number, room in enumerate(rooms[:-1]):
        for other in np.flatnonzero(room.meets(Boxes(*(side[number + 1 :] for side in taken)))):
            yield f"{plan.ware[number].name} and {plan.ware[number + 1 + other].name} overlap"


def _hangs(plan: Plan, piece: Placed, masonry: list[Boxes]) -> bool:
    """Return whether the back of a piece is at a wall."""
    width, depth, height = plan.size
    far = 9.0
    around = boxes(
        ((-far, 0.0), (-far, far), (0.0, height)),
        ((width, width + far), (-far, far), (0.0, height)),
        ((-far, width + far), (-far, 0.0), (0.0, height)),
        ((-far, width + far), (depth, depth + far), (0.0, height)),
    )
    hull = extent(piece.kind).hull
    (left, right), (bottom, top) = ((hull.low[0, n], hull.high[0, n]) for n in (1, 2))
    back = float(hull.high[0, 0])
    behind = boxes(((back, back + HUNG_WITHIN), (left, right), (bottom, top)))
    behind = behind.placed(piece.heading).moved(np.array([piece.x, piece.y, piece.height]))
    return any(behind.meet(wall) for wall in (around, *masonry))


def _unreached(plan: Plan) -> Iterator[str]:
    reach = Reach.of(room_map(plan), plan.openings[0])
    robot = f"a robot of {2 * ROBOT_RADIUS:g} m from the entrance"
    if not len(reach.middles):
        yield f"door 1: {robot} does not get in"
        return
    for place in plan.work_places:
        if not reach.gets_to(place):
            yield f"{place.name}: {robot} does not get there"
    for piece in plan.pieces:
        if not reach.front_of(piece):
            yield f"{piece.name}: {robot} does not get within {REACH:g} m of its front"
        for top in extent(piece.kind).tops:
            if not reach.side_of(piece, top):
                side = "back" if top.behind else "front"
                yield f"{piece.name}: {robot} does not get within {BENCH_SIDE:g} m of its {side}"
