"""A moisture analyser."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import FINISHES
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod
from labutopia_lerobot.labware.parts.guard import Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.pan import Pan
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.push_button import PushButton
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.labware.parts.weighing import Weighing
from labutopia_lerobot.processes import DoorGap, Process

_LAMPS, _LEAK = 400.0, 1.0
"""Power of its lamps [W], and what its hood lets through [W/K]."""


@dataclass(frozen=True)
class MoistureAnalyser(Instrument):
    """A moisture analyser: a balance whose hood of lamps is shut over the sample.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.340, 0.210, 0.170)
    mass = 4.9
    source = "210 x 340 x 170 mm, pan of 90 mm, usual for 60 g; from memory"
    left_out = "its sample loses no mass: nothing dries"

    @property
    def pan(self) -> Pan:
        return Pan(f"{self.name}_pan", width=0.080, top=0.008)

    @property
    def hood(self) -> Lid:
        return Lid(f"{self.name}_hood", math.radians(80.0), reach=0.170, friction=0.25)

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.030, pointer="red")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.hood, self.heat

    @property
    def tare(self) -> PushButton:
        """Button that sets the display to zero."""
        blue = FINISHES["blue"].rgba
        return PushButton(f"{self.name}_tare", blue, radius=0.009, travel=0.003, proud=0.006)

    @property
    def buttons(self) -> tuple[PushButton, ...]:
        return (self.tare,)

    @property
    def weighing(self) -> Weighing:
        """The mass on its pan."""
        name, tare = f"{self.name}_reading", self.tare.name
        return self.pan.weighing(name, 1e-3, 60.0, tare)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.pan.place,)

    @property
    def warming(self) -> tuple[Process, ...]:
        """Its knob, what feels its hood, the air below it and its thermostat.

        It heats while its hood is shut and its knob is up; 400 W are usual for halogen lamps (from
        memory), the leak is ours.
        """
        knob, shut = Scale(self.heat, 0, 200, "\u00b0C"), Shut(self.hood, "HOOD OPEN")
        x, half = 0.040, 0.055
        low, high = (x - half, -half, 0.080), (x + half, half, 0.130)
        gap = DoorGap(self.hood.joint, 4 * half**2, 2 * half, share=0.3)
        by = Regulated(_LAMPS, knob.name, shut.name, warning=shut.warning)
        return knob, shut, *chamber(self.name, low, high, _LEAK, gap, by)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.warming

    @property
    def displays(self) -> tuple[Display, ...]:
        heat = self.warming[-1]
        return (
            Display(f"{self.name}_mass", (0.080, 0.026), self.weighing),
            Display(f"{self.name}_temperature", (0.060, 0.020), heat, ink=(255, 90, 60)),
        )

    def _forms(self) -> list[Form]:
        side = ((-0.170, 0.010), (0.170, 0.010), (0.170, 0.070), (-0.060, 0.070), (-0.170, 0.034))
        return [
            Prism(side, (-0.105, 0.105), "white", edge=0.006),
            Block((-0.168, 0.168), (-0.102, 0.102), (0.008, 0.020), "anthracite"),
            *feet(0.34, 0.21, 0.010),
            Ring(0.118, 0.150, (0.066, 0.088), "anthracite", at=(0.040, 0.0)),
            Block((0.130, 0.168), (-0.090, 0.090), (0.064, 0.098), "white", edge=0.006),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        plate: list[Form] = [
            Rod((0, 0, 0.003), (0, 0, 0.008), 0.100, "steel"),
            Rod((0, 0, -0.004), (0, 0, 0.004), 0.024, "anthracite"),
        ]
        self.pan.add_to(spec, self.name, body, (0.040, 0.0, 0.075), plate)
        lean = leaning(71.9)
        self.displays[0].add_to(spec, body, (-0.112, 0.050, 0.0534), lean)
        self.displays[1].add_to(spec, body, (-0.136, 0.050, 0.0455), lean)
        self.tare.add_to(spec, body, (-0.115, -0.015, 0.0520), lean)
        self.heat.add_to(spec, self.name, body, (-0.115, -0.065, 0.0520), lean)
        hood = self.hood.add_to(spec, body, (0.150, 0.0, 0.105))
        forms: list[Form] = [
            Block((-0.190, 0.0), (-0.085, 0.085), (0.030, 0.065), "petrol", edge=0.012),
            *(
                Block((-0.190, -0.022), (y - 0.0035, y + 0.0035), (-0.033, 0.050), "petrol")
                for y in (-0.0815, 0.0815)
            ),
            Block((-0.190, -0.183), (-0.082, 0.082), (-0.033, 0.050), "petrol"),
            *(
                Rod((x, -0.050, 0.026), (x, 0.050, 0.026), 0.012, "glow", touch=False)
                for x in (-0.115, -0.083)
            ),
            Block((-0.204, -0.186), (-0.040, 0.040), (0.012, 0.024), "anthracite"),
        ]
        assemble(spec, hood, self.name, forms, mass=0.7)
