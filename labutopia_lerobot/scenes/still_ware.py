"""Ware as a picture from afar needs it: a wall, its bright lip, its closure and what is in it."""

from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np

from labutopia_lerobot.labware.glass.closure import Closure
from labutopia_lerobot.labware.glass.material import Color
from labutopia_lerobot.labware.glass.profile import Point
from labutopia_lerobot.labware.glass.utensil import Utensil
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.labware.parts import shell
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.form import Form
from labutopia_lerobot.labware.parts.shell import Shell
from labutopia_lerobot.scenes.space.ware_room import closure_of, made
from labutopia_lerobot.substances.substance import substance

type StillPart = tuple[Shell, Color, float]
"""A mesh, its colour, and how strongly it reflects lights, 0 to 1."""

_AROUND = 6
"""Steps around an axis: a hand's breadth is 12 pixels wide at 2 m."""
_RIM = 0.0025
"""Height of the bright band at the lip [m], the edge of what is otherwise hardly seen."""
_WITHIN = 0.96
"""Radius of contents as a part of the wall's, so that the wall is before them."""
_FLAT = 0.003
"""Greatest deviation of a plainer outline [m]: half a pixel at 2 m, see `shell.coarse`."""
_STRONG = 0.55
"""Opacity of a wall from which a vessel of stained glass looks opaque from afar."""


@cache
def still_ware(
    kind: str, size: str, closed: bool = False, contents: str = "", level: float = 0.0
) -> tuple[StillPart, ...]:
    """Return what is seen of some ware from some metres away, in its own frame.

    Args:
        kind: Of the catalogue of ware.
        size: Of that kind.
        closed: Whether its closure is on.
        contents: Name of the substance in it; empty for none.
        level: Height of that, as a share of the vessel's.
    """
    piece = made(kind, size)
    with shell.coarse():
        parts = [*(_utensil(piece) if isinstance(piece, Utensil) else _vessel(piece, closed))]
        if contents and isinstance(piece, Vessel):
            parts.append(_contents(piece, contents, level))
        if closed:
            parts.append(_closure(piece, *closure_of(kind, size)))
    return tuple(parts)


def _vessel(piece: Vessel, closed: bool) -> Iterator[StillPart]:
    """Yield wall, lip, and what is joined to it."""
    outer, of = piece.profile.outer, piece.material
    opaque = of.wall[3] > _STRONG
    wall: Color = (*of.wall[:3], 1.0 if opaque else of.wall[3])
    yield shell.turned(_plain(outer), _AROUND), wall, of.shine
    if opaque and not closed:  # one sees into it
        yield shell.turned([piece.profile.inner[-1], piece.profile.inner[0]], _AROUND), wall, 0.1
    if not opaque and not closed:
        lip = (piece.height - _RIM, piece.height)
        band = [(piece.profile.outer_radius(height) + 2e-4, height) for height in lip]
        yield shell.turned(band, _AROUND), (*of.edge[:3], 1.0), of.shine
    yield from _forms(piece.joined)


def _contents(piece: Vessel, name: str, level: float) -> StillPart:
    """Return what is in a vessel, up to a level."""
    top = max(level * piece.height, 2 * piece.profile.bottom)
    side: list[Point] = [
        (_WITHIN * radius, height) for radius, height in piece.profile.inner if height < top
    ]
    radius = _WITHIN * piece.profile.inner_radius(top)
    color: Color = (*substance(name).rgba[:3], 1.0)
    return shell.turned([*_plain([*side, (radius, top)]), (0.0, top)], _AROUND), color, 0.6


def _closure(piece: Vessel | Utensil, closure: Closure, seat: float) -> StillPart:
    """Return a closure as a plain cap: what of it is over the lip."""
    radius, top = closure.footprint_radius, seat + closure.height
    low = max(seat, piece.height - 0.5 * closure.height)
    look = FINISHES[closure.shape.forms[0].look]
    color: Color = (*look.rgba[:3], 1.0)
    return shell.turned([(radius, low), (radius, top), (0.0, top)], _AROUND), color, look.specular


def _utensil(piece: Utensil) -> Iterator[StillPart]:
    yield from _forms(piece.shape.forms)


def _forms(forms: Sequence[Form]) -> Iterator[StillPart]:
    for form in forms:
        if not shell.negligible(drawn := form.shell()):
            look = FINISHES[form.look]
            yield drawn, look.rgba, look.specular


def _plain(outline: Sequence[Point]) -> list[Point]:
    """Return an outline without the corners that hardly show (Douglas and Peucker, 1973)."""
    points = np.asarray(outline, float)
    along, away = points[-1] - points[0], points - points[0]
    beside = np.abs(along[0] * away[:, 1] - along[1] * away[:, 0]) / np.hypot(*along)
    furthest = int(beside.argmax())
    if beside[furthest] < _FLAT:
        return [outline[0], outline[-1]]
    return [*_plain(outline[: furthest + 1]), *_plain(outline[furthest:])[1:]]
