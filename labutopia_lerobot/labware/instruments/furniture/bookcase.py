"""A bookcase with books and folders."""

from dataclasses import dataclass
from itertools import cycle

from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.joinery import BOARD, carcass
from labutopia_lerobot.labware.parts.seat import Seat

_Y, _HEIGHT = 0.450, 1.850
_SHELVES = (0.430, 0.790, 1.150, 1.510)
"""Heights of the tops of the boards over its floor [m]."""


@dataclass(frozen=True)
class Bookcase(Instrument):
    """A case of boards, open in front, its shelves half full of books and folders.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.300, 0.900, 1.850)
    mass = 60.0
    source = "900 x 300 x 1850 mm, five levels for folders of A4, as usual; from memory"
    passive = True

    @property
    def places(self) -> tuple[Seat, ...]:
        """The free ends of its shelves, from below."""
        return tuple(
            Seat(f"{self.name}_shelf_{n}", self.name, (0.0, -0.28, z), width=0.20)
            for n, z in enumerate((0.06 + BOARD, *_SHELVES))
        )

    def _forms(self) -> list[Form]:
        y = _Y - BOARD
        boards: list[Form] = [
            Block((-0.140, 0.144), (-y, y), (z - BOARD, z), "wood", 0.0) for z in _SHELVES
        ]
        case = carcass((-0.150, 0.150), 0.900, _HEIGHT, 0.06, "wood")
        return [*case, *boards, *self._books()]

    def _books(self) -> list[Form]:
        """Return what stands on the shelves, from their left ends."""
        looks = cycle(("blue", "grey", "red", "light_grey", "green", "black", "cream", "petrol"))
        widths = cycle((0.075, 0.075, 0.03, 0.045, 0.05, 0.025, 0.075))
        tall = cycle((0.30, 0.30, 0.24, 0.26, 0.22, 0.30, 0.21, 0.28, 0.30))
        books: list[Form] = []
        for number, z in enumerate((0.06 + BOARD, *_SHELVES)):
            y, end = _Y - BOARD - 0.004, (-0.05, 0.05, -0.12, 0.10, 0.0)[number]
            while y > end:
                width, high = next(widths), next(tall)
                x = (-0.10, 0.135)
                books.append(Block(x, (y - width + 0.001, y), (z, z + high), next(looks), 0.0))
                y -= width
        return books
