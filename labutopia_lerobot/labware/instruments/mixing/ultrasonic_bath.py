"""An ultrasonic cleaning bath with a lid, a basket and a timer."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet, tub
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.timer import Countdown
from labutopia_lerobot.labware.parts.warmth import Regulated, bath
from labutopia_lerobot.processes import EnergyRegulator, Process

_WATER = (-0.079, -0.139, 0.110), (0.079, 0.139, 0.190)
"""Corners of its water [m]."""
_WATT, _SOUND, _LEAK = 200.0, 80.0, 0.8
"""Power of its heater, and that of its sound, all of which ends as heat [W]: a maker's bath of 3 l
has these, from memory. What goes through its walls [W/K]; ours: steel without insulation, but air
stands in the case."""


@dataclass(frozen=True)
class UltrasonicBath(Instrument):
    """An ultrasonic bath of 3 litres: hinged lid, perforated floor above the water's, two knobs.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.202, 0.300, 0.240)
    mass = 3.4
    source = "300 x 180 x 240 mm, 3 l, as usual; from memory"
    left_out = "its sound cleans and dissolves nothing"

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(100.0), reach=0.176)

    @property
    def minutes(self) -> Knob:
        """The timer."""
        return Knob(f"{self.name}_minutes", diameter=0.034, look="blue", steps=7)

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.034, look="blue")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.minutes, self.heat

    @property
    def basket(self) -> Seat:
        """Place of glass in the water."""
        return Seat(f"{self.name}_basket", self.name, (0.0, 0.0, 0.116), width=0.110)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.basket,)

    @property
    def timer(self) -> Countdown:
        """Time left of its sounding; it starts when its knob is turned."""
        setting = Scale(self.minutes, 0, 30, "min", resolution=5)
        return Countdown(f"{self.name}_left", setting)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knobs and its timer, its water with the thermostat, and the heat of its sound."""
        heat = Scale(self.heat, 20, 80, "\u00b0C", resolution=5)
        water, thermostat = bath(self.name, *_WATER, _LEAK, Regulated(_WATT, heat.name))
        sound = EnergyRegulator(f"{self.name}_sound", water.name, _SOUND, switch=self.timer.name)
        minutes = Scale(self.minutes, 0, 30, "min", resolution=5)
        return minutes, self.timer, heat, water, thermostat, sound

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.070, 0.026), self.timer, ink=(255, 90, 60)),)

    def _forms(self) -> list[Form]:
        holes: list[Form] = [
            Block((x, x + 0.006), (-0.118, 0.118), (0.1155, 0.1163), "dark_steel", touch=False)
            for x in (-0.05, -0.03, -0.01, 0.01, 0.03, 0.05)
        ]
        return [
            Block((-0.090, 0.090), (-0.150, 0.150), (0.012, 0.100), "steel", edge=0.006),
            *tub((-0.090, 0.090), (-0.150, 0.150), (0.096, 0.222), 0.012, "steel", "dark_steel"),
            Block((-0.074, 0.074), (-0.134, 0.134), (0.110, 0.116), "steel", edge=0.0),
            *holes,
            Block((-0.079, 0.079), (-0.139, 0.139), (0.116, 0.190), "water", 0.0, touch=False),
            Block((-0.0925, -0.088), (-0.140, 0.140), (0.030, 0.095), "anthracite", touch=False),
            *feet(0.180, 0.300, 0.012),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        for knob, y in ((self.minutes, 0.095), (self.heat, -0.095)):
            knob.add_to(spec, self.name, body, (-0.0925, y, 0.062), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.0928, 0.0, 0.062), ON_FRONT)
        lid = self.lid.add_to(spec, body, (0.088, 0.0, 0.222))
        forms: list[Form] = [
            Block((-0.176, 0.000), (-0.148, 0.148), (0.000, 0.010), "steel"),
            Block((-0.120, -0.060), (-0.050, 0.050), (0.010, 0.018), "black"),
        ]
        assemble(spec, lid, self.name, forms, mass=0.6)
