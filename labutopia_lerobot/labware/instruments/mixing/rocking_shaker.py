"""A rocking shaker for trays and gels."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Rocking
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod, about
from labutopia_lerobot.labware.parts.guard import Flipped
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.processes import Process

_SWING = math.radians(20.0)
"""How far the platform goes from end to end [rad]."""


@dataclass(frozen=True)
class RockingShaker(Instrument):
    """A rocking shaker: its platform see-saws about the middle, by ten degrees to either side.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.303, 0.280, 0.179)
    mass = 4.2
    source = "300 x 300 x 160 mm, platform of 280 x 280 mm, as usual; from memory"

    @property
    def platform(self) -> Rotor:
        """The platform, from one end of its way to the other."""
        rocking = f"{self.name}_platform"
        return Rotor(rocking, friction=0.05, effort=2.0, widest=_SWING, stall=4.0)

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.032)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.platform, self.speed, self.power

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 60, "rpm")

    @property
    def drive(self) -> Rocking:
        """Its crank: the platform goes to and fro once per turn."""
        on, motors = (self.power.name,), (self.platform.motor,)
        return Rocking(f"{self.name}_rpm", self.scale, 20.0, 60.0, on, motors, range=_SWING)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, its knob and its drive."""
        return Flipped(self.power), self.scale, self.drive

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.070, 0.026), self.drive),)

    def _forms(self) -> list[Form]:
        return [
            Block((-0.150, 0.130), (-0.130, 0.130), (0.010, 0.075), "white", edge=0.012),
            *feet(0.28, 0.26, 0.012),
            Block((-0.1515, -0.140), (-0.115, 0.115), (0.020, 0.066), "petrol"),
            *(
                Prism(
                    ((-0.040, 0.070), (0.020, 0.070), (0.000, 0.122), (-0.020, 0.122)),
                    (min(s * 0.085, s * 0.097), max(s * 0.085, s * 0.097)),
                    "anthracite",
                )
                for s in (-1, 1)
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.speed.add_to(spec, self.name, body, (-0.1515, -0.080, 0.043), ON_FRONT)
        self.power.add_to(spec, self.name, body, (-0.1515, -0.040, 0.043), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.1518, 0.050, 0.043), ON_FRONT)
        axis = (0.0, 1.0, 0.0)
        platform = self.platform.add_to(spec, body, (-0.010, 0.0, 0.112), axis, balanced=True)
        lean = about((0.0, 1.0, 0.0), -10.0)
        s, c = math.sin(math.radians(10.0)), math.cos(math.radians(10.0))

        def tilted(
            x: float, y: tuple[float, float], z: tuple[float, float], half: float, look: str
        ) -> Block:
            mid, tall = (z[0] + z[1]) / 2, (z[1] - z[0]) / 2
            i, k = x * c - mid * s, x * s + mid * c
            return Block((i - half, i + half), y, (k - tall, k + tall), look, 0.002, lean)

        forms: list[Form] = [
            tilted(0.0, (-0.140, 0.140), (0.022, 0.028), 0.140, "steel"),
            tilted(0.0, (-0.132, 0.132), (0.027, 0.031), 0.132, "rubber"),
            *(tilted(x, (-0.140, 0.140), (0.024, 0.044), 0.003, "steel") for x in (-0.137, 0.137)),
            Rod((0, -0.115, 0), (0, 0.115, 0), 0.012, "chrome"),
            Block((-0.010, 0.010), (-0.076, 0.076), (0.0, 0.024), "anthracite"),
        ]
        assemble(spec, platform, self.name, forms, mass=0.9)
