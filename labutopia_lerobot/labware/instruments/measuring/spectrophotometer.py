"""A spectrophotometer with a lidded sample bay and a carriage for four cuvettes."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Prism, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import leaning
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.processes import Photometer
from labutopia_lerobot.world.model import COLLISION_GROUP


@dataclass(frozen=True)
class Spectrophotometer(Instrument):
    """A spectrophotometer: the knob sets the wavelength, a rod moves the cuvettes into the beam.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.410, 0.480, 0.220)
    mass = 14.0
    source = "480 x 400 x 220 mm, usual for 325 to 1000 nm; from memory"
    left_out = (
        "square cuvettes hold no liquid: round tubes of 12 mm are read, as if of 10 mm inside"
    )

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", widest=math.radians(80.0), reach=0.150)

    @property
    def carriage(self) -> Slide:
        """Carriage of the cuvettes; its rod is pulled out in front."""
        return Slide(f"{self.name}_carriage", 0.054, friction=2.0, effort=10.0)

    @property
    def wavelength(self) -> Knob:
        return Knob(f"{self.name}_wavelength", diameter=0.044, look="black")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, self.carriage, self.wavelength

    @property
    def places(self) -> tuple[Seat, ...]:
        """Places of the cuvettes, from the back to the front."""
        return tuple(
            Seat(
                f"{self.name}_cuvette_{n}",
                self.carriage.name,
                (0.027 - 0.018 * n, 0.0, 0.006),
                width=0.0125,
                depth=0.030,
            )
            for n in range(4)
        )

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_display", (0.100, 0.034), self.reads),
            Display(f"{self.name}_wavelength_display", (0.070, 0.024), self.set_to),
        )

    @property
    def set_to(self) -> Scale:
        """The wavelength that its knob sets."""
        return Scale(self.wavelength, 325, 1000, "nm")

    @property
    def reads(self) -> Photometer:
        """The absorbance of what stands in the beam."""
        lid, beam = self.lid, f"{self.name}_beam"
        return Photometer(
            f"{self.name}_absorbance", beam, self.set_to.name, lid.joint, lid.closed_within
        )

    def _forms(self) -> list[Form]:
        low, top = 0.014, 0.176
        front = ((-0.200, low), (-0.080, low), (-0.080, top), (-0.110, top), (-0.200, 0.070))
        return [
            Prism(front, (-0.158, 0.240), "white", edge=0.006),
            Prism(front, (-0.240, -0.172), "white", edge=0.006),
            Block((-0.160, -0.085), (-0.173, -0.157), (low, 0.066), "black", edge=0.001),
            Block((-0.160, -0.085), (-0.173, -0.157), (0.104, top - 0.030), "black", edge=0.001),
            Block((-0.090, 0.200), (-0.100, 0.240), (low, 0.220), "white", edge=0.012),
            Block((0.060, 0.200), (-0.240, -0.090), (low, top), "white", edge=0.008),
            Block((-0.085, 0.070), (-0.240, -0.228), (low, top), "white", edge=0.002),
            Block((-0.085, 0.070), (-0.232, -0.100), (low, 0.070), "anthracite", edge=0.002),
            Block((-0.0125, -0.0105), (-0.1010, -0.0990), (0.090, 0.110), "glow", touch=False),
            *feet(0.400, 0.480, 0.014),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        lean = leaning(40.3)
        self.wavelength.add_to(spec, self.name, body, (-0.1700, 0.170, 0.1053), lean)
        for display, y in zip(self.displays, (0.050, -0.070), strict=True):
            display.add_to(spec, body, (-0.1530, y, 0.1258), lean)
        # Where the carriage brings each of its places when it is out by 0, 18, 36 and 54 mm.
        body.add_site(name=f"{self.name}_beam", pos=(-0.0115, -0.165, 0.100), group=COLLISION_GROUP)
        carriage = self.carriage.add_to(spec, body, (0.0155, -0.165, 0.072), (-1.0, 0.0, 0.0))
        cells: list[Form] = [
            Block((-0.040, 0.040), (-0.022, 0.022), (0.000, 0.006), "black"),
            Rod((-0.040, 0, 0.012), (-0.205, 0, 0.012), 0.008, "chrome"),
            Rod((-0.205, 0, 0.012), (-0.220, 0, 0.012), 0.020, "black"),
            *(
                Block((-0.040, 0.040), (y - 0.003, y + 0.003), (0.004, 0.034), "black")
                for y in (-0.0115, 0.0115)
            ),
            *(
                Block((x - 0.002, x + 0.002), (-0.0125, 0.0125), (0.004, 0.030), "black", 0.001)
                for x in (-0.036, -0.018, 0.0, 0.018, 0.036)
            ),
        ]
        assemble(spec, carriage, self.name, cells, mass=0.20)
        for place in self.places:
            place.add_to(carriage)
        lid = self.lid.add_to(spec, body, (0.062, -0.165, 0.178))
        forms: list[Form] = [
            Block((-0.150, 0.0), (-0.072, 0.062), (0.000, 0.022), "petrol", edge=0.006),
            Block((-0.156, -0.140), (-0.025, 0.025), (0.004, 0.014), "anthracite"),
        ]
        assemble(spec, lid, self.name, forms, mass=0.5)
