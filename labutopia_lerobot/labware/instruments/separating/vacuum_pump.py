"""A diaphragm vacuum pump."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.air import AMBIENT, Vacuum
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.guard import Flipped
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.processes import Process

_END = 10.0
"""Its end vacuum [mbar]; ours: diaphragm pumps with two heads in a row reach 2 to 10 mbar."""
_SPEED, _VOLUME = 0.5, 1.0
"""Its pumping speed [l/s], that of `source`, and what it evacuates [l]; ours: a flask of 1 l."""
_LEAKS = 60.0
"""Time constant with which the air comes back when it is off [s]; ours."""


@dataclass(frozen=True)
class VacuumPump(Instrument):
    """A diaphragm pump with two heads, a gauge, a regulating knob and a switch.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.334, 0.160, 0.192)
    mass = 9.0
    source = "160 x 320 x 200 mm, usual for 30 l/min; from memory"

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green", height=0.026)

    @property
    def regulator(self) -> Knob:
        return Knob(f"{self.name}_regulator", diameter=0.032, look="blue")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.power, self.regulator

    @property
    def scale(self) -> Scale:
        return Scale(self.regulator, AMBIENT, _END, "mbar")

    @property
    def vacuum(self) -> Vacuum:
        """The pressure at its inlet."""
        on = self.power.name
        return Vacuum(f"{self.name}_pressure", on, self.scale, _END, _VOLUME / _SPEED, _LEAKS)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, its regulator and the pressure at its inlet."""
        return Flipped(self.power), self.scale, self.vacuum

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.072, 0.024), self.vacuum),)

    def _forms(self) -> list[Form]:
        heads: list[Form] = []
        for x in (-0.010, 0.095):
            heads += [
                Rod((x, 0, 0.120), (x, 0, 0.150), 0.092, "dark_steel"),
                Rod((x, 0, 0.150), (x, 0, 0.168), 0.100, "black"),
                Rod((x, 0, 0.168), (x, 0, 0.176), 0.070, "black"),
                *(
                    Rod(
                        (x + 0.04 * math.cos(a), 0.04 * math.sin(a), 0.168),
                        (x + 0.04 * math.cos(a), 0.04 * math.sin(a), 0.173),
                        0.008,
                        "chrome",
                        touch=False,
                        segments=8,
                    )
                    for a in (0.8, 2.4, 3.9, 5.5)
                ),
            ]
        fins: list[Form] = [
            Block((x, x + 0.004), (-0.070, 0.070), (0.030, 0.118), "grey", 0.001, touch=False)
            for x in (-0.045, -0.025, -0.005, 0.015, 0.035, 0.055, 0.075, 0.095, 0.115, 0.135)
        ]
        return [
            Block((-0.155, -0.060), (-0.076, 0.076), (0.016, 0.150), "light_grey", edge=0.008),
            Rod((-0.070, 0, 0.075), (0.155, 0, 0.075), 0.110, "grey"),
            Block((-0.160, 0.160), (-0.080, 0.080), (0.012, 0.024), "anthracite"),
            *fins,
            Block((-0.060, 0.150), (-0.046, 0.046), (0.112, 0.124), "grey"),
            *heads,
            Rod((-0.010, 0, 0.186), (0.095, 0, 0.186), 0.012, "black"),
            Rod((-0.010, 0, 0.172), (-0.010, 0, 0.190), 0.014, "black"),
            Rod((0.095, 0, 0.172), (0.095, 0, 0.190), 0.014, "black"),
            Rod((0.130, 0, 0.160), (0.160, 0, 0.160), 0.010, "chrome"),
            Rod((-0.110, -0.05, 0.182), (-0.110, 0.05, 0.182), 0.014, "black"),
            Rod((-0.110, -0.05, 0.145), (-0.110, -0.05, 0.188), 0.012, "black"),
            Rod((-0.110, 0.05, 0.145), (-0.110, 0.05, 0.188), 0.012, "black"),
            *feet(0.320, 0.160, 0.014),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.power.add_to(spec, self.name, body, (-0.155, 0.040, 0.055), ON_FRONT)
        self.regulator.add_to(spec, self.name, body, (-0.155, -0.020, 0.060), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.1555, 0.010, 0.115), ON_FRONT)
