"""A top-pan balance."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.pan import Pan
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.weighing import Weighing

_SLOPE = 68.0
"""How far the console leans back [deg]."""
_PAN = (0.060, 0.0, 0.087)
"""Origin of the pan [m]."""


@dataclass(frozen=True)
class PrecisionBalance(Instrument):
    """A top-pan balance: it shows the mass on its pan to 0.01 g, up to 4.2 kg.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        tared: Least and most that was tared before the episode [g].
    """

    name: str
    tared: tuple[float, float] = (0.0, 0.0)
    size = (0.320, 0.200, 0.095)
    mass = 4.5
    source = "200 x 320 x 95 mm, pan of 180 mm, usual for 4.2 kg x 0.01 g; from memory"

    @property
    def pan(self) -> Pan:
        return Pan(f"{self.name}_pan", width=0.170, top=0.008)

    @property
    def pan_top(self) -> tuple[float, float, float]:
        """Middle of the pan's top in the frame of the balance [m]."""
        x, y, z = _PAN
        return x, y, z + self.pan.top

    @property
    def tare(self) -> PushButton:
        """Button that sets the display to zero."""
        blue = (0.15, 0.35, 0.65, 1.0)
        return PushButton(f"{self.name}_tare", blue, radius=0.012, travel=0.003, proud=0.012)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.tare,)

    @property
    def weighing(self) -> Weighing:
        """The mass on its pan."""
        name, tare = f"{self.name}_reading", self.tare.name
        return self.pan.weighing(name, 0.01, 4200.0, tare, tared=self.tared)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.pan.place,)

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.100, 0.030), self.weighing),)

    def _forms(self) -> list[Form]:
        side = ((-0.160, 0.012), (0.160, 0.012), (0.160, 0.074), (-0.050, 0.074), (-0.160, 0.030))
        return [
            Prism(side, (-0.100, 0.100), "white", edge=0.006),
            Block((-0.157, 0.157), (-0.097, 0.097), (0.008, 0.018), "anthracite"),
            Block((-0.035, 0.155), (-0.094, 0.094), (0.070, 0.078), "light_grey"),
            *feet(0.320, 0.200, 0.010),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        plate: list[Form] = [
            Block((-0.090, 0.090), (-0.090, 0.090), (0.002, 0.008), "steel", edge=0.003),
            Rod((0, 0, -0.008), (0, 0, 0.004), 0.030, "anthracite"),
        ]
        self.pan.add_to(spec, self.name, body, _PAN, plate)
        self.displays[0].add_to(spec, body, (-0.108, 0.020, 0.0522), leaning(_SLOPE))
        self.tare.add_to(spec, body, (-0.108, -0.060, 0.0515), leaning(_SLOPE))
