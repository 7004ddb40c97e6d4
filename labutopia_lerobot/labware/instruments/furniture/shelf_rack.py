"""An open rack of shelves."""

from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import along
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.top import Top

_X, _Y, _HEIGHT = 0.250, 0.500, 2.000
_LEVELS = (0.120, 0.560, 1.000, 1.440, 1.880)
"""Heights of the shelves [m]."""


@dataclass(frozen=True)
class ShelfRack(Instrument):
    """A rack of steel posts with five shelves, open on all sides.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.500, 1.000, 2.000)
    mass = 32.0
    source = "1000 x 500 x 2000 mm, five shelves, a usual boltless rack; from memory"
    passive = True

    @property
    def tops(self) -> tuple[Top, ...]:
        """Its shelves from below, between the posts."""
        inside = _X - 0.04, _Y - 0.04
        x, y = ((-half, half) for half in inside)
        return tuple(Top(z, x, y) for z in _LEVELS)

    @property
    def boards(self) -> tuple[Top, ...]:
        return self.tops

    @property
    def places(self) -> tuple[Seat, ...]:
        """Its shelves from below, each by number from right to left."""
        return tuple(
            place
            for number, top in enumerate(self.tops)
            for place in along(self.name, f"shelf_{number}", top, count=2)
        )

    def _forms(self) -> list[Form]:
        posts: list[Form] = [
            Block((x, x + 0.035), (y, y + 0.035), (0.0, _HEIGHT), "blue", 0.0)
            for x in (-_X, _X - 0.035)
            for y in (-_Y, _Y - 0.035)
        ]
        shelves: list[Form] = [
            Block((-_X + 0.01, _X - 0.01), (-_Y + 0.01, _Y - 0.01), (z - 0.035, z), "light_grey")
            for z in _LEVELS
        ]
        braces: list[Form] = [
            Block((_X - 0.02, _X - 0.012), (-_Y, _Y), (z, z + 0.05), "blue", 0.0)
            for z in (0.30, 1.70)
        ]
        return [*posts, *shelves, *braces]
