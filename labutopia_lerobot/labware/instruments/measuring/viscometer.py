"""A rotational viscometer on its stand."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process


@dataclass(frozen=True)
class Viscometer(Instrument):
    """A viscometer: its head is lowered until the spindle hangs in the beaker and turns.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.300, 0.200, 0.500)
    mass = 6.5
    source = "200 x 290 x 500 mm, spindle of 19 mm, as usual; from memory"
    left_out = "it turns and measures nothing"

    @property
    def head(self) -> Slide:
        """The head on its rack, which is pushed down."""
        return Slide(f"{self.name}_head", 0.110, friction=10.0, effort=40.0)

    @property
    def spindle(self) -> Rotor:
        return Rotor(f"{self.name}_spindle", friction=0.002, effort=0.02, stall=0.05)

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.034)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.head, self.spindle, self.speed

    @property
    def places(self) -> tuple[Seat, ...]:
        """Place of the beaker, below the spindle."""
        return (Seat(f"{self.name}_base", self.name, (-0.070, 0.0, 0.026), width=0.110),)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 200, "rpm")

    @property
    def drive(self) -> Drive:
        """What turns it."""
        return Drive(
            f"{self.name}_rpm",
            self.scale,
            ramp=100.0,
            brake=200.0,
            on=(),
            motors=(self.spindle.motor,),
            resolution=1,
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knob and its drive."""
        return self.scale, self.drive

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.080, 0.032), self.drive),)

    def _forms(self) -> list[Form]:
        return [
            Block((-0.145, 0.145), (-0.100, 0.100), (0.006, 0.026), "anthracite", edge=0.006),
            *feet(0.28, 0.20, 0.006),
            Rod((0.085, 0, 0.020), (0.085, 0, 0.470), 0.022, "chrome"),
            Rod((0.085, 0, 0.024), (0.085, 0, 0.040), 0.044, "anthracite"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        down = (0.0, 0.0, -1.0)
        head = self.head.add_to(spec, body, (0.085, 0.0, 0.360), down, balanced=True)
        forms: list[Form] = [
            Block((-0.040, -0.0115), (-0.024, 0.024), (-0.030, 0.030), "anthracite"),
            Block((-0.014, 0.024), (0.0115, 0.024), (-0.030, 0.030), "anthracite"),
            Rod((0.0, 0.022, 0.0), (0.0, 0.046, 0.0), 0.008, "chrome"),
            Rod((0.0, 0.042, 0.0), (0.0, 0.052, 0.0), 0.034, "black"),
            Block((-0.220, -0.036), (-0.065, 0.065), (-0.050, 0.140), "white", edge=0.014),
            Block((-0.2215, -0.210), (-0.058, 0.058), (-0.030, 0.125), "petrol"),
            Rod((-0.155, 0, -0.064), (-0.155, 0, -0.048), 0.040, "anthracite"),
        ]
        assemble(spec, head, self.name, forms, mass=2.0)
        self.speed.add_to(spec, self.name, head, (-0.2215, 0.0, 0.010), ON_FRONT)
        self.displays[0].add_to(spec, head, (-0.2218, 0.0, 0.080), ON_FRONT)
        spindle = self.spindle.add_to(spec, head, (-0.155, 0.0, -0.065), down, balanced=True)
        rod: list[Form] = [
            Rod((0, 0, -0.020), (0, 0, 0.0), 0.010, "chrome"),
            Rod((0, 0, -0.090), (0, 0, -0.018), 0.004, "chrome"),
            Rod((0, 0, -0.150), (0, 0, -0.088), 0.019, "steel"),
        ]
        assemble(spec, spindle, self.name, rod, mass=0.05)
