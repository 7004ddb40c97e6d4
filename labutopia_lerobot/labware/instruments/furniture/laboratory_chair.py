"""A swivel chair."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, about
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.swivel import Swivel


@dataclass(frozen=True)
class LaboratoryChair(Swivel):
    """A chair on a gas spring: its seat, with the back, turns and goes up; it looks to -x.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.510, 0.520, 0.925)
    mass = 11.0
    source = "seat from 460 mm up, back to 930 mm (EN 1335-1 office chairs are alike); from memory"
    passive = True
    rise = 0.120

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middle of the seat."""
        return (Seat(f"{self.name}_top", self.seat.name, (0.0, 0.0, 0.090), width=0.24),)

    def _forms(self) -> list[Form]:
        forms: list[Form] = [
            Rod((0, 0, 0.060), (0, 0, 0.130), 0.080, "anthracite"),
            Rod((0, 0, 0.120), (0, 0, 0.280), 0.050, "dark_steel"),
        ]
        for n in range(5):
            a = 2 * math.pi * n / 5
            c, s = math.cos(a), math.sin(a)
            foot = (0.250 * c, 0.250 * s)
            forms += [
                Rod((0.02 * c, 0.02 * s, 0.095), (*foot, 0.060), 0.032, "anthracite", segments=12),
                Rod((*foot, 0.0), (*foot, 0.055), 0.045, "rubber", segments=12),
            ]
        return forms

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        up = (0.0, 0.0, 1.0)
        column = self.column.add_to(spec, body, (0.0, 0.0, 0.180), up, balanced=True)
        assemble(spec, column, self.name, [Rod((0, 0, 0), (0, 0, 0.190), 0.030, "chrome")], 0.8)
        seat = self.seat.add_to(spec, column, (0.0, 0.0, 0.191), up, balanced=True)
        lean = about((0.0, 1.0, 0.0), 6.0)
        forms: list[Form] = [
            Rod((0, 0, 0), (0, 0, 0.030), 0.180, "anthracite"),
            Block((-0.23, 0.21), (-0.23, 0.23), (0.030, 0.090), "blue", edge=0.025),
            Block((0.10, 0.255), (-0.03, 0.03), (0.008, 0.030), "anthracite"),
            Rod((0.245, 0.0, 0.010), (0.262, 0.0, 0.330), 0.028, "anthracite"),
            Block((0.210, 0.255), (-0.20, 0.20), (0.220, 0.555), "blue", 0.020, lean),
        ]
        assemble(spec, seat, self.name, forms, mass=5.0)
        self.places[0].add_to(seat)
