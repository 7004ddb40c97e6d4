"""The desk before a blackboard, at which experiments are shown."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import Fitted, Unit, along
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.joinery import Chest, Cupboard
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.top import Top

_X, _Y, _TOP, _SLAB = 0.375, 1.050, 0.900, 0.030
"""Half sizes, height and thickness of its top [m]."""


@dataclass(frozen=True)
class TeacherDesk(Fitted):
    """A demonstration desk: the class sees its closed back, the teacher has cupboard and drawers.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.750, 2.100, 0.900)
    mass = 140.0
    source = "2100 x 750 x 900 mm, a demonstration desk of schools, as usual; from memory"
    passive = True

    def _units(self) -> Sequence[Unit]:
        tall, x = _TOP - _SLAB, -_X + 0.040 + 0.26
        cupboard = Cupboard(f"{self.name}_cupboard", (0.52, 0.80, tall), (0.48,), front="petrol")
        chest = Chest(f"{self.name}_chest", (0.52, 0.60, tall), front="petrol")
        return Unit(cupboard, (x, 0.63, 0.0)), Unit(chest, (x, -0.73, 0.0))

    @property
    def tops(self) -> tuple[Top, ...]:
        return (Top(_TOP, x=(-_X, _X), y=(-_Y, _Y)),)

    def _places_on_top(self) -> Sequence[Seat]:
        return along(self.name, "top", self.tops[0], count=4)

    def _forms(self) -> list[Form]:
        return [
            Block((-_X, _X), (-_Y, _Y), (_TOP - _SLAB, _TOP), "ceramic", edge=0.004),
            Block((0.20, 0.222), (-_Y + 0.02, _Y - 0.02), (0.02, 0.871), "wood"),
        ]
