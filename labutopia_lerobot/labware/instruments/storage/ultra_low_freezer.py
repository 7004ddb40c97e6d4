"""A chest freezer for -80 degrees."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.fittings import tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.processes import DoorGap, Process


@dataclass(frozen=True)
class UltraLowFreezer(Instrument):
    """A chest freezer at -80 degrees: its lid opens upwards, its baskets are lifted out.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.770, 1.000, 0.967)
    mass = 95.0
    source = "1000 x 700 x 950 mm without what stands out, 230 l, as usual; from memory"

    @property
    def lid(self) -> Lid:
        return Lid(f"{self.name}_lid", math.radians(80.0), reach=0.660, friction=4.0)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def baskets(self) -> tuple[Slide, ...]:
        """Baskets from left to right; each is lifted by its handle, in guides."""
        return tuple(
            Slide(f"{self.name}_{side}_basket", 0.300, friction=6.0, effort=40.0)
            for side in ("left", "right")
        )

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.lid, *self.baskets, self.power

    @property
    def places(self) -> tuple[Seat, ...]:
        """The floors of the baskets."""
        return tuple(
            Seat(f"{basket.name}_floor", basket.name, (0.0, 0.0, 0.004), width=0.16)
            for basket in self.baskets
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its inside at -80 degrees: 600 W of cold, usual; leak ours. It is never switched off.

        Cold air stays in a chest: its lid lets out a tenth of what a door would, ours.
        """
        low, high = (-0.23, -0.38, 0.21), (0.23, 0.38, 0.86)
        gap = DoorGap(self.lid.joint, 0.35, 0.46, share=0.1)
        by = Regulated(-600.0, -80.0, begins=-80.0, resolution=0.1, warning="LID OPEN")
        return chamber(self.name, low, high, 1.0, gap, by)

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_display", (0.130, 0.044), self.works[-1], ink=(110, 190, 255)),
        )

    def _forms(self) -> list[Form]:
        x, y, wall, low, top = 0.350, 0.500, 0.120, 0.090, 0.860
        castors: list[Form] = []
        for i in (-0.27, 0.27):
            for j in (-0.42, 0.42):
                castors += [
                    Rod((i, j - 0.015, 0.035), (i, j + 0.015, 0.035), 0.070, "rubber"),
                    Rod((i, j, 0.035), (i, j, low), 0.026, "steel"),
                ]
        return [
            *tub((-x, x), (-y, y), (low, top), wall, "white", "steel", edge=0.012),
            *tub(
                (-x + wall - 0.004, x - wall + 0.004),
                (-y + wall - 0.004, y - wall + 0.004),
                (low + wall - 0.01, top + 0.004),
                0.006,
                "steel",
            ),
            Block((-x - 0.004, -x + 0.01), (-0.45, 0.45), (0.14, 0.34), "anthracite"),
            *(
                Block((-x - 0.006, -x), (-0.42, 0.05), (z, z + 0.010), "grey", 0.0, touch=False)
                for z in (0.17, 0.20, 0.23, 0.26, 0.29)
            ),
            Block((x - 0.02, x + 0.008), (-0.30, 0.30), (0.76, 0.88), "grey"),
            *castors,
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        front = -0.3543
        self.power.add_to(spec, self.name, body, (front, 0.12, 0.24), ON_FRONT)
        self.displays[0].add_to(spec, body, (front - 0.0003, 0.30, 0.24), ON_FRONT)
        up = (0.0, 0.0, 1.0)
        for basket, y in zip(self.baskets, (0.17, -0.17), strict=True):
            bin_ = basket.add_to(spec, body, (0.0, y, 0.230), up, balanced=True)
            wires: list[Form] = [
                *tub((-0.200, 0.200), (-0.150, 0.150), (0.0, 0.300), 0.004, "light_blue"),
                Rod((0.0, -0.150, 0.420), (0.0, 0.150, 0.420), 0.014, "steel"),
                Rod((0.0, -0.147, 0.290), (0.0, -0.147, 0.425), 0.010, "steel"),
                Rod((0.0, 0.147, 0.290), (0.0, 0.147, 0.425), 0.010, "steel"),
            ]
            assemble(spec, bin_, self.name, wires, mass=2.0)
        for place, basket in zip(self.places, self.baskets, strict=True):
            place.add_to(spec.body(basket.name))
        lid = self.lid.add_to(spec, body, (0.330, 0.0, 0.882))
        cover: list[Form] = [
            Block((-0.680, 0.0), (-0.500, 0.500), (0.0, 0.085), "white", edge=0.014),
            Block((-0.670, -0.010), (-0.490, 0.490), (-0.014, 0.002), "grey", 0.002),
            Rod((-0.730, -0.14, 0.040), (-0.730, 0.14, 0.040), 0.024, "anthracite"),
            Block((-0.735, -0.670), (-0.14, -0.12), (0.028, 0.052), "anthracite"),
            Block((-0.735, -0.670), (0.12, 0.14), (0.028, 0.052), "anthracite"),
        ]
        assemble(spec, lid, self.name, cover, mass=14.0)
