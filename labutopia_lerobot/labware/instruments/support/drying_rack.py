"""A drying rack for the wall over a sink."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.fittings import tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class DryingRack(Instrument):
    """A drying rack: glassware hangs on its pegs, and drips into a tray that is drawn out.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.123, 0.600, 0.700)
    mass = 4.5
    source = "600 x 110 x 700 mm, 48 pegs of 95 mm, as usual; from memory"
    passive = True

    @property
    def tray(self) -> Slide:
        """The drip tray, which is drawn out in front."""
        return Slide(f"{self.name}_tray", 0.080, friction=1.0, effort=6.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.tray,)

    def _forms(self) -> list[Form]:
        front = 0.035
        pegs: list[Form] = []
        for row in range(6):
            for column in range(8):
                y, z = 0.2625 - 0.075 * column, 0.150 + 0.092 * row
                tip = (front - 0.082, y, z + 0.048)
                pegs += [Rod((front + 0.002, y, z), tip, 0.010, "anthracite", segments=10)]
        return [
            Block((front, 0.055), (-0.300, 0.300), (0.070, 0.700), "light_grey", edge=0.006),
            Block((front - 0.010, 0.055), (-0.300, -0.288), (0.0, 0.700), "white"),
            Block((front - 0.010, 0.055), (0.288, 0.300), (0.0, 0.700), "white"),
            Block((-0.055, 0.055), (-0.300, 0.300), (0.0, 0.010), "white"),
            *pegs,
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        tray = self.tray.add_to(spec, body, (0.0, 0.0, 0.011), (-1.0, 0.0, 0.0))
        forms: list[Form] = [
            *tub((-0.058, 0.050), (-0.284, 0.284), (0.0, 0.045), 0.003, "steel"),
            Block((-0.068, -0.056), (-0.060, 0.060), (0.030, 0.040), "anthracite"),
        ]
        assemble(spec, tray, self.name, forms, mass=0.6)
