"""The bench that a robot works at, of the paper's levels 1 to 4."""

from dataclasses import dataclass

from labutopia_lerobot.labware.parts.fitted import along
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.top import Top

_X, _Y, _TOP, _SLAB = 0.70, 0.90, 0.775, 0.030
"""Half sizes, height and thickness of its top [m]."""


@dataclass(frozen=True)
class WorkBench(Instrument):
    """A deep table on a closed base; a robot stands 0.2 m before its front edge.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (1.400, 1.800, 0.775)
    mass = 120.0
    source = "1400 x 1800 mm, ours; height: original, lab_001: 0.773 to 0.78"
    passive = True

    @property
    def places(self) -> tuple[Seat, ...]:
        """Its top, by number from right to left, before the robot."""
        return along(self.name, "top", Top(_TOP, (-_X, 0.2), (-_Y, _Y)), count=3)

    def _forms(self) -> list[Form]:
        y, low = _Y - 0.04, 0.080
        panels: list[Form] = [
            Block((-_X + 0.074, -_X + 0.084), (a, a + 0.556), (low + 0.01, 0.735), "white", 0.003)
            for a in (-0.854, -0.278, 0.298)
        ]
        return [
            Block((-_X, _X), (-_Y, _Y), (_TOP - _SLAB, _TOP), "anthracite", edge=0.004),
            Block((-_X + 0.082, _X - 0.040), (-y, y), (low, _TOP - _SLAB), "light_grey", 0.0),
            Block((-_X + 0.14, _X - 0.10), (-y + 0.03, y - 0.03), (0.0, low), "anthracite", 0.0),
            *panels,
        ]
