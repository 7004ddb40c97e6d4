"""A rack for tubes of 16 to 18 mm: two plates with square openings over a floor."""

from dataclasses import dataclass

from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.seat import Seat

_OPENING, _BAR = 0.0188, 0.0072
"""Side of an opening, and width of the bars between two [m]."""
_ROWS, _COLUMNS = 2, 6
_FLOOR, _PLATE, _GUIDE, _TOP = 0.004, 0.003, 0.030, 0.078
"""Thickness of floor and plates; heights of the plates' tops [m]."""


@dataclass(frozen=True)
class TubeRack(Instrument):
    """A rack for centrifuge tubes of 15 ml, test tubes of 16 and 18 mm.

    Attributes:
        name: Name of its body; prefix of all its elements.
    """

    name: str
    size = (0.0592, 0.1632, 0.078)
    mass = 0.12
    source = "60 x 165 x 78 mm with 12 openings, as usual; from memory"
    movable = True
    passive = True

    @property
    def places(self) -> tuple[Seat, ...]:
        """The openings, row after row: where the bottom of a tube stands."""
        pitch = _OPENING + _BAR
        grid = [
            (pitch * (row - (_ROWS - 1) / 2), pitch * (column - (_COLUMNS - 1) / 2))
            for row in range(_ROWS)
            for column in range(_COLUMNS)
        ]
        return tuple(
            Seat(f"{self.name}_opening_{n}", self.name, (x, y, _FLOOR), _OPENING, _TOP - _FLOOR)
            for n, (x, y) in enumerate(grid)
        )

    def _forms(self) -> list[Form]:
        pitch, (deep, wide, _) = _OPENING + _BAR, self.size
        x, y = (-deep / 2, deep / 2), (-wide / 2, wide / 2)
        forms: list[Form] = [Block(x, y, (0.0, _FLOOR), "blue", 0.001)]
        for end in (-1, 1):
            side = sorted((end * wide / 2, end * (wide / 2 - _BAR)))
            forms.append(Block(x, (side[0], side[1]), (_FLOOR, _TOP), "blue", 0.001))
        for top in (_GUIDE, _TOP):
            z = (top - _PLATE, top)
            for n in range(_ROWS + 1):
                low = -deep / 2 + n * pitch
                forms.append(Block((low, low + _BAR), y, z, "blue", 0.0))
            for n in range(1, _COLUMNS):
                low = -wide / 2 + n * pitch
                forms.append(Block(x, (low, low + _BAR), z, "blue", 0.0))
        return forms
