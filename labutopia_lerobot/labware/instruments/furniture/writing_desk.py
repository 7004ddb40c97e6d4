"""A desk to write at."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit, along
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.joinery import Chest
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.top import Top

_X, _Y, _TOP = 0.350, 0.600, 0.740
"""Half sizes and height of its top [m]."""


@dataclass(frozen=True)
class WritingDesk(Fitted):
    """A table with three drawers under its right side.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.700, 1.200, 0.740)
    mass = 38.0
    source = "1200 x 700 x 740 mm (EN 527-1: fixed height 740 mm)"
    passive = True

    def _units(self) -> Sequence[Unit]:
        chest = Chest(f"{self.name}_chest", (0.58, 0.40, 0.715), 3, plinth=0.05, front="wood")
        return (Unit(chest, (0.02, -0.38, 0.0)),)

    @property
    def tops(self) -> tuple[Top, ...]:
        return (Top(_TOP, x=(-_X, _X), y=(-_Y, _Y)),)

    def _places_on_top(self) -> Sequence[Seat]:
        return along(self.name, "top", self.tops[0], count=2)

    def _forms(self) -> list[Form]:
        legs: list[Form] = [
            Block((x, x + 0.04), (0.54, 0.58), (0.0, 0.716), "dark_steel") for x in (-0.32, 0.28)
        ]
        return [
            Block((-_X, _X), (-_Y, _Y), (_TOP - 0.025, _TOP), "wood", edge=0.004),
            Block((0.28, 0.298), (-0.179, 0.56), (0.35, 0.716), "wood", 0.0),
            *legs,
        ]
