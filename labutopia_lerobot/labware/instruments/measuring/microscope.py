"""A compound microscope with a turret of four objectives."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lamp import Lamp
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Process

_TUBE = 0.030
"""Position of the optical axis, before the middle of the base [m]."""


@dataclass(frozen=True)
class Microscope(Instrument):
    """A microscope: the coarse knobs raise the stage, the turret turns, the slide is pushed.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.313, 0.179, 0.432)
    mass = 6.5
    source = "230 x 330 x 420 mm, stage of 140 mm, travel 75 x 50 mm, as usual; from memory"
    left_out = "no image"

    @property
    def focus(self) -> Rotor:
        """Both coarse focus knobs, on one shaft; one turn raises the stage by 20 mm."""
        return Rotor(f"{self.name}_focus", friction=0.06, effort=0.6, widest=math.radians(320.0))

    @property
    def turret(self) -> Rotor:
        """The nosepiece."""
        return Rotor(f"{self.name}_turret", friction=0.03, effort=0.3)

    @property
    def table(self) -> Slide:
        """Stage that carries the slide from side to side."""
        return Slide(f"{self.name}_table", 0.040, friction=1.0, effort=5.0)

    @property
    def light(self) -> Knob:
        return Knob(f"{self.name}_light", diameter=0.026)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.turret, self.table, self.focus, self.light

    @property
    def lamp(self) -> Lamp:
        """The lamp below the stage."""
        return Lamp(f"{self.name}_lamp", Scale(self.light, 0, 1, "1", 0.01))

    @property
    def works(self) -> tuple[Process, ...]:
        """Its knob and its lamp."""
        return self.lamp.level, self.lamp

    @property
    def stage(self) -> Seat:
        """Place of a slide, in the optical axis."""
        at = (0.0, 0.0, 0.004)
        return Seat(f"{self.name}_slide", self.table.name, at, width=0.020)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.stage,)

    def _forms(self) -> list[Form]:
        base = ((-0.140, 0.008), (0.140, 0.008), (0.140, 0.050), (0.040, 0.056), (-0.140, 0.034))
        x = -_TUBE
        return [
            Prism(base, (-0.080, 0.080), "cream", edge=0.012),
            Prism(
                ((0.075, 0.045), (0.125, 0.045), (0.105, 0.300), (0.060, 0.300)),
                (-0.030, 0.030),
                "cream",
                edge=0.010,
            ),
            Prism(
                ((-0.070, 0.285), (0.105, 0.285), (0.095, 0.330), (-0.060, 0.330)),
                (-0.034, 0.034),
                "cream",
                edge=0.010,
            ),
            Rod((x, 0, 0.036), (x, 0, 0.058), 0.060, "anthracite"),
            Rod((x, 0, 0.276), (x, 0, 0.290), 0.052, "anthracite"),
            Rod((x, 0, 0.325), (x, 0, 0.345), 0.060, "anthracite"),
            Block((-0.085, 0.010), (-0.050, 0.050), (0.340, 0.378), "cream", edge=0.010),
            *(Rod((-0.060, y, 0.360), (-0.145, y, 0.405), 0.032, "cream") for y in (-0.032, 0.032)),
            *(
                Rod((-0.140, y, 0.4024), (-0.165, y, 0.4156), 0.038, "black")
                for y in (-0.032, 0.032)
            ),
            *feet(0.270, 0.150, 0.008),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.lamp.add_to(spec, body, (-_TUBE, 0.0, 0.0585), (0.022, 0.0005, 0.0))
        turret = self.turret.add_to(spec, body, (-_TUBE + 0.012, 0.0, 0.268), (0.0, 0.0, 1.0))
        lenses: list[Form] = [
            Turned(
                ((0, -0.012), (0.020, -0.012), (0.030, 0.0), (0.030, 0.007), (0, 0.007)), "chrome"
            )
        ]
        for n, (length, ring) in enumerate(
            zip((0.022, 0.030, 0.038, 0.042), ("red", "yellow", "light_blue", "white"), strict=True)
        ):
            a = math.pi + n * math.pi / 2
            x, y = 0.014 * math.cos(a), 0.014 * math.sin(a)
            lenses += [
                Turned(
                    ((0, -length), (0.004, -length), (0.009, 0.006 - length), (0.009, 0)),
                    "steel",
                    (x, y, -0.008),
                    segments=16,
                ),
                Ring(0.016, 0.0186, (-0.022, -0.019), ring, (x, y), touch=False, segments=16),
            ]
        assemble(spec, turret, self.name, lenses, mass=0.30)
        self.light.add_to(spec, self.name, body, (-0.020, -0.080, 0.030), (0.5, -0.5, 0.5, 0.5))
        focus = self.focus.add_to(spec, body, (0.094, 0.0, 0.095), (0.0, 1.0, 0.0))
        knobs: list[Form] = []
        for side in (-1, 1):
            knobs += [
                Rod((0, side * 0.031, 0), (0, side * 0.060, 0), 0.046, "anthracite"),
                Rod((0, side * 0.060, 0), (0, side * 0.078, 0), 0.028, "black"),
                Rod(
                    (0.016, side * 0.0602, 0),
                    (0.016, side * 0.0606, 0),
                    0.005,
                    "white",
                    touch=False,
                ),
            ]
        assemble(spec, focus, self.name, knobs, mass=0.25)
        self._add_stage(spec, body)

    def _add_stage(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add the stage, which a rack and pinion raises, and the table on it."""
        lift = Slide(f"{self.name}_stage", 0.018, friction=1.0)
        stage = lift.add_to(spec, body, (-_TUBE, 0.0, 0.160), (0.0, 0.0, 1.0), balanced=True)
        plate: list[Form] = [
            Block((-0.062, 0.078), (-0.070, 0.070), (0.000, 0.010), "black", edge=0.003),
            Block((0.040, 0.094), (-0.022, 0.022), (-0.040, 0.002), "anthracite", edge=0.003),
            Rod((0, 0, -0.046), (0, 0, -0.001), 0.036, "anthracite"),
        ]
        assemble(spec, stage, self.name, plate, mass=0.6)
        gear = spec.add_equality(name=f"{self.name}_gear", type=mujoco.mjtEq.mjEQ_JOINT)
        gear.objtype, gear.name1, gear.name2 = (
            mujoco.mjtObj.mjOBJ_JOINT,
            lift.joint,
            self.focus.joint,
        )
        gear.data[:5] = (0.0, lift.widest / self.focus.widest, 0.0, 0.0, 0.0)
        table = self.table.add_to(spec, stage, (0.0, -0.020, 0.0105), (0.0, 1.0, 0.0))
        clip: list[Form] = [
            Block((-0.016, 0.016), (-0.046, 0.046), (0.000, 0.004), "dark_steel", edge=0.001),
            Block((0.014, 0.020), (-0.046, 0.046), (0.000, 0.007), "chrome", edge=0.001),
            Block((-0.013, 0.013), (-0.038, 0.038), (0.0041, 0.0051), "glass", 0.0, touch=False),
        ]
        assemble(spec, table, self.name, clip, mass=0.05)
        self.stage.add_to(table)
