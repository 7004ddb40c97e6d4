"""A desiccator cabinet of clear acrylic."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.drying import Drying
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.fittings import feet, tub
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.shelf import Shelf
from labutopia_lerobot.labware.parts.slide import Slide


@dataclass(frozen=True)
class DesiccatorCabinet(Instrument):
    """A desiccator cabinet: three shelves over a drawer of blue silica gel, behind a clear door.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.391, 0.340, 0.480)
    mass = 9.0
    source = "340 x 340 x 480 mm, as usual; from memory"
    left_out = "its silica gel is never used up, and what stands in it does not dry"

    @property
    def door(self) -> Door[Handle]:
        handle = Handle(f"{self.name}_handle", 0.10, diameter=0.012, standoff=0.030)
        return Door(f"{self.name}_door", handle, math.radians(110.0), math.radians(0.5))

    @property
    def gel(self) -> Slide:
        """The drawer of silica gel."""
        return Slide(f"{self.name}_gel", 0.200, friction=2.0, effort=10.0)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.door, self.gel

    @property
    def shelves(self) -> tuple[Shelf, ...]:
        """Shelves from below."""
        return tuple(Shelf(f"{self.name}_shelf_{n}") for n in range(3))

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middles of the shelves, from below."""
        return tuple(
            Seat(f"{shelf.name}_middle", shelf.name, (0.0, 0.0, 0.003), width=0.16)
            for shelf in self.shelves
        )

    @property
    def drying(self) -> Drying:
        """How dry its air is."""
        return Drying(f"{self.name}_humidity", self.door, self.gel)

    @property
    def displays(self) -> tuple[Display, ...]:
        ink, paper = (20, 30, 25), (165, 185, 160)
        return (Display(f"{self.name}_display", (0.080, 0.030), self.drying, ink, paper),)

    def _forms(self) -> list[Form]:
        half, low, top = 0.170, 0.090, 0.430
        posts = [(x, y) for x in (-0.160, 0.160) for y in (-0.160, 0.160)]
        return [
            *feet(0.34, 0.34, 0.012),
            Block((-half, half), (-half, half), (0.010, 0.022), "anthracite"),
            Block((-half, half), (-half, -0.158), (0.020, 0.080), "anthracite"),
            Block((-half, half), (0.158, half), (0.020, 0.080), "anthracite"),
            Block((0.158, half), (-half, half), (0.020, 0.080), "anthracite"),
            Block((-half, half), (-half, half), (0.078, low), "anthracite"),
            Block((-half, half), (-half, half), (top, 0.480), "anthracite", edge=0.006),
            *(
                Block((x - 0.008, x + 0.008), (y - 0.008, y + 0.008), (low, top), "anthracite")
                for x, y in posts
            ),
            *(
                Block((-0.152, 0.152), (y - 0.002, y + 0.002), (low, top), "glass", 0.0)
                for y in (-0.162, 0.162)
            ),
            Block((0.160, 0.164), (-0.152, 0.152), (low, top), "glass", 0.0),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        material = finish(spec, self.name, "steel")
        for shelf, place, z in zip(self.shelves, self.places, (0.13, 0.23, 0.33), strict=True):
            shelf.add_to(body, (0.290, 0.300), (0.0, 0.0, z), material)
            place.add_to(spec.body(shelf.name))
        leaf = self.door.add_to(
            spec, body, (-0.171, 0.170, 0.093), ajar=0.0, friction=0.2, damping=0.4
        )
        tall, wide = 0.334, 0.340
        skin: list[Form] = [
            Block((-0.010, -0.006), (-wide + 0.02, -0.02), (0.02, tall - 0.02), "glass", 0.0),
            Block((-0.014, 0.0), (-wide, 0.0), (0.0, 0.022), "anthracite"),
            Block((-0.014, 0.0), (-wide, 0.0), (tall - 0.022, tall), "anthracite"),
            Block((-0.014, 0.0), (-wide, -wide + 0.026), (0.0, tall), "anthracite"),
            Block((-0.014, 0.0), (-0.022, 0.0), (0.0, tall), "anthracite"),
        ]
        assemble(spec, leaf, self.name, skin, mass=1.2)
        at = (-0.014, -wide + 0.013, tall / 2)
        self.door.handle.add_to(leaf, at, material, lying=False)
        gel = self.gel.add_to(spec, body, (0.0, 0.0, 0.024), (-1.0, 0.0, 0.0))
        forms: list[Form] = [
            *tub((-0.172, 0.140), (-0.150, 0.150), (0.0, 0.044), 0.004, "light_grey"),
            Block((-0.166, 0.134), (-0.144, 0.144), (0.004, 0.034), "blue", 0.0),
            Block((-0.190, -0.170), (-0.040, 0.040), (0.018, 0.030), "anthracite"),
        ]
        assemble(spec, gel, self.name, forms, mass=1.0)
        self.displays[0].add_to(spec, body, (-0.1705, 0.0, 0.455), ON_FRONT)
