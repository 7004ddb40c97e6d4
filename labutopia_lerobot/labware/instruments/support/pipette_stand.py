"""A carousel for six pipettes."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import (
    Block,
    Form,
    Turned,
    about,
)
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.rotor import Rotor


@dataclass(frozen=True)
class PipetteStand(Instrument):
    """A round stand whose six hooks turn about its column.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.200, 0.200, 0.330)
    mass = 1.1
    source = "200 mm across, 330 mm high, 6 hooks, as usual; from memory"
    movable = True

    @property
    def carousel(self) -> Rotor:
        return Rotor(f"{self.name}_carousel", friction=0.02, effort=0.2)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.carousel,)

    def _forms(self) -> list[Form]:
        return [
            Turned(
                ((0, 0), (0.098, 0), (0.100, 0.004), (0.094, 0.014), (0.030, 0.022), (0, 0.022)),
                "anthracite",
                edge=0.002,
            ),
            Turned(((0.014, 0.022), (0.011, 0.050), (0.011, 0.270)), "chrome"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        top = self.carousel.add_to(spec, body, (0.0, 0.0, 0.272))
        forms: list[Form] = [
            Turned(
                ((0, 0), (0.060, 0), (0.066, 0.006), (0.066, 0.016), (0, 0.020)),
                "white",
                edge=0.003,
            ),
            Turned(
                ((0.008, 0.020), (0.008, 0.040), (0.014, 0.046), (0.014, 0.056), (0, 0.058)),
                "petrol",
            ),
        ]
        for n in range(6):
            a = 2 * math.pi * n / 6
            turn, c, s = about((0, 0, 1), math.degrees(a)), math.cos(a), math.sin(a)
            for side in (-1, 1):
                x, y = 0.078 * c - side * 0.011 * s, 0.078 * s + side * 0.011 * c
                forms.append(
                    Block(
                        (x - 0.014, x + 0.014),
                        (y - 0.003, y + 0.003),
                        (0.002, 0.012),
                        "petrol",
                        0.002,
                        turn,
                    )
                )
        assemble(spec, top, self.name, forms, mass=0.25)
