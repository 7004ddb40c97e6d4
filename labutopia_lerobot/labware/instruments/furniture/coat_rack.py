"""A stand for laboratory coats."""

import math
from dataclasses import dataclass

from labutopia_lerobot.labware.parts.form import Form, Prism, Rod, Turned
from labutopia_lerobot.labware.parts.instrument import Instrument


@dataclass(frozen=True)
class CoatRack(Instrument):
    """A pole with hooks; two laboratory coats hang on it.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.400, 0.510, 1.800)
    mass = 9.0
    source = "a pole of 1800 mm on a plate of 400 mm with two coats, as usual; from memory"
    movable = True
    passive = True

    def _forms(self) -> list[Form]:
        hooks: list[Form] = []
        for n in range(4):
            c, s = math.cos(math.pi * n / 2), math.sin(math.pi * n / 2)
            tip = (0.13 * c, 0.13 * s, 1.74)
            hooks.append(Rod((0.01 * c, 0.01 * s, 1.68), tip, 0.014, "dark_steel", segments=10))
        coat = ((-0.02, 0.62), (0.16, 0.62), (0.13, 1.45), (0.09, 1.66), (0.05, 1.66), (0.01, 1.45))
        back = tuple((-x, z) for x, z in reversed(coat))
        sleeve = ((0.045, 0.0), (0.055, 0.30), (0.045, 0.60), (0.0, 0.62))
        down = (0.0, 0.0, -1.0)
        return [
            Turned(((0.20, 0.0), (0.20, 0.012), (0.03, 0.030)), "dark_steel"),
            Rod((0, 0, 0.01), (0, 0, 1.79), 0.035, "dark_steel"),
            Turned(((0.0, -0.025), (0.022, -0.012), (0.022, 0.0)), "dark_steel", (0, 0, 1.80)),
            *hooks,
            Prism(coat, (-0.19, 0.19), "cloth", 0.03, touch=False),
            Prism(back, (-0.19, 0.19), "light_blue", 0.03, touch=False),
            *(
                Turned(sleeve, look, (x, y, 1.56), down, touch=False, segments=16)
                for look, x in (("cloth", 0.08), ("light_blue", -0.08))
                for y in (-0.20, 0.20)
            ),
        ]
