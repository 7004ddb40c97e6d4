"""An overhead stirrer on its stand."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned, about
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.magnetic_stirring import Stirring
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP


@dataclass(frozen=True)
class OverheadStirrer(Instrument):
    """An overhead stirrer: its head slides on the stand's rod, its shaft turns a propeller.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.340, 0.222, 0.600)
    mass = 9.0
    source = "head of 90 x 200 x 190 mm, stand of 600 mm, shaft of 270 mm, as usual; from memory"

    @property
    def head(self) -> Slide:
        """The head in its boss, which is pushed up."""
        return Slide(f"{self.name}_head", 0.150, friction=15.0, effort=60.0)

    @property
    def shaft(self) -> Rotor:
        """The shaft with its propeller."""
        return Rotor(f"{self.name}_shaft", friction=0.02, effort=0.2, stall=0.6)

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.034)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.head, self.shaft, self.speed

    @property
    def places(self) -> tuple[Seat, ...]:
        """Place of the vessel, below the propeller."""
        return (Seat(f"{self.name}_base", self.name, (-0.060, 0.0, 0.024), width=0.110),)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 2000, "rpm", resolution=10)

    @property
    def drive(self) -> Drive:
        """What turns it."""
        return Drive(
            f"{self.name}_rpm",
            self.scale,
            ramp=250.0,
            brake=500.0,
            on=(),
            motors=(self.shaft.motor,),
            resolution=10,
        )

    @property
    def stirring(self) -> Stirring:
        """What its propeller does to the liquid around it."""
        return Stirring(f"{self.name}_stirring", self.drive, f"{self.name}_propeller", 0.027)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knob, its drive and what its propeller does."""
        return self.scale, self.drive, self.stirring

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.060, 0.024), self.drive),)

    def _forms(self) -> list[Form]:
        return [
            Block((-0.170, 0.170), (-0.110, -0.080), (0.004, 0.024), "anthracite"),
            Block((-0.170, 0.170), (0.080, 0.110), (0.004, 0.024), "anthracite"),
            Block((0.080, 0.130), (-0.100, 0.100), (0.004, 0.024), "anthracite"),
            Block((-0.125, 0.005), (-0.100, 0.100), (0.018, 0.024), "steel", edge=0.001),
            *feet(0.34, 0.24, 0.004),
            Rod((0.105, 0, 0.020), (0.105, 0, 0.600), 0.016, "chrome"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        up = (0.0, 0.0, 1.0)
        head = self.head.add_to(spec, body, (0.105, 0.0, 0.390), up, balanced=True)
        forms: list[Form] = [
            Block((-0.030, -0.0085), (-0.020, 0.020), (-0.018, 0.018), "steel"),
            Block((-0.010, 0.022), (0.0085, 0.020), (-0.018, 0.018), "steel"),
            Rod((0.0, 0.018, 0.0), (0.0, 0.046, 0.0), 0.008, "chrome"),
            Rod((0.0, 0.042, 0.0), (0.0, 0.050, 0.0), 0.030, "black"),
            Rod((-0.060, 0, 0.0), (-0.028, 0, 0.0), 0.014, "chrome"),
            Block((-0.220, -0.055), (-0.045, 0.045), (-0.050, 0.130), "white", edge=0.012),
            Block((-0.2215, -0.200), (-0.038, 0.038), (-0.020, 0.120), "anthracite"),
            Rod((-0.165, 0, -0.062), (-0.165, 0, -0.048), 0.050, "anthracite"),
        ]
        assemble(spec, head, self.name, forms, mass=2.8)
        self.speed.add_to(spec, self.name, head, (-0.2215, 0.0, 0.015), ON_FRONT)
        self.displays[0].add_to(spec, head, (-0.2218, 0.0, 0.085), ON_FRONT)
        shaft = self.shaft.add_to(spec, head, (-0.165, 0.0, -0.063), (0.0, 0.0, -1.0))
        shaft.add_site(name=f"{self.name}_propeller", pos=(0, 0, -0.262), group=COLLISION_GROUP)
        chuck = ((0.010, -0.034), (0.014, -0.026), (0.018, -0.014), (0.018, 0.0))
        blades: list[Form] = [
            Turned(chuck, "chrome"),
            Rod((0, 0, -0.270), (0, 0, -0.030), 0.008, "steel"),
            Rod((0, 0, -0.272), (0, 0, -0.252), 0.014, "steel"),
        ]
        for n in range(4):
            a = math.pi / 2 * n
            tilt = about((math.cos(a), math.sin(a), 0.0), 40.0)
            x, y = 0.016 * math.cos(a), 0.016 * math.sin(a)
            blades.append(
                Block(
                    (x - 0.011, x + 0.011),
                    (y - 0.011, y + 0.011),
                    (-0.263, -0.261),
                    "steel",
                    0.0005,
                    tilt,
                )
            )
        assemble(spec, shaft, self.name, blades, mass=0.15)
