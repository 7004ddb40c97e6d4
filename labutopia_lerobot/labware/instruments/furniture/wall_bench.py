"""A bench along a wall."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.joinery import Chest, Cupboard
from labutopia_lerobot.labware.parts.top import Top

_X, _Y, _TOP, _SLAB = 0.375, 0.750, 0.900, 0.030
"""Half sizes, height and thickness of its top [m]."""


@dataclass(frozen=True)
class WallBench(Fitted):
    """A bench for standing work over a cupboard and a chest of drawers, with sockets at its back.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.750, 1.500, 0.900)
    mass = 110.0
    source = "1500 x 750 x 900 mm, for standing work (EN 13150: depths 600, 750, 900 mm)"
    passive = True

    def _units(self) -> Sequence[Unit]:
        tall = _TOP - _SLAB
        cupboard = Cupboard(f"{self.name}_cupboard", (0.52, 0.90, tall), (0.48,))
        chest = Chest(f"{self.name}_chest", (0.52, 0.60, tall))
        x = -_X + 0.040 + 0.26  # the top stands over the grips
        return Unit(cupboard, (x, 0.30, 0.0)), Unit(chest, (x, -0.45, 0.0))

    @property
    def tops(self) -> tuple[Top, ...]:
        return (Top(_TOP, x=(-_X, _X), y=(-_Y, _Y)),)

    def _forms(self) -> list[Form]:
        return [
            Block((-_X, _X), (-_Y, _Y), (_TOP - _SLAB, _TOP), "anthracite", edge=0.004),
            Block((_X - 0.03, _X - 0.01), (-_Y + 0.01, _Y - 0.01), (0.10, 0.869), "white", 0.0),
        ]
