"""Scoring of a place: near edges, well apart or in a row, in line with its like.

The three terms of the paper ("Environment Generation Pipeline"); their weights are ours. Sums and
quotients only, rounded, so that every machine finds the same best one.
"""

import numpy as np

from labutopia_lerobot.scenes.generation.sketch import Entry, Sketch
from labutopia_lerobot.scenes.space.boxes import Boxes, joined
from labutopia_lerobot.world import FloatArray

_FLUSH = 0.02
"""Greatest misalignment that still counts as in line [m]."""


def score(entry: Entry, sketch: Sketch) -> float:
    """Return how well a piece stands; more is better."""
    where = entry.need.where
    others = [
        other
        for other in sketch.entries
        if other.region == entry.region and other.piece.on == entry.piece.on
    ]
    value = where.edge * _edge(entry, sketch)
    if others:
        nearest = _nearest(entry.room.outline, joined(*(other.room.outline for other in others)))
        value += min(nearest, where.apart) / where.apart if where.apart else 1 / (1 + nearest)
        value += _alignment(entry, others)
    if entry.need.near is not None:
        value += _nearness(entry, entry.need.near, sketch)
    return round(value, 6)


def _edge(entry: Entry, sketch: Sketch) -> float:
    """Return 1 in a corner, less the farther from the two nearest edges [1/m]."""
    taken = joined(entry.room.outline, entry.room.frees).hull if entry.place else entry.room.outline
    area = np.array([entry.region.x, entry.region.y])
    if entry.piece.on is not None:
        area = _carrier(entry, sketch)
    (left, bottom), (right, top) = taken.low[0, :2], taken.high[0, :2]
    sides = sorted([left - area[0, 0], area[0, 1] - right, bottom - area[1, 0], area[1, 1] - top])
    return float(0.5 / (1 + abs(sides[0])) + 0.5 / (1 + abs(sides[1])))


def _carrier(entry: Entry, sketch: Sketch) -> FloatArray:
    """Return least and greatest x and y of what a piece stands on, shape (2, 2) [m]."""
    carrier = next(other for other in sketch.entries if other.piece.name == entry.piece.on)
    hull = carrier.room.outline
    return np.column_stack([hull.low[0, :2], hull.high[0, :2]])


def _nearest(one: Boxes, others: Boxes) -> float:
    """Return how far a box is from the nearest of others on the floor [m]."""
    away = np.maximum(one.low - others.high, others.low - one.high)
    apart = np.maximum(away, 0.0)
    return float((apart[:, 0] + apart[:, 1]).min())


def _alignment(entry: Entry, others: list[Entry]) -> float:
    """Return the share of its like that it is in line with, half for being parallel."""
    like = [other.piece for other in others if other.piece.kind == entry.piece.kind]
    if not like:
        return 0.0
    piece, total = entry.piece, 0.0
    for other in like:
        if (piece.heading - other.heading) % 180 == 0:
            across = (piece.y - other.y) if piece.heading % 180 else (piece.x - other.x)
            along = (piece.x - other.x) if piece.heading % 180 else (piece.y - other.y)
            total += 0.5 + 0.5 * (min(abs(across), abs(along)) < _FLUSH)
    return total / len(like)


def _nearness(entry: Entry, near: str, sketch: Sketch) -> float:
    """Return 1 beside what it needs, less the farther [1/m]."""
    away = min(
        abs(other.x - entry.piece.x) + abs(other.y - entry.piece.y)
        for other in sketch.standing(entry.region).of_kind(near)
    )
    return 1 / (1 + away)
