"""A peristaltic pump."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drive import Drive, Pumping
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod, about
from labutopia_lerobot.labware.parts.guard import Flipped, Shut
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.processes import Process

_AXIS = (0.042, 0.088)
"""Axis of the head, y and z [m]."""


@dataclass(frozen=True)
class PeristalticPump(Instrument):
    """A peristaltic pump: three rollers squeeze a tube against the shoe that its lever shuts.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.248, 0.201, 0.150)
    mass = 3.5
    source = "200 x 220 x 150 mm, head of 100 mm, as usual; from memory"
    left_out = "no liquid moves: it has no hose"

    @property
    def head(self) -> Rotor:
        """What carries the rollers."""
        return Rotor(f"{self.name}_head", friction=0.03, effort=0.3, stall=1.5)

    @property
    def shoe(self) -> Rotor:
        """The shoe over the tube; it is swung up to put the tube in."""
        return Rotor(f"{self.name}_shoe", friction=0.2, effort=1.5, widest=math.radians(75.0))

    @property
    def speed(self) -> Knob:
        return Knob(f"{self.name}_speed", diameter=0.032)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.shoe, self.head, self.speed, self.power

    @property
    def scale(self) -> Scale:
        return Scale(self.speed, 0, 300, "rpm", resolution=5)

    @property
    def drive(self) -> Drive:
        """What turns it."""
        return Drive(
            f"{self.name}_rpm",
            self.scale,
            ramp=300.0,
            brake=600.0,
            on=(self.power.name, self.closed.name),
            motors=(self.head.motor,),
            resolution=5,
        )

    @property
    def closed(self) -> Shut:
        """What feels that the shoe is down: its rollers do not turn open."""
        return Shut(self.shoe, "HEAD OPEN")

    @property
    def per_turn(self) -> float:
        """Volume that a turn of its head delivers [ml].

        Ours: the heads of makers deliver 0.4 to 3 ml with tubes of 3 to 8 mm.
        """
        return 2.0

    @property
    def flow(self) -> Pumping:
        """What it delivers."""
        return Pumping(f"{self.name}_flow", self.drive, self.per_turn)

    @property
    def works(self) -> tuple[Process, ...]:
        """Its switch, its guard, its knob, its drive and what it delivers."""
        return Flipped(self.power), self.closed, self.scale, self.drive, self.flow

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.060, 0.024), self.drive),)

    def _forms(self) -> list[Form]:
        y, z = _AXIS
        return [
            Block((-0.080, 0.110), (-0.100, 0.100), (0.010, 0.150), "white", edge=0.010),
            *feet(0.19, 0.20, 0.012),
            Block((-0.082, -0.070), (-0.095, -0.020), (0.020, 0.140), "anthracite"),
            Rod((-0.086, y, z), (-0.070, y, z), 0.108, "light_grey"),
            Prism(
                ((-0.120, 0.018), (-0.078, 0.018), (-0.078, 0.034), (-0.120, 0.034)),
                (y - 0.052, y + 0.052),
                "light_grey",
            ),
            *(
                Rod(
                    (-0.104, y + s * 0.044, 0.030),
                    (-0.104, y + s * 0.044, 0.088),
                    0.009,
                    "orange",
                    touch=False,
                )
                for s in (-1, 1)
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        y, z = _AXIS
        head = self.head.add_to(spec, body, (-0.088, y, z), (-1.0, 0.0, 0.0))
        rollers: list[Form] = [
            Rod((-0.024, 0, 0), (0.0, 0, 0), 0.024, "chrome"),
            Rod((-0.003, 0, 0), (0.0, 0, 0), 0.062, "steel"),
            Rod((-0.027, 0, 0), (-0.024, 0, 0), 0.062, "steel"),
        ]
        for n in range(3):
            a = 2 * math.pi * n / 3
            at = (0.024 * math.cos(a), 0.024 * math.sin(a))
            rollers.append(Rod((-0.024, *at), (-0.003, *at), 0.018, "ceramic"))
        assemble(spec, head, self.name, rollers, mass=0.25)
        axis = (-1.0, 0.0, 0.0)
        shoe = self.shoe.add_to(spec, body, (-0.088, y + 0.058, z), axis, balanced=True)
        arch: list[Form] = []
        for n in range(9):
            a = math.pi * n / 8
            at = (-0.058 + 0.044 * math.cos(a), 0.044 * math.sin(a))
            turn = about((1.0, 0.0, 0.0), math.degrees(a))
            arch.append(
                Block(
                    (-0.028, -0.002),
                    (at[0] - 0.005, at[0] + 0.005),
                    (at[1] - 0.010, at[1] + 0.010),
                    "light_grey",
                    0.002,
                    turn,
                )
            )
        arch += [
            Rod((-0.028, -0.004, 0), (-0.001, -0.004, 0), 0.010, "chrome"),
            Block((-0.050, -0.006), (-0.066, -0.050), (0.046, 0.056), "black"),
        ]
        assemble(spec, shoe, self.name, arch, mass=0.2)
        self.speed.add_to(spec, self.name, body, (-0.082, -0.058, 0.060), ON_FRONT)
        self.power.add_to(spec, self.name, body, (-0.082, -0.058, 0.030), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.0825, -0.058, 0.110), ON_FRONT)
