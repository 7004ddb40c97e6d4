"""A laboratory stool."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Form, Ring, Rod, Turned
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.swivel import Swivel


@dataclass(frozen=True)
class Stool(Swivel):
    """A stool on five feet: its seat turns, and goes up by 150 mm on a gas spring.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.515, 0.540, 0.456)
    mass = 7.0
    source = "seat of 350 mm, 460 to 610 mm high, foot of 560 mm, as usual; from memory"
    passive = True
    rise = 0.150

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middle of the seat."""
        return (Seat(f"{self.name}_top", self.seat.name, (0.0, 0.0, 0.055), width=0.20),)

    def _forms(self) -> list[Form]:
        forms: list[Form] = [
            Rod((0, 0, 0.055), (0, 0, 0.120), 0.080, "anthracite"),
            Rod((0, 0, 0.110), (0, 0, 0.330), 0.050, "dark_steel"),
            Ring(0.360, 0.384, (0.180, 0.204), "chrome"),
        ]
        for n in range(5):
            a = 2 * math.pi * (n + 0.5) / 5
            c, s = math.cos(a), math.sin(a)
            foot = (0.265 * c, 0.265 * s)
            forms += [
                Rod((0.02 * c, 0.02 * s, 0.090), (*foot, 0.040), 0.030, "anthracite"),
                Rod((*foot, 0.0), (*foot, 0.045), 0.036, "rubber"),
                Rod((0.02 * c, 0.02 * s, 0.192), (0.184 * c, 0.184 * s, 0.192), 0.012, "chrome"),
            ]
        return forms

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        up = (0.0, 0.0, 1.0)
        column = self.column.add_to(spec, body, (0.0, 0.0, 0.200), up, balanced=True)
        assemble(spec, column, self.name, [Rod((0, 0, 0), (0, 0, 0.200), 0.030, "chrome")], 0.8)
        seat = self.seat.add_to(spec, column, (0.0, 0.0, 0.201), up, balanced=True)
        cushion = ((0.0, 0.010), (0.150, 0.010), (0.175, 0.022), (0.175, 0.040), (0.160, 0.055))
        forms: list[Form] = [
            Rod((0, 0, 0), (0, 0, 0.012), 0.160, "anthracite"),
            Turned((*cushion, (0.0, 0.055)), "petrol", edge=0.006),
            Rod((0.04, 0.0, 0.004), (0.04, -0.185, -0.010), 0.010, "black"),
        ]
        assemble(spec, seat, self.name, forms, mass=2.2)
        self.places[0].add_to(seat)
