"""Description of a kind of laboratory: its size, its needs, where these belong, how it looks."""

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Literal

from labutopia_lerobot.scenes.generation.where import Where

type Range = tuple[float, float]
"""Least and greatest [m]."""


class Importance(IntEnum):
    """Order in which pieces find their places: the highest first."""

    FIRST = 4
    """Pieces that all others are placed to face."""
    VITAL = 3
    """Pieces that the room is for: work places, hoods, benches to work at."""
    MAIN = 2
    """Furniture."""
    USUAL = 1
    """Pieces that stand on and beside it."""
    DETAIL = 0
    """Pieces that the room could do without."""


@dataclass(frozen=True)
class Need:
    """Pieces of one kind.

    Attributes:
        kind: Of the instruments' catalogue, furniture included.
        count: Least and most of them; between them it is drawn, and what of it is more than the
            least is left out where it finds no room.
        where: Where it belongs.
        importance: Those of more come first, and of equal ones the larger.
        near: Kind of which one is at most `within` away.
        within: From middle to middle [m].
    """

    kind: str
    count: tuple[int, int]
    where: Where
    importance: Importance = Importance.USUAL
    near: str | None = None
    within: float = 2.5


@dataclass(frozen=True)
class WareNeed:
    """Ware of one kind that a kind of laboratory works with.

    Attributes:
        kind: Of the catalogue of ware; what does not stand by itself comes in its holder.
        sizes: Those that are drawn from.
        where: Whether it stands on benches or on shelves.
        often: How many times as often as others of the same place.
        closed: Whether its stopper, cap or lid is on.
        contents: Names of substances of which one may be in it, as a still look.
    """

    kind: str
    sizes: tuple[str, ...]
    where: Literal["bench", "shelf"]
    often: int = 1
    closed: bool = False
    contents: tuple[str, ...] = ()


@dataclass(frozen=True)
class Chamber:
    """A room with a door, windows on its north side, and what it needs.

    Attributes:
        name: Prefix of its pieces where there are several rooms.
        width: From west to east.
        depth: From south to north.
        needs: Furniture and instruments that it must have.
        windows: Least and most of them.
        door: Width of its door [m].
    """

    name: str
    width: Range
    depth: Range
    needs: tuple[Need, ...]
    windows: tuple[int, int] = (1, 3)
    door: float = 1.0


@dataclass(frozen=True)
class Corridor:
    """Corridor to several rooms: along their south side, with the entrance at its west end.

    Attributes:
        width: From south to north.
        needs: Furniture and instruments that it must have.
        door: Width of the entrance [m].
    """

    width: Range
    needs: tuple[Need, ...] = ()
    door: float = 1.2


@dataclass(frozen=True)
class Family:
    """A kind of laboratory.

    Attributes:
        name: As in `labutopia-scene generate --family NAME`.
        about: One sentence.
        rooms: From west to east; several need a corridor.
        corridor: What they are entered from; without it the entrance is that of the one room.
        height: Of the ceilings [m].
        floors: Floor finishes to draw from.
        walls: Wall finishes to draw from.
        stock: Ware on its benches and shelves.
    """

    name: str
    about: str
    rooms: tuple[Chamber, ...]
    corridor: Corridor | None = None
    height: float = 3.0
    floors: tuple[str, ...] = field(default=("grey vinyl", "blue vinyl", "beige vinyl"))
    walls: tuple[str, ...] = field(default=("white", "cream", "light grey", "pale blue"))
    stock: tuple[WareNeed, ...] = ()
