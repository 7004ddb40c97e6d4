"""A low cabinet under a bench or beside it."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit, along
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.joinery import Cupboard
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.top import Top

_TOP, _SLAB = 0.900, 0.030
"""Height and thickness of its top [m]."""


@dataclass(frozen=True)
class BaseCabinet(Fitted):
    """A cabinet with two doors, a shelf and a top of its own.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.600, 0.900, 0.900)
    mass = 55.0
    source = "900 x 600 x 900 mm (EN 14727 storage units are alike); from memory"
    passive = True

    def _units(self) -> Sequence[Unit]:
        size = (0.55, 0.90, _TOP - _SLAB)
        return (Unit(Cupboard(f"{self.name}_cupboard", size, (0.48,)), (0.015, 0.0, 0.0)),)

    @property
    def tops(self) -> tuple[Top, ...]:
        return (Top(_TOP, x=(-0.300, 0.300), y=(-0.450, 0.450)),)

    def _places_on_top(self) -> Sequence[Seat]:
        return along(self.name, "top", self.tops[0], count=2)

    def _forms(self) -> list[Form]:
        return [Block((-0.300, 0.300), (-0.450, 0.450), (_TOP - _SLAB, _TOP), "anthracite")]
