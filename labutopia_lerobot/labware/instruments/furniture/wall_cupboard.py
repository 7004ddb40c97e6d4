"""A cupboard on a wall."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.joinery import Cupboard


@dataclass(frozen=True)
class WallCupboard(Fitted):
    """A cupboard with two glass doors and a shelf, hung with its base at 1.5 m.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.384, 0.900, 0.700)
    mass = 30.0
    source = "900 x 350 x 700 mm without its grips, as usual over benches; from memory"
    passive = True

    def _units(self) -> Sequence[Unit]:
        cupboard = Cupboard(
            f"{self.name}_box", (0.345, 0.90, 0.70), (0.36,), plinth=0.0, grip=0.25, glazed=True
        )
        return (Unit(cupboard, (0.0145, 0.0, 0.0)),)

    def _forms(self) -> list[Form]:
        return [Block((0.185, 0.192), (-0.40, 0.40), (0.58, 0.66), "dark_steel", 0.0)]
