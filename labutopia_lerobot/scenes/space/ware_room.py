"""The room that ware takes on benches and shelves, and its places in holders."""

from functools import cache

import numpy as np

from labutopia_lerobot.labware.glass.catalogue import closed, ware
from labutopia_lerobot.labware.glass.closure import Closure
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.instruments.support.cork_ring import CorkRing
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.scenes.plan import Placed, PlacedWare
from labutopia_lerobot.scenes.space.boxes import Boxes, boxes
from labutopia_lerobot.scenes.space.extent import extent

_IN_RING = (1.05, 2.0)
"""Least and greatest width of a round flask that sits in a cork ring, in widths of its hole."""
_IN_BORE = (0.8, 1.0)
"""Least and greatest width of a tube that stands in an opening, in widths of that."""


@cache
def made(kind: str, size: str, name: str = "") -> Vessel | Utensil:
    """Return a piece of ware.

    Raises:
        UnknownGlasswareError: There is no such kind, or it has no such size.
    """
    return ware(kind, size, name or kind)


@cache
def closure_of(kind: str, size: str, name: str = "") -> tuple[Closure, float]:
    """Return the closure of a vessel, and how high above the vessel's base its origin is [m].

    Raises:
        UnknownGlasswareError: There is no such vessel, or it comes without a closure.
    """
    vessel, closure = closed(kind, size, name or kind)
    return closure, closure.seat(vessel)


def height_of(placed: PlacedWare) -> float:
    """Return how far ware reaches above its base, with its closure [m]."""
    height = made(placed.kind, placed.size).height
    if not placed.closed:
        return height
    closure, seat = closure_of(placed.kind, placed.size)
    return max(height, seat + closure.height)


def box_of(placed: PlacedWare) -> Boxes:
    """Return the room that ware takes: a box around it, room frame [m]."""
    radius = made(placed.kind, placed.size).footprint_radius
    across = (-radius, radius)
    at = np.array([placed.x, placed.y, placed.height])
    return boxes((across, across, (0.0, height_of(placed)))).moved(at)


def on_a_board(placed: PlacedWare, carrier: Placed) -> bool:
    """Return whether all of some ware is over one top or shelf of a piece, and stands on it."""
    box, kind = box_of(placed), extent(carrier.kind)
    for top in (*kind.tops, *kind.boards):
        area = boxes((top.x, top.y, (-9.0, 9.0))).placed(carrier.heading)
        area = area.moved(np.array([carrier.x, carrier.y, 0.0]))
        level = abs(carrier.height + top.height - placed.height) < 1e-3
        if level and (box.low >= area.low).all() and (box.high <= area.high).all():
            return made(placed.kind, placed.size).stands
    return False


def in_a_holder(placed: PlacedWare, holder: Placed) -> bool:
    """Return whether some ware is in one of the places of a rack or a ring."""
    at = np.array([placed.x, placed.y, placed.height])
    return any(
        np.abs(at - spot).max() < 1e-3 for spot in spots_in(holder, placed.kind, placed.size)
    )


def spots_in(holder: Placed, kind: str, size: str) -> list[Vector]:
    """Return where the base of some ware can be in a holder, room frame, in whole millimetres."""
    turned = [
        boxes(((x, x), (y, y), (z, z))).placed(holder.heading).low[0]
        for x, y, z in _spots(holder.kind, kind, size)
    ]
    at = np.array([holder.x, holder.y, holder.height])
    spots = [np.round(at + spot, 3).tolist() for spot in turned]
    return [(x, y, z) for x, y, z in spots]


@cache
def _spots(holder_kind: str, kind: str, size: str) -> tuple[Vector, ...]:
    """Return where the base of some ware can be in a holder, in the frame of that [m]."""
    holder, piece = instrument(holder_kind), made(kind, size)
    if not isinstance(piece, Vessel) or not isinstance(holder, Equipment):
        return ()
    widest = 2 * max(radius for radius, _ in piece.profile.outer)
    if isinstance(holder, CorkRing):
        fits = _IN_RING[0] < widest / holder.hole < _IN_RING[1]
        return ((0.0, 0.0, holder.seat(piece.profile)),) if fits else ()
    return tuple(
        place.at
        for place in holder.places
        if place.depth and _IN_BORE[0] < widest / place.width < _IN_BORE[1]
    )
