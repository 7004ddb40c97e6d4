"""What of a furnished room stands within the reach of the robot at its first work place.

That is real: it can be opened, pushed and switched on. What is further away is a picture.
"""

from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plan import Heading, Placed, PlacedWare, Plan
from labutopia_lerobot.scenes.space.boxes import Boxes, joined
from labutopia_lerobot.scenes.space.claims import claims_of_piece
from labutopia_lerobot.scenes.space.ware_room import box_of, closure_of, in_a_holder, made
from labutopia_lerobot.world import FloatArray

if TYPE_CHECKING:
    from labutopia_lerobot.labware.piece import Piece

_REACH = 1.25
"""Distance from the robot's base up to which things are real [m]: the longest arm's 0.90, its hand
and what that holds."""
PREFIX = "room_"
"""Beginning of their names, so that they are none of a task's."""


class RealPiece(NamedTuple):
    """A piece of a room that is built whole.

    Attributes:
        piece: The piece.
        at: Its origin [m], room frame.
        heading: The way its front faces.
        room: What it takes, also while anything of it moves [m], room frame.
    """

    piece: "Piece"
    at: tuple[float, float, float]
    heading: Heading
    room: Boxes


@cache
def real_names(plan: Plan) -> frozenset[str]:
    """Return which pieces and ware of a plan are real: what is near, and what it stands on.

    A rack comes with all that is in it.
    """
    place = plan.work_places[0]
    stand = np.array([place.x, place.y, LABORATORY.robot_stand[2]])
    pieces = {piece.name: piece for piece in plan.pieces if piece.name != place.bench}
    real = {
        name for name, piece in pieces.items() if near(stand, next(claims_of_piece(piece)).room)
    }
    real |= {ware.name for ware in plan.ware if near(stand, box_of(ware))}
    things: dict[str, Placed | PlacedWare] = {**pieces, **{ware.name: ware for ware in plan.ware}}
    carriers = {things[name].on for name in real}
    carriers |= {pieces[name].on for name in carriers if name in pieces}
    real |= {name for name in carriers if name}
    held = (ware for ware in plan.ware if ware.on in real and in_a_holder(ware, pieces[ware.on]))
    return frozenset(real | {ware.name for ware in held})


@cache
def real_pieces(plan: Plan) -> tuple[RealPiece, ...]:
    """Return what of a plan is real, under names of its own; nothing is in its vessels."""
    return (*_real_instruments(plan), *_real_ware(plan))


def near(point: FloatArray, room: Boxes) -> bool:
    """Return whether any of some boxes is within the robot's reach of a point."""
    away = np.clip(point, room.low, room.high) - point
    return bool((np.linalg.norm(away, axis=1) < _REACH).any())


def _real_instruments(plan: Plan) -> Iterator[RealPiece]:
    for placed in plan.pieces:
        if placed.name in real_names(plan):
            piece = instrument(placed.kind, f"{PREFIX}{placed.name}")
            room = joined(*(claim.room for claim in claims_of_piece(placed)))
            at = placed.x, placed.y, placed.height
            yield RealPiece(piece, at, placed.heading, room)


def _real_ware(plan: Plan) -> Iterator[RealPiece]:
    carriers = {piece.name: piece for piece in plan.pieces}
    for ware in plan.ware:
        if ware.name in real_names(plan):
            name, heading = f"{PREFIX}{ware.name}", carriers[ware.on].heading
            piece = made(ware.kind, ware.size, name)
            yield RealPiece(piece, (ware.x, ware.y, ware.height), heading, box_of(ware))
            if ware.closed:
                closure, up = closure_of(ware.kind, ware.size, name)
                at = ware.x, ware.y, ware.height + up
                yield RealPiece(closure, at, heading, box_of(ware))
