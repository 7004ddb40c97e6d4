"""A water bath with a gabled lid and a thermostat."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet, tub
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.labware.parts.warmth import Regulated, bath
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world import ON


@dataclass(frozen=True)
class WaterBath(Instrument):
    """A water bath of 10 litres: a display shows the temperature that its knob sets.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.321, 0.367, 0.297)
    mass = 6.5
    source = "330 x 300 x 220 mm without its lid, 10 l, as usual; from memory"

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(95.0), reach=0.280)

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.036)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def drain(self) -> Tap:
        """Valve that lets the water out, on the right."""
        return Tap(f"{self.name}_drain", look="red", length=0.036)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.heat, self.power, self.drain

    @property
    def grid(self) -> Seat:
        """Place of vessels in the water."""
        return Seat(f"{self.name}_grid", self.name, (0.0, 0.0, 0.112), width=0.200)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.grid,)

    @property
    def warming(self) -> tuple[Process, ...]:
        """What knob and switch say, the water and its thermostat: 1 kW, usual; leak ours."""
        knob, power = (
            Scale(self.heat, 20, 100, "\u00b0C", resolution=0.5),
            Scale(self.power, 0, 1, ON),
        )
        by = Regulated(1000.0, knob.name, power.name, resolution=0.5)
        low, high = (-0.131, -0.146, 0.108), (0.131, 0.146, 0.185)
        return knob, power, *bath(self.name, low, high, 0.8, by)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.warming

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_display", (0.080, 0.030), self.warming[-1], ink=(255, 90, 60)),
        )

    def _forms(self) -> list[Form]:
        return [
            Block((-0.150, 0.150), (-0.165, 0.165), (0.012, 0.092), "white", edge=0.008),
            *tub((-0.150, 0.150), (-0.165, 0.165), (0.088, 0.220), 0.018, "white", "steel", 0.004),
            *tub((-0.134, 0.134), (-0.149, 0.149), (0.100, 0.224), 0.003, "steel", "steel", 0.001),
            Block((-0.125, 0.125), (-0.140, 0.140), (0.108, 0.112), "dark_steel", edge=0.001),
            Block((-0.131, 0.131), (-0.146, 0.146), (0.112, 0.185), "water", 0.0, touch=False),
            Block((-0.1525, -0.145), (-0.140, 0.140), (0.026, 0.088), "anthracite", touch=False),
            Rod((-0.060, -0.165, 0.050), (-0.060, -0.195, 0.050), 0.022, "brass"),
            Rod((-0.060, -0.188, 0.050), (-0.060, -0.188, 0.020), 0.012, "brass"),
            *feet(0.300, 0.330, 0.012),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.heat.add_to(spec, self.name, body, (-0.1525, -0.060, 0.057), ON_FRONT)
        self.power.add_to(spec, self.name, body, (-0.1525, -0.115, 0.057), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.1528, 0.060, 0.057), ON_FRONT)
        half = math.sqrt(0.5)
        self.drain.add_to(spec, self.name, body, (-0.060, -0.184, 0.061), (0.0, half, half, 0.0))
        lid = self.lid.add_to(spec, body, (0.138, 0.0, 0.224))
        gable = ((-0.280, 0.0), (0.0, 0.0), (-0.080, 0.060), (-0.200, 0.060))
        forms: list[Form] = [
            Prism(gable, (-0.152, 0.152), "steel", edge=0.003),
            Rod((-0.170, -0.06, 0.066), (-0.170, 0.06, 0.066), 0.014, "black"),
        ]
        assemble(spec, lid, self.name, forms, mass=0.9)
