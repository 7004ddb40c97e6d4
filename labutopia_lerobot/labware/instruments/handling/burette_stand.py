"""A 50 ml burette on its stand."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.valve import Tap

_X, _Y = -0.045, 0.0
"""Position of the burette [m]."""
_TAP = 0.215
"""Height of its stopcock [m]."""


@dataclass(frozen=True)
class BuretteStand(Instrument):
    """A burette with a stopcock in a double clamp, over a white base.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.270, 0.160, 0.920)
    mass = 2.4
    source = "burette of 50 ml, 14 x 750 mm (ISO 385), stand of 160 x 270 mm; from memory"

    @property
    def stopcock(self) -> Tap:
        return Tap(f"{self.name}_stopcock", length=0.034, look="green", standoff=0.012)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.stopcock,)

    @property
    def under(self) -> Seat:
        """Place of the flask, under the tip."""
        return Seat(f"{self.name}_base", self.name, (_X, _Y, 0.016), width=0.090)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.under,)

    def _forms(self) -> list[Form]:
        marks: list[Form] = []
        for n in range(51):
            length = 0.9 if n % 10 == 0 else 0.6 if n % 5 == 0 else 0.35
            z = 0.850 - 0.0112 * n
            half = 0.0068 * length
            marks.append(
                Block(
                    (_X - 0.0072, _X - 0.0069),
                    (_Y - half, _Y + half),
                    (z, z + 0.0009),
                    "blue",
                    0.0,
                    touch=False,
                )
            )
        return [
            Block((-0.135, 0.135), (-0.080, 0.080), (0.004, 0.016), "ceramic", edge=0.003),
            *feet(0.250, 0.150, 0.005),
            Rod((0.060, 0, 0.016), (0.060, 0, 0.740), 0.012, "chrome"),
            Rod((_X, _Y, _TAP + 0.015), (_X, _Y, 0.920), 0.014, "glass"),
            Rod((_X, _Y, _TAP + 0.030), (_X, _Y, 0.820), 0.011, "water", touch=False),
            *marks,
            Rod((_X, _Y, _TAP - 0.015), (_X, _Y, _TAP + 0.016), 0.010, "glass_edge"),
            Rod((_X, _Y - 0.014, _TAP), (_X, _Y + 0.014, _TAP), 0.014, "glass_edge"),
            Turned(
                ((0.001, 0.0), (0.003, 0.030), (0.0045, 0.045)),
                "glass_edge",
                (_X, _Y, _TAP - 0.060),
            ),
            *(
                Block((_X + 0.005, 0.066), (-0.012, 0.012), (z, z + 0.016), "light_grey")
                for z in (0.420, 0.640)
            ),
            *(
                Block(
                    (_X - 0.010, _X + 0.008),
                    (side * 0.011 - 0.003, side * 0.011 + 0.003),
                    (z - 0.002, z + 0.018),
                    "red",
                    0.001,
                )
                for z in (0.420, 0.640)
                for side in (-1, 1)
            ),
            *(
                Rod((0.060, 0.010, z + 0.008), (0.060, 0.034, z + 0.008), 0.014, "black")
                for z in (0.420, 0.640)
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        self.stopcock.add_to(
            spec,
            self.name,
            body,
            (_X, _Y - 0.014, _TAP),
            (math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0),
        )
