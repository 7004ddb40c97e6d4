"""An Abbe refractometer."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.processes import Prisms
from labutopia_lerobot.world.model import COLLISION_GROUP


@dataclass(frozen=True)
class Refractometer(Instrument):
    """An Abbe refractometer: it shows the index of a drop that its prisms have been shut on.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.186, 0.140, 0.301)
    mass = 2.8
    source = "180 x 140 x 260 mm, as usual; from memory"
    left_out = "no light is bent: the display finds the edge, and its knobs need not be turned"

    @property
    def prism(self) -> Rotor:
        """The upper prism, which opens like a book."""
        return Rotor(f"{self.name}_prism", friction=0.05, effort=0.5, widest=math.radians(100.0))

    @property
    def index(self) -> Knob:
        """Knob that turns the prisms until the edge of the shadow is in the cross."""
        return Knob(f"{self.name}_index", diameter=0.040, look="black")

    @property
    def dispersion(self) -> Knob:
        """Knob that takes the colours from the edge."""
        return Knob(f"{self.name}_dispersion", diameter=0.028, look="black")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.prism, self.index, self.dispersion

    @property
    def displays(self) -> tuple[Display, ...]:
        ink, paper = (20, 30, 25), (165, 185, 160)
        return (Display(f"{self.name}_display", (0.062, 0.022), self.reads, ink, paper),)

    @property
    def reads(self) -> Prisms:
        """What its display shows: the index of what lies between the prisms."""
        return Prisms(f"{self.name}_index_of_film", f"{self.name}_stage", self.prism.joint)

    def _forms(self) -> list[Form]:
        tilt = math.radians(40.0)
        start = (0.010, 0.0, 0.180)
        eye = (start[0] - 0.120 * math.sin(tilt), 0.0, start[2] + 0.120 * math.cos(tilt))
        cup = (eye[0] - 0.022 * math.sin(tilt), 0.0, eye[2] + 0.022 * math.cos(tilt))
        return [
            Block((-0.090, 0.090), (-0.070, 0.070), (0.004, 0.026), "petrol", edge=0.008),
            *feet(0.17, 0.14, 0.004),
            Block((-0.035, 0.055), (-0.045, 0.045), (0.022, 0.190), "white", edge=0.012),
            Rod(start, eye, 0.034, "petrol"),
            Rod(eye, cup, 0.040, "black"),
            Block((-0.0885, -0.030), (-0.042, 0.042), (0.024, 0.062), "white", edge=0.006),
            Block((-0.080, -0.030), (-0.024, 0.024), (0.088, 0.112), "steel", edge=0.003),
            Block((-0.076, -0.036), (-0.018, 0.018), (0.1115, 0.1128), "glass_edge", 0.0),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        half = math.sqrt(0.5)  # z to the left: on the right side
        side = (half, -half, 0.0, 0.0)
        self.index.add_to(spec, self.name, body, (0.020, -0.045, 0.080), side)
        self.dispersion.add_to(spec, self.name, body, (0.020, -0.045, 0.140), side)
        self.displays[0].add_to(spec, body, (-0.0888, 0.0, 0.044), ON_FRONT)
        stage = (-0.056, 0.0, 0.1128)
        body.add_site(name=f"{self.name}_stage", pos=stage, group=COLLISION_GROUP)
        axis = (-1.0, 0.0, 0.0)
        prism = self.prism.add_to(spec, body, (-0.056, 0.030, 0.114), axis, balanced=True)
        forms: list[Form] = [
            Block((-0.022, 0.018), (-0.054, -0.004), (0.0, 0.024), "steel", edge=0.004),
            Rod((-0.018, 0, 0), (0.014, 0, 0), 0.008, "chrome"),
            Block((-0.010, 0.006), (-0.066, -0.050), (0.008, 0.016), "black"),
        ]
        assemble(spec, prism, self.name, forms, mass=0.15)
