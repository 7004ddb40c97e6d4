"""A plate reader."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class PlateReader(Instrument):
    """A plate reader: its drawer carries a plate of 96 wells into the dark.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.463, 0.400, 0.220)
    mass = 12.0
    source = "400 x 450 x 220 mm, drawer of 120 mm, as usual; from memory"
    left_out = "it measures nothing"

    @property
    def drawer(self) -> Slide:
        """Drawer that the plate stands on; it comes out in front."""
        return Slide(f"{self.name}_drawer", 0.150, friction=2.0, effort=10.0)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.drawer, self.power

    @property
    def read(self) -> PushButton:
        green = FINISHES["green"].rgba
        return PushButton(f"{self.name}_read", green, radius=0.010, travel=0.003, proud=0.006)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.read,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """Place of the plate in the drawer."""
        at = (0.0, 0.0, 0.006)
        return (Seat(f"{self.name}_plate", self.drawer.name, at, width=0.084),)

    @property
    def displays(self) -> tuple[Display, ...]:
        out = Scale(self.drawer, 0, 100, "% out", resolution=5)
        return (Display(f"{self.name}_display", (0.110, 0.036), out),)

    def _forms(self) -> list[Form]:
        low, high = 0.050, 0.100
        return [
            Block((-0.225, 0.225), (-0.200, 0.200), (0.012, low), "white", edge=0.006),
            Block((-0.225, 0.225), (-0.200, 0.200), (high, 0.220), "white", edge=0.014),
            Block((-0.225, 0.225), (-0.200, -0.085), (0.030, 0.120), "white", edge=0.006),
            Block((-0.225, 0.225), (0.085, 0.200), (0.030, 0.120), "white", edge=0.006),
            Block((0.060, 0.225), (-0.090, 0.090), (0.030, 0.120), "black"),
            Block((-0.227, -0.215), (-0.185, 0.185), (0.125, 0.205), "anthracite"),
            *feet(0.44, 0.40, 0.014),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.power.add_to(spec, self.name, body, (-0.227, -0.155, 0.165), ON_FRONT)
        self.read.add_to(spec, body, (-0.227, -0.115, 0.165), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.2273, 0.060, 0.165), ON_FRONT)
        drawer = self.drawer.add_to(spec, body, (-0.140, 0.0, 0.052), (-1.0, 0.0, 0.0))
        forms: list[Form] = [
            Block((-0.084, 0.120), (-0.078, 0.078), (0.0, 0.006), "anthracite", 0.001),
            *(
                Block((-0.070, 0.070), (y - 0.004, y + 0.004), (0.005, 0.012), "anthracite", 0.001)
                for y in (-0.050, 0.050)
            ),
            *(
                Block((x - 0.004, x + 0.004), (-0.050, 0.050), (0.005, 0.012), "anthracite", 0.001)
                for x in (-0.070, 0.070)
            ),
            Block((-0.098, -0.086), (-0.083, 0.083), (-0.001, 0.047), "petrol"),
            Block((-0.090, -0.080), (-0.078, 0.078), (0.0, 0.006), "anthracite", 0.001),
        ]
        assemble(spec, drawer, self.name, forms, mass=0.4)
        self.places[0].add_to(drawer)
