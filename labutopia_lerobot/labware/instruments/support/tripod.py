"""A tripod with a wire gauze."""

import math
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.form import (
    Block,
    Form,
    Ring,
    Rod,
)
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.seat import Seat


@dataclass(frozen=True)
class Tripod(Instrument):
    """An iron tripod with a gauze on it, to stand over a burner.

    Attributes:
        name: Name of its body; prefix of all its elements.
    """

    name: str
    size = (0.157, 0.166, 0.221)
    mass = 0.55
    source = (
        "ring of 120 mm, 220 mm high, gauze of 150 mm with ceramic centre, as usual; from memory"
    )
    movable = True
    passive = True

    @property
    def gauze(self) -> Seat:
        """The ceramic centre of the gauze."""
        return Seat(f"{self.name}_gauze", self.name, (0.0, 0.0, 0.2215), width=0.100)

    @property
    def places(self) -> tuple[Seat, ...]:
        return (self.gauze,)

    def _forms(self) -> list[Form]:
        legs: list[Form] = []
        for n in range(3):
            a = math.pi / 6 + 2 * math.pi * n / 3
            x, y = math.cos(a), math.sin(a)
            legs.append(
                Rod(
                    (0.056 * x, 0.056 * y, 0.214),
                    (0.084 * x, 0.084 * y, 0.003),
                    0.008,
                    "dark_steel",
                )
            )
            legs.append(
                Rod((0.084 * x, 0.084 * y, 0.0), (0.084 * x, 0.084 * y, 0.006), 0.012, "rubber")
            )
        wires: list[Form] = []
        for n in range(-7, 8):
            p = 0.0095 * n
            wires.append(
                Block(
                    (p - 0.0006, p + 0.0006),
                    (-0.074, 0.074),
                    (0.2195, 0.2207),
                    "steel",
                    0.0,
                    touch=False,
                )
            )
            wires.append(
                Block(
                    (-0.074, 0.074),
                    (p - 0.0006, p + 0.0006),
                    (0.2195, 0.2207),
                    "steel",
                    0.0,
                    touch=False,
                )
            )
        return [
            Ring(0.104, 0.120, (0.212, 0.219), "dark_steel"),
            *legs,
            *wires,
            Rod((0, 0, 0.219), (0, 0, 0.2215), 0.100, "ceramic"),
            *(
                Block(
                    (a * 0.075 - 0.001, a * 0.075 + 0.001),
                    (-0.076, 0.076),
                    (0.219, 0.221),
                    "steel",
                    0.0,
                )
                for a in (-1, 1)
            ),
            *(
                Block(
                    (-0.076, 0.076),
                    (a * 0.075 - 0.001, a * 0.075 + 0.001),
                    (0.219, 0.221),
                    "steel",
                    0.0,
                )
                for a in (-1, 1)
            ),
        ]
