"""The plan of a furnished room: walls, openings, pieces, work places. Nothing is built here.

Room frame: origin in the south-west corner on the floor, x east, y north, z up. A heading is the
way that a front faces, in degrees counterclockwise from east.
"""

from dataclasses import dataclass
from typing import Literal

Heading = Literal[0, 90, 180, 270]
"""East, north, west, south [deg]."""

WALL_THICKNESS = 0.12
"""Thickness of a wall inside a room [m]: plasterboard of two layers on 75 mm studs is
125 mm (DIN 18183)."""


@dataclass(frozen=True)
class Wall:
    """A wall inside a room, such as a corridor's; the four around it need not be said.

    Attributes:
        start: One end of its middle line [m], room frame.
        end: The other, due east, north, west or south of it [m], room frame.
    """

    start: tuple[float, float]
    end: tuple[float, float]


@dataclass(frozen=True)
class Opening:
    """A door or a window.

    Attributes:
        kind: `door` or `window`.
        x: Of its middle, on a wall [m], room frame.
        y: Of its middle, on a wall [m], room frame.
        heading: Into which room a door opens, or which way a window lets the light in.
        width: [m].
        height: Of the opening itself [m].
        sill: Height of its lower edge above the floor [m].
    """

    kind: Literal["door", "window"]
    x: float
    y: float
    heading: Heading
    width: float
    height: float
    sill: float = 0.0


@dataclass(frozen=True)
class Placed:
    """An instrument or a piece of furniture, and where it stands.

    Attributes:
        kind: Of the instruments' catalogue, furniture included.
        name: Its own in this room.
        x: Of the centre of its base [m], room frame.
        y: The same [m].
        heading: The way its front faces.
        on: Name of the piece that it stands on; None if on the floor or at a wall.
        height: Of its base above the floor [m].
    """

    kind: str
    name: str
    x: float
    y: float
    heading: Heading
    on: str | None = None
    height: float = 0.0


@dataclass(frozen=True)
class PlacedWare:
    """A piece of ware, and where it stands; labels face as the front of what it stands on.

    Attributes:
        kind: Of the catalogue of ware.
        size: Of that kind, such as `250 ml`.
        name: Its own in this room.
        x: Of the centre of its base [m], room frame.
        y: The same [m].
        height: Of its base above the floor [m].
        on: Name of the piece that it stands on or in.
        closed: Whether its stopper, cap or lid is on.
        contents: Name of the substance that is in it, as a still look; empty if none.
        level: Height of that, as a share of the height of the vessel.
    """

    kind: str
    size: str
    name: str
    x: float
    y: float
    height: float
    on: str
    closed: bool = False
    contents: str = ""
    level: float = 0.0


@dataclass(frozen=True)
class WorkPlace:
    """Place of a robot before a bench, as in the tasks of levels 1 to 4.

    Attributes:
        name: Its own in this room.
        bench: Name of the work bench.
        x: Of the robot's base [m], room frame.
        y: The same [m].
        heading: The way it faces: to the bench.
    """

    name: str
    bench: str
    x: float
    y: float
    heading: Heading


@dataclass(frozen=True)
class Plan:
    """A furnished room.

    Attributes:
        name: Such as `organic_7`.
        family: Which kind of laboratory it is.
        seed: That it was drawn from.
        size: Width (x), depth (y) and height [m], between the walls.
        walls: Inside it.
        openings: Doors and windows, the entrance first.
        pieces: What stands in it, what carries others before what it carries.
        work_places: Where a robot can work; may be none.
        floor: One of the floor finishes.
        wall: One of the wall finishes.
        ware: Glass and what else stands on benches and shelves and in racks.
    """

    name: str
    family: str
    seed: int
    size: tuple[float, float, float]
    walls: tuple[Wall, ...]
    openings: tuple[Opening, ...]
    pieces: tuple[Placed, ...]
    work_places: tuple[WorkPlace, ...]
    floor: str
    wall: str
    ware: tuple[PlacedWare, ...] = ()
