"""The shell of a plan: how large, inside walls, doors and windows; its rooms as regions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.scenes.generation.family import Chamber, Corridor, Family, Need, Range
from labutopia_lerobot.scenes.plan import WALL_THICKNESS, Heading, Opening, Wall

_STEP = 0.1
"""Rooms are as long as a whole number of these [m]."""
_JAMB = 0.15
"""Least wall beside a door or window [m]."""
_DOOR_HEIGHT = 2.1
"""Height of the opening [m]: doors of 2,110 mm (DIN 18101)."""
_WINDOW = (1.2, 1.8)
_SILL, _WINDOW_HEIGHT = 1.0, 1.3
"""Width, height of the lower edge and height of windows [m]: above benches of 0.9 m."""


class FootprintError(UserError, ValueError):
    """A size that a family cannot have."""


@dataclass(frozen=True)
class Region:
    """One of the rooms of a plan, between its walls.

    Attributes:
        name: As its chamber; `corridor` of the corridor.
        x: Least and greatest [m].
        y: Least and greatest [m].
        outer: Its outer walls, by the way that they face.
        needs: Furniture and instruments that it must have.
    """

    name: str
    x: tuple[float, float]
    y: tuple[float, float]
    outer: frozenset[Heading]
    needs: tuple[Need, ...]


@dataclass(frozen=True)
class Footprint:
    """A plan before anything stands in it; see `plan.Plan`."""

    size: tuple[float, float, float]
    walls: tuple[Wall, ...]
    openings: tuple[Opening, ...]
    regions: tuple[Region, ...]


def draw_footprint(
    family: Family, rng: np.random.Generator, size: tuple[float, float] | None = None
) -> Footprint:
    """Draw the shell of a laboratory.

    Args:
        family: What kind it is.
        rng: Draws.
        size: Width and depth of its room [m] instead of those of the family.

    Raises:
        FootprintError: If the family has several rooms and a size was said, or it is not positive.
    """
    if size is not None and (family.corridor is not None or min(size) < 1.5):
        raise FootprintError(
            f"{family.name} has {len(family.rooms)} rooms: its size is drawn"
            if family.corridor is not None
            else f"A room of {size[0]:g} x {size[1]:g} m is none: at least 1.5 x 1.5 m"
        )
    if family.corridor is None:
        return _one_room(family, family.rooms[0], rng, size)
    return _on_a_corridor(family, family.corridor, rng)


def _one_room(
    family: Family, room: Chamber, rng: np.random.Generator, size: tuple[float, float] | None
) -> Footprint:
    width, depth = size or (_drawn(room.width, rng), _drawn(room.depth, rng))
    sides: tuple[Heading, ...] = (90, 0, 180)  # of the entrance: the south, west or east wall
    side = sides[int(rng.integers(len(sides)))]
    corner: list[Heading] = [one for one in sides[1:] if one != side]
    outer = frozenset[Heading](
        {270, corner[int(rng.integers(len(corner)))]}
    )  # at a corner of the house
    region = Region("", (0.0, width), (0.0, depth), outer, room.needs)
    entrance = _door(region, side, room.door, rng)
    windows = _windows(region, room.windows, rng)
    return Footprint((width, depth, family.height), (), (entrance, *windows), (region,))


def _on_a_corridor(family: Family, corridor: Corridor, rng: np.random.Generator) -> Footprint:
    widths = [_drawn(room.width, rng) for room in family.rooms]
    aisle, depth = _drawn(corridor.width, rng), _drawn(family.rooms[0].depth, rng)
    total = round(sum(widths) + WALL_THICKNESS * (len(widths) - 1), 3)
    south = round(aisle + WALL_THICKNESS, 3)
    size = (total, round(south + depth, 3), family.height)
    middle = round(aisle + WALL_THICKNESS / 2, 3)
    walls = [Wall((0.0, middle), (total, middle))]
    hall = Region("corridor", (0.0, total), (0.0, aisle), frozenset({90}), corridor.needs)
    regions, doors, start = [hall], [], 0.0
    windows: list[Opening] = []
    entrance = Opening(
        "door", 0.0, round(aisle / 2, 3), 0, min(corridor.door, aisle - 0.2), _DOOR_HEIGHT
    )
    for number, (room, width) in enumerate(zip(family.rooms, widths, strict=True)):
        end = round(start + width, 3)
        outer: set[Heading] = {270}
        if number:
            x = round(start - WALL_THICKNESS / 2, 3)
            walls.append(Wall((x, aisle), (x, size[1])))
        region = Region(room.name, (start, end), (south, size[1]), frozenset(outer), room.needs)
        regions.append(region)
        doors.append(_door(region, 90, room.door, rng, middle))
        windows += _windows(region, room.windows, rng)
        start = round(end + WALL_THICKNESS, 3)
    openings = (entrance, *doors, *windows)
    return Footprint(size, tuple(walls), openings, tuple(regions))


def _door(
    region: Region,
    side: Heading,
    width: float,
    rng: np.random.Generator,
    wall: float | None = None,
) -> Opening:
    """Draw where on a side of a region a door is.

    Args:
        region: Into which it opens.
        side: The wall, by the way that it faces.
        width: Of the door [m].
        rng: Draws.
        wall: Where the middle of the wall is [m]; the outside of the region if not said.
    """
    low, high = region.x if side % 180 else region.y
    least = low + _JAMB + width / 2
    most = max(high - _JAMB - width / 2, least)
    along = round(least + _STEP * int(rng.integers(int((most - least) / _STEP + 1e-6) + 1)), 3)
    edges = {90: region.y[0], 270: region.y[1], 0: region.x[0], 180: region.x[1]}
    at = edges[side] if wall is None else wall
    x, y = (along, at) if side % 180 else (at, along)
    return Opening("door", x, y, side, width, _DOOR_HEIGHT)


def _windows(region: Region, count: tuple[int, int], rng: np.random.Generator) -> Sequence[Opening]:
    """Draw the windows in the north wall of a region: as wide as each other, evenly spread."""
    number = int(rng.integers(count[0], count[1] + 1))
    width = _drawn(_WINDOW, rng)
    low, high = region.x
    room = (high - low) / max(number, 1)
    if number == 0 or room < width + 2 * _JAMB:
        return ()
    middles = [round(low + room * (n + 0.5), 3) for n in range(number)]
    return [Opening("window", x, region.y[1], 270, width, _WINDOW_HEIGHT, _SILL) for x in middles]


def _drawn(span: Range, rng: np.random.Generator) -> float:
    """Draw a length from a range, in whole steps [m]."""
    low, high = (round(end / _STEP) for end in span)
    return round(_STEP * int(rng.integers(low, high + 1)), 3)
