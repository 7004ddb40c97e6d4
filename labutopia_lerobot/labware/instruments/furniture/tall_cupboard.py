"""A cupboard from the floor to above one's head."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit
from labutopia_lerobot.labware.parts.form import Form
from labutopia_lerobot.labware.parts.joinery import Cupboard


@dataclass(frozen=True)
class TallCupboard(Fitted):
    """A cupboard for chemicals and glassware: glass doors over closed ones.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.500, 0.900, 1.920)
    mass = 90.0
    source = "900 x 500 x 1920 mm (EN 14727 storage units are alike); from memory"
    passive = True

    def _units(self) -> Sequence[Unit]:
        deep = 0.466
        lower = Cupboard(f"{self.name}_lower", (deep, 0.90, 0.85), (0.47,), grip=0.85)
        upper = Cupboard(
            f"{self.name}_upper",
            (deep, 0.90, 1.07),
            (0.37, 0.72),
            plinth=0.0,
            grip=0.15,
            glazed=True,
        )
        return Unit(lower, (0.017, 0.0, 0.0)), Unit(upper, (0.017, 0.0, 0.85))

    def _forms(self) -> list[Form]:
        return []
