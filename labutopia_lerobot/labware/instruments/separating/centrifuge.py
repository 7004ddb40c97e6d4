"""A bench centrifuge with a latched lid and a rotor of twelve bores."""

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


@dataclass(frozen=True)
class Centrifuge(Spinning):
    """A centrifuge whose upright bores take twelve 15 ml tubes."""

    size = (0.520, 0.400, 0.300)
    mass = 32.0
    source = "400 x 520 x 300 mm, rotor of 200 mm, usual for 4 x 100 ml; from memory"
    highest, longest, ramp = 4000.0, 30.0, 200.0
    bores, circle, bottom, deep, takes = 12, 0.070, 0.010, 0.060, 0.016
    # Ours: makers of bench centrifuges allow 2 to 10 g between opposite tubes.
    uneven = 0.005
    lid_thickness = 0.028
    dial, panes = 0.036, (0.078, 0.026)

    @property
    def lid(self) -> Lid:
        return Lid(
            f"{self.name}_lid",
            widest=math.radians(75.0),
            reach=0.350,
            friction=0.5,
            begins=self.lid_open,
        )

    def _forms(self) -> list[Form]:
        console = (
            (-0.260, 0.014),
            (-0.120, 0.014),
            (-0.120, 0.268),
            (-0.160, 0.268),
            (-0.260, 0.090),
        )
        return [
            Prism(console, (-0.200, 0.200), "white", edge=0.008),
            Block((-0.130, 0.240), (-0.200, 0.200), (0.014, 0.100), "white", edge=0.006),
            Block((-0.130, 0.260), (0.160, 0.200), (0.090, 0.268), "white", edge=0.006),
            Block((-0.130, 0.260), (-0.200, -0.160), (0.090, 0.268), "white", edge=0.006),
            Block((0.200, 0.260), (-0.190, 0.190), (0.014, 0.268), "white", edge=0.006),
            Ring(0.280, 0.320, (0.098, 0.262), "steel", at=(0.040, 0.0)),
            Ring(0.280, 0.400, (0.255, 0.263), "anthracite", at=(0.040, 0.0), touch=False),
            Rod((0.040, 0, 0.098), (0.040, 0, 0.103), 0.270, "dark_steel"),
            Rod((0.040, 0, 0.100), (0.040, 0, 0.120), 0.040, "steel"),
            *feet(0.520, 0.400, 0.014),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(29.3)
        for knob, display, y in zip(
            (self.speed, self.time), self.displays, (0.10, -0.04), strict=True
        ):
            knob.add_to(spec, self.name, body, (-0.2348, y, 0.135), lean)
            display.add_to(spec, body, (-0.2054, y, 0.1884), lean)
        self.latch.add_to(spec, body, (-0.2348, -0.140, 0.135), lean)
        self.start.add_to(spec, body, (-0.2348, 0.045, 0.135), lean)
        self.stop.add_to(spec, body, (-0.2348, 0.012, 0.135), lean)
        self._add_rotor(spec, self.rotor.add_to(spec, body, (0.040, 0.0, 0.121)))
        lid = self.lid.add_to(spec, body, (0.215, 0.0, 0.270))
        self._bolt.add_to(spec)
        forms: list[Form] = [
            Block(
                (-0.350, 0.0), (-0.190, 0.190), (0.000, self.lid_thickness), "petrol", edge=0.010
            ),
            Rod((-0.175, 0, 0.0282), (-0.175, 0, 0.0295), 0.080, "smoked", touch=False),
            Block((-0.356, -0.340), (-0.040, 0.040), (0.004, 0.018), "anthracite"),
        ]
        assemble(spec, lid, self.name, forms, mass=3.0)

    def _add_rotor(self, spec: mujoco.MjSpec, rotor: mujoco.MjsBody) -> None:
        top = self.bottom + self.deep
        hub = ((0, 0), (0.054, 0), (0.054, top), (0.020, top + 0.006), (0, top + 0.006))
        skin = ((0.085, 0.002), (0.092, 0.010), (0.088, top), (0.054, top))
        forms: list[Form] = [
            Turned(hub, "steel"),
            Turned(((0, 0), (0.090, 0), (0.090, 0.010), (0, 0.010)), "steel"),
            Turned(skin, "steel", touch=False),
            Rod((0, 0, top + 0.006), (0, 0, top + 0.016), 0.024, "anthracite"),
        ]
        for x, y in self._places_around():
            forms.append(
                Ring(
                    _BORE, 0.021, (0.010, top + 0.002), "anthracite", (x, y), segments=12, facets=6
                )
            )
            forms.append(
                Rod((x, y, top), (x, y, top + 0.0005), _BORE, "black", touch=False, segments=12)
            )
        assemble(spec, rotor, self.name, forms, mass=2.5)
        for place in self.places:
            place.add_to(rotor)
