"""A small centrifuge with a lid that springs open and a rotor of eight bores."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.spinning import Spinning

_BORE = 0.0175
"""Diameter of a bore, for tubes of 17 mm [m]."""
_LEAN = 55.0
"""How far its panel leans back from upright [deg]."""
_LIFT = 2.0
"""Torque of the spring of its lid [N m]; ours: 8 N at its front edge keep it shut."""


@dataclass(frozen=True)
class ClinicalCentrifuge(Spinning):
    """A small centrifuge for eight 15 ml tubes, which stand out of its rotor.

    Attributes:
        lid_springs: Whether its lid springs open by itself where its lock does not keep it shut.
    """

    lid_springs: bool = False
    size = (0.340, 0.280, 0.242)
    mass = 9.0
    source = "280 x 340 x 240 mm, 8 x 15 ml, 6000 rpm, as usual; from memory"
    highest, longest, ramp = 6000.0, 30.0, 300.0
    bores, circle, bottom, deep, takes = 8, 0.055, 0.008, 0.060, 0.016
    # Ours: makers of bench centrifuges allow 2 to 10 g between opposite tubes.
    uneven = 0.005
    lid_thickness = 0.056
    dial, panes = 0.034, (0.056, 0.022)

    @property
    def lid(self) -> Lid:
        return Lid(
            f"{self.name}_lid",
            widest=math.radians(80.0),
            reach=0.245,
            friction=0.3,
            begins=self.lid_open,
            lift=_LIFT if self.lid_springs else 0.0,
        )

    def _forms(self) -> list[Form]:
        console = (
            (-0.170, 0.012),
            (-0.095, 0.012),
            (-0.095, 0.1525),
            (-0.170, 0.100),
        )
        corners = [
            Block(x, y, (0.070, 0.179), "white", edge=0.002, touch=False)
            for x in ((-0.090, -0.046), (0.106, 0.150))
            for y in ((-0.118, -0.076), (0.076, 0.118))
        ]
        return [
            Prism(console, (-0.140, 0.140), "white", edge=0.008),
            Block((-0.100, 0.170), (-0.140, 0.140), (0.012, 0.078), "white", edge=0.006),
            Block((-0.095, 0.170), (0.114, 0.140), (0.070, 0.180), "white", edge=0.005),
            Block((-0.095, 0.170), (-0.140, -0.114), (0.070, 0.180), "white", edge=0.005),
            Block((0.144, 0.170), (-0.130, 0.130), (0.070, 0.180), "white", edge=0.005),
            Block((-0.095, -0.086), (-0.130, 0.130), (0.070, 0.180), "white", edge=0.003),
            *corners,
            Ring(0.212, 0.236, (0.078, 0.180), "steel", at=(0.030, 0.0)),
            Ring(0.212, 0.262, (0.175, 0.182), "anthracite", at=(0.030, 0.0), touch=False),
            Rod((0.030, 0, 0.076), (0.030, 0, 0.081), 0.205, "dark_steel"),
            *feet(0.340, 0.280, 0.012),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(_LEAN)
        for key, y in ((self.latch, 0.112), (self.start, 0.070), (self.stop, 0.028)):
            key.add_to(spec, body, (-0.1454, y, 0.1172), lean)
        for knob, display, y in zip(
            (self.speed, self.time), self.displays, (-0.102, -0.036), strict=True
        ):
            knob.add_to(spec, self.name, body, (-0.1454, y, 0.1172), lean)
            display.add_to(spec, body, (-0.1125, y, 0.1413), lean)
        self._add_rotor(spec, self.rotor.add_to(spec, body, (0.030, 0.0, 0.096)))
        lid = self.lid.add_to(spec, body, (0.150, 0.0, 0.186))
        self._bolt.add_to(spec)
        z = (0.0, 0.052)
        forms: list[Form] = [
            Block((-0.245, 0.0), (-0.125, 0.125), (0.048, self.lid_thickness), "blue", edge=0.004),
            Block((-0.245, -0.235), (-0.125, 0.125), z, "blue", edge=0.003),
            Block((-0.010, 0.0), (-0.125, 0.125), z, "blue", edge=0.003),
            Block((-0.240, -0.005), (0.115, 0.125), z, "blue", edge=0.003),
            Block((-0.240, -0.005), (-0.125, -0.115), z, "blue", edge=0.003),
            Rod((-0.120, 0, 0.0562), (-0.120, 0, 0.0572), 0.060, "smoked", touch=False),
        ]
        assemble(spec, lid, self.name, forms, mass=1.2)

    def _add_rotor(self, spec: mujoco.MjSpec, rotor: mujoco.MjsBody) -> None:
        top = self.bottom + self.deep
        hub = ((0, 0), (0.041, 0), (0.041, top), (0.016, top + 0.006), (0, top + 0.006))
        skin = ((0.070, 0.002), (0.075, 0.010), (0.071, top), (0.041, top))
        forms: list[Form] = [
            Turned(hub, "steel"),
            Turned(((0, 0), (0.073, 0), (0.073, self.bottom), (0, self.bottom)), "steel"),
            Turned(skin, "steel", touch=False),
            Rod((0, 0, top + 0.006), (0, 0, top + 0.014), 0.022, "anthracite"),
        ]
        for x, y in self._places_around():
            wall = (self.bottom, top + 0.002)
            forms.append(Ring(_BORE, 0.021, wall, "anthracite", (x, y), segments=12, facets=6))
            forms.append(
                Rod((x, y, top), (x, y, top + 0.0005), _BORE, "black", touch=False, segments=12)
            )
        assemble(spec, rotor, self.name, forms, mass=1.0)
        for place in self.places:
            place.add_to(rotor)
