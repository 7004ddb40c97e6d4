"""A double bench that stands free in a room."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit, along
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.joinery import TURNED_BACK, Chest, Cupboard
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.solid import UNTURNED
from labutopia_lerobot.labware.parts.top import Top

_X, _Y, _TOP, _SLAB = 0.750, 1.500, 0.900, 0.030
"""Half sizes, height and thickness of its top [m]."""
_SHELF, _BOARD, _HIGH = 0.160, 0.020, (1.270, 1.600)
"""Half depth, thickness and heights of the reagent shelves [m]."""


@dataclass(frozen=True)
class IslandBench(Fitted):
    """A bench with units on both sides and two reagent shelves along its middle.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (1.500, 3.000, 1.650)
    mass = 380.0
    source = "3000 x 1500 x 900 mm, two benches of EN 13150 back to back, shelves up to 1.6 m; ours"
    passive = True

    def _units(self) -> Sequence[Unit]:
        tall, x = _TOP - _SLAB, _X - 0.040 - 0.26
        units = []
        for side, turn, sign in (("front", UNTURNED, -1), ("back", TURNED_BACK, 1)):
            for number, y in enumerate((-1.0, 1.0)):
                name = f"{self.name}_{side}_cupboard_{number}"
                cupboard = Cupboard(name, (0.52, 0.98, tall), (0.48,))
                units.append(Unit(cupboard, (sign * x, y, 0.0), turn))
            chest = Chest(f"{self.name}_{side}_chest", (0.52, 1.00, tall), count=3)
            units.append(Unit(chest, (sign * x, 0.0, 0.0), turn))
        return units

    @property
    def tops(self) -> tuple[Top, ...]:
        """Before the reagent shelves, and behind them."""
        middle = _SHELF + 0.02
        return (
            Top(_TOP, x=(-_X, -middle), y=(-_Y, _Y)),
            Top(_TOP, x=(middle, _X), y=(-_Y, _Y), behind=True),
        )

    @property
    def boards(self) -> tuple[Top, ...]:
        """The reagent shelves, from below."""
        return tuple(Top(z, x=(-_SHELF, _SHELF), y=(-_Y + 0.05, _Y - 0.05)) for z in _HIGH)

    def _places_on_top(self) -> Sequence[Seat]:
        rows = dict(zip(("front", "back"), self.tops, strict=True))
        rows |= dict(zip(("lower_shelf", "upper_shelf"), self.boards, strict=True))
        return [place for label, top in rows.items() for place in along(self.name, label, top, 4)]

    def _forms(self) -> list[Form]:
        forms: list[Form] = [
            Block((-_X, _X), (-_Y, _Y), (_TOP - _SLAB, _TOP), "anthracite", edge=0.004),
            Block((-0.18, 0.18), (-_Y + 0.01, _Y - 0.01), (0.10, _TOP - _SLAB), "white", 0.0),
            Block((-0.05, 0.05), (-_Y + 0.10, _Y - 0.10), (_TOP, 1.06), "light_grey"),
        ]
        for y in (-_Y + 0.06, 0.0, _Y - 0.06):
            forms.append(Block((-0.025, 0.025), (y - 0.02, y + 0.02), (_TOP, 1.65), "light_grey"))
        for z in _HIGH:
            half = _Y - 0.05
            forms.append(Block((-_SHELF, _SHELF), (-half, half), (z - _BOARD, z), "white"))
            for x in (-_SHELF + 0.006, _SHELF - 0.006):
                rail = (x, -half, z + 0.045), (x, half, z + 0.045)
                forms.append(Rod(*rail, 0.008, "steel", segments=8))
        return forms
