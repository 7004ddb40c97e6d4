"""A vortex mixer: a rubber cup that is driven round a small circle."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.crank import Crank
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.guard import Flipped
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.magnetic_stirring import Stirring
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP

_ORBIT = 0.0025
"""From the axis of the motor to that of the cup [m]: an orbit of 5 mm."""
_IN_TUBE = 0.025
"""Height above the cup's origin that is in a tube that stands in it [m]; ours."""
_LEAN = 20.0
"""Angle by which the front leans back [deg]."""


@dataclass(frozen=True)
class VortexMixer(Instrument):
    """A vortex mixer with a speed knob and a switch.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.160, 0.127, 0.165)
    mass = 4.0
    source = "127 x 160 x 165 mm, 4 kg, cast zinc, usual with a 5 mm orbit; from memory"

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.032)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power")

    @property
    def crank(self) -> Crank:
        """The eccentric that takes the cup round; the cup itself does not turn."""
        rotor = Rotor(f"{self.name}_eccentric", friction=0.02, effort=0.1, stall=0.4)
        return Crank(rotor, f"{self.name}_cup", _ORBIT)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.speed, self.power, self.crank.rotor

    @property
    def cup(self) -> Seat:
        """Where the end of a tube is pressed in."""
        at = (0.0, 0.0, 0.010)
        return Seat(f"{self.name}_cup_middle", self.crank.platform, at, width=0.034, depth=0.012)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.cup,)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 3000, "rpm", resolution=10)

    @property
    def drive(self) -> Drive:
        """What takes the cup round."""
        on, motors = (self.power.name,), (self.crank.rotor.motor,)
        return Drive(f"{self.name}_rpm", self.scale, 3000.0, 3000.0, on, motors, resolution=10)

    @property
    def stirring(self) -> Stirring:
        """What its cup does to the liquid in the tube that stands in it."""
        return Stirring(f"{self.name}_stirring", self.drive, f"{self.name}_tube", 0.006)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, its knob, its drive and what its cup does."""
        return Flipped(self.power), self.scale, self.drive, self.stirring

    def _forms(self) -> list[Form]:
        side = ((-0.080, 0.008), (0.080, 0.008), (0.070, 0.128), (-0.037, 0.128))
        return [
            Prism(side, (-0.0635, 0.0635), "light_blue", edge=0.010),
            Block((-0.078, 0.078), (-0.062, 0.062), (0.006, 0.022), "anthracite", edge=0.006),
            Rod((0.017, 0, 0.124), (0.017, 0, 0.134), 0.070, "anthracite"),
            *feet(0.160, 0.127, 0.008),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        front = (-0.0593, 0.0, 0.066)
        self.speed.add_to(spec, self.name, body, (front[0], -0.030, front[2]), leaning(_LEAN))
        self.power.add_to(spec, self.name, body, (front[0], 0.032, front[2]), leaning(_LEAN))
        cup = self.crank.add_to(spec, self.name, body, (0.017, 0.0, 0.1345), 0.0015)
        forms: list[Form] = [
            Turned(((0, 0), (0.014, 0), (0.022, 0.010), (0, 0.010)), "rubber"),
            Ring(0.036, 0.046, (0.010, 0.026), "rubber"),
            Turned(
                ((0.018, 0.024), (0.023, 0.024), (0.026, 0.030), (0.018, 0.024)),
                "rubber",
                touch=False,
            ),
        ]
        assemble(spec, cup, self.name, forms, mass=0.08)
        cup.add_site(name=f"{self.name}_tube", pos=(0, 0, _IN_TUBE), group=COLLISION_GROUP)
        self.cup.add_to(cup)
