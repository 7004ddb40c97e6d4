"""A vortex mixer: a rubber cup that is driven round a small circle, while a tube is pressed in."""

from dataclasses import dataclass, replace

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.crank import Crank
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.drive import Drive
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Bowl, Form, Prism, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.magnetic_stirring import Stirring
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.touch_switch import SprungCup, TouchSwitch
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP

_ORBIT = 0.0025
"""From the axis of the motor to that of the cup [m]: an orbit of 5 mm."""
_IN_TUBE = 0.025
"""Height above the cup's origin that is in a tube that stands in it [m]; ours."""
_RUBBER = (1.0, 0.005, 0.0001)
"""Friction of the cup: rubber on dry glass holds it about as well as its weight; ours."""
_LEAN = 20.0
"""Angle by which the front leans back [deg]."""
_HIGHEST = 3000.0
"""Its highest speed [rpm]."""


@dataclass(frozen=True)
class VortexMixer(Instrument):
    """A vortex mixer with a speed knob, and a switch: touch, or on.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        set_to: What its knob is set to when an episode begins [rpm].
    """

    name: str
    set_to: float = 0.0
    size = (0.160, 0.127, 0.165)
    mass = 4.0
    source = "127 x 160 x 165 mm, 4 kg, cast zinc, usual with a 5 mm orbit; from memory"

    @property
    def speed(self) -> Knob:
        knob = Knob(f"{self.name}_speed", diameter=0.032)
        return replace(knob, begins=self.set_to / _HIGHEST * knob.widest)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power")

    @property
    def crank(self) -> Crank:
        """The eccentric that takes the cup round; the cup itself does not turn."""
        rotor = Rotor(f"{self.name}_eccentric", friction=0.02, effort=0.1, stall=0.4)
        return Crank(rotor, f"{self.name}_carrier", _ORBIT)

    @property
    def sprung_cup(self) -> SprungCup:
        """The cup, which gives when something is pressed in."""
        return SprungCup(f"{self.name}_cup")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.speed, self.power, self.crank.rotor, self.sprung_cup

    @property
    def cup(self) -> Seat:
        """Where the end of a tube is pressed in: flat below, and wider above."""
        at = (0.0, 0.0, 0.010)
        return Seat(f"{self.name}_cup_middle", self.sprung_cup.name, at, width=0.028, depth=0.012)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.cup,)

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, _HIGHEST, "rpm", resolution=10)

    @property
    def touch(self) -> TouchSwitch:
        """What runs it: its switch, or the cup."""
        return TouchSwitch(f"{self.name}_runs", self.sprung_cup, self.power)

    @property
    def drive(self) -> Drive:
        """What takes the cup round."""
        on, motors = (self.touch.name,), (self.crank.rotor.motor,)
        return Drive(f"{self.name}_rpm", self.scale, 3000.0, 3000.0, on, motors, resolution=10)

    @property
    def stirring(self) -> Stirring:
        """What its cup does to the liquid in the tube that stands in it."""
        return Stirring(f"{self.name}_stirring", self.drive, f"{self.name}_tube", 0.006)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, its knob, its drive and what its cup does."""
        return self.touch, self.scale, self.drive, self.stirring

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
        carrier = self.crank.add_to(spec, self.name, body, (0.017, 0.0, 0.1345), 0.0015)
        assemble(spec, carrier, self.name, [Rod((0, 0, -0.001), (0, 0, 0.0), 0.020, "steel")], 0.02)
        cup = self.sprung_cup.add_to(carrier, (0.0, 0.0, 0.0035))
        spec.add_exclude(bodyname1=body.name, bodyname2=cup.name)
        spec.add_exclude(bodyname1=carrier.name, bodyname2=cup.name)
        forms: list[Form] = [
            Turned(((0, 0), (0.014, 0), (0.022, 0.010), (0, 0.010)), "rubber"),
            Bowl(0.028, 0.036, 0.046, (0.010, 0.026), "rubber"),
            Turned(
                ((0.018, 0.024), (0.023, 0.024), (0.026, 0.030), (0.018, 0.024)),
                "rubber",
                touch=False,
            ),
        ]
        assemble(spec, cup, self.name, forms, mass=0.08)
        for geom in cup.geoms:
            geom.friction = _RUBBER
        cup.add_site(name=f"{self.name}_tube", pos=(0, 0, _IN_TUBE), group=COLLISION_GROUP)
        self.cup.add_to(cup)
