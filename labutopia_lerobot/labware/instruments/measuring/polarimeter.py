"""A polarimeter with a trough for its tube."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet, tub
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.rotor import Rotor


@dataclass(frozen=True)
class Polarimeter(Instrument):
    """A polarimeter: the tube lies in its lidded trough, one looks in and turns the analyser.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.233, 0.600, 0.295)
    mass = 8.0
    source = "600 x 200 x 300 mm, for tubes of 200 mm, as usual; from memory"
    left_out = "no light is turned: the scale shows where the analyser stands"

    @property
    def lid(self) -> Rotor:
        """The lid of the trough, hinged along its back."""
        return Rotor(f"{self.name}_lid", friction=0.05, effort=0.5, widest=math.radians(100.0))

    @property
    def analyser(self) -> Rotor:
        """The ring with the scale, turned by hand."""
        return Rotor(f"{self.name}_analyser", friction=0.03, effort=0.3)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.analyser, self.power

    @property
    def displays(self) -> tuple[Display, ...]:
        turn = Scale(self.analyser, 0.0, 360.0, "\u00b0", resolution=0.05)
        return (Display(f"{self.name}_display", (0.070, 0.026), turn),)

    def _forms(self) -> list[Form]:
        z = 0.240
        return [
            Block((-0.110, 0.110), (-0.220, 0.220), (0.004, 0.060), "cream", edge=0.008),
            *feet(0.20, 0.44, 0.004),
            *(
                Block(
                    (-0.040, 0.040), (s * 0.150 - 0.030, s * 0.150 + 0.030), (0.055, 0.205), "cream"
                )
                for s in (-1, 1)
            ),
            *tub((-0.036, 0.036), (-0.160, 0.160), (0.200, 0.240), 0.004, "anthracite"),
            Rod((0, -0.158, z), (0, -0.235, z), 0.050, "anthracite"),
            Rod((0, 0.158, z), (0, 0.225, z), 0.060, "anthracite"),
            Block((-0.050, 0.050), (0.220, 0.300), (0.190, 0.290), "cream", edge=0.010),
            Rod((0, -0.275, z), (0, -0.300, z), 0.034, "black"),
            Rod((0, -0.234, z), (0, -0.280, z), 0.024, "black"),
            Rod((0, -0.100, 0.222), (0, 0.100, 0.222), 0.020, "glass_edge"),
            *(
                Rod((0, y - 0.004, 0.222), (0, y + 0.004, 0.222), 0.028, "brass")
                for y in (-0.100, 0.100)
            ),
            Block((-0.112, -0.100), (-0.130, 0.130), (0.012, 0.052), "anthracite"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.power.add_to(spec, self.name, body, (-0.112, -0.090, 0.032), ON_FRONT)
        self.displays[0].add_to(spec, body, (-0.1123, 0.050, 0.032), ON_FRONT)
        axis = (0.0, 1.0, 0.0)
        lid = self.lid.add_to(spec, body, (0.040, 0.0, 0.2415), axis, balanced=True)
        roof = ((-0.078, 0.0), (0.0, 0.0), (-0.012, 0.024), (-0.066, 0.024))
        forms: list[Form] = [
            Prism(roof, (-0.150, 0.150), "cream", edge=0.003),
            Block((-0.092, -0.070), (-0.020, 0.020), (0.002, 0.010), "black"),
        ]
        assemble(spec, lid, self.name, forms, mass=0.3)
        ring = self.analyser.add_to(spec, body, (0.0, -0.236, 0.240), (0.0, -1.0, 0.0))
        marks: list[Form] = [Rod((0, -0.018, 0), (0, 0.0, 0), 0.110, "steel")]
        for n in range(24):
            a = math.radians(15.0 * n)
            x, z, size = 0.048 * math.cos(a), 0.048 * math.sin(a), 0.0020 if n % 6 else 0.0035
            marks.append(
                Block(
                    (x - size, x + size),
                    (-0.0186, -0.0178),
                    (z - size, z + size),
                    "black",
                    0.0,
                    touch=False,
                )
            )
        assemble(spec, ring, self.name, marks, mass=0.3)
