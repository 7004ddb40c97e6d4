"""An orbital shaker: a platform with a rubber mat that goes round a circle."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.crank import Crank
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.processes import Process

_ORBIT = 0.020
"""Diameter of the circle [m]."""
_SLOPE = 50.0


@dataclass(frozen=True)
class OrbitalShaker(Instrument):
    """A shaker whose crank takes its platform round a circle; two bars hold flasks on its mat.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.420, 0.360, 0.150)
    mass = 13.0
    source = "360 x 420 x 150 mm, orbit of 20 mm, usual for 7.5 kg of load; from memory"

    @property
    def crank(self) -> Crank:
        """What carries the platform round; the platform itself does not turn."""
        rotor = Rotor(f"{self.name}_crank", friction=0.1, effort=0.5, stall=3.0)
        return Crank(rotor, f"{self.name}_platform", _ORBIT / 2)

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.036)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.speed, self.crank.rotor

    @property
    def mat(self) -> Seat:
        """The middle of the mat."""
        at = (0.0, 0.0, 0.018)
        return Seat(f"{self.name}_mat", self.crank.platform, at, width=0.140)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.mat,)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 300, "rpm", resolution=5)

    @property
    def drive(self) -> Drive:
        """What turns it."""
        return Drive(
            f"{self.name}_rpm",
            self.scale,
            ramp=30.0,
            brake=60.0,
            on=(),
            motors=(self.crank.rotor.motor,),
            resolution=5,
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knob and its drive."""
        return self.scale, self.drive

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.080, 0.026), self.drive),)

    def _forms(self) -> list[Form]:
        side = ((-0.210, 0.012), (0.210, 0.012), (0.210, 0.092), (-0.150, 0.092), (-0.210, 0.040))
        return [
            Prism(side, (-0.180, 0.180), "white", edge=0.006),
            Block((-0.208, 0.208), (-0.178, 0.178), (0.010, 0.026), "petrol", edge=0.004),
            *feet(0.420, 0.360, 0.012),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(49.1)
        self.speed.add_to(spec, self.name, body, (-0.182, -0.090, 0.0643), lean)
        self.displays[0].add_to(spec, body, (-0.1822, 0.050, 0.0648), lean)
        platform = self.crank.add_to(spec, self.name, body, (0.030, 0.0, 0.093), 0.023)
        rails: list[Form] = [
            Block((x - 0.006, x + 0.006), (-0.158, 0.158), (0.016, 0.034), "steel")
            for x in (-0.128, 0.128)
        ]
        forms: list[Form] = [
            Block((-0.165, 0.165), (-0.165, 0.165), (0.000, 0.014), "steel", edge=0.004),
            Block((-0.118, 0.118), (-0.155, 0.155), (0.013, 0.018), "rubber", edge=0.001),
            *rails,
        ]
        assemble(spec, platform, self.name, forms, mass=2.0)
        self.mat.add_to(platform)
