"""A carousel for six pipettes."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.instruments.handling.piston_pipette import PistonPipette
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
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world.model import COLLISION_GROUP

_HOOKS = 6
_CAROUSEL = 0.272
"""Height of the carousel [m]."""
_REACH, _APART = 0.081, 0.0165
"""From the axis to the middle of a hook, and from there to either prong's [m]: a pipette's body of
24 mm goes in between."""
_PRONG = (0.002, 0.012)
"""Underside and top of the prongs above the carousel's origin [m]."""


@dataclass(frozen=True)
class PipetteStand(Instrument):
    """A round stand whose six hooks turn about its column; lips keep a pipette on its prongs.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.200, 0.200, 0.330)
    mass = 1.1
    source = "200 mm across, 330 mm high, 6 hooks, as usual; from memory"
    movable = True
    passive = True

    @property
    def carousel(self) -> Rotor:
        return Rotor(f"{self.name}_carousel", friction=0.02, effort=0.2)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.carousel,)

    def hook(self, number: int) -> str:
        """Return the name of the frame of a hook: between its prongs, x away from the column."""
        return f"{self.name}_hook_{number}"

    @staticmethod
    def hanging(pipette: PistonPipette) -> Vector:
        """Return where the origin of a pipette is that hangs on the first hook [m]."""
        return (_REACH, 0.0, _CAROUSEL + _PRONG[1] - pipette.hangs_by)

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
        top = self.carousel.add_to(spec, body, (0.0, 0.0, _CAROUSEL))
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
        for n in range(_HOOKS):
            a = 2 * math.pi * n / _HOOKS
            turn, c, s = about((0, 0, 1), math.degrees(a)), math.cos(a), math.sin(a)
            for side in (-1, 1):
                x, y = _REACH * c - side * _APART * s, _REACH * s + side * _APART * c
                prong = Block(
                    (x - 0.016, x + 0.016), (y - 0.003, y + 0.003), _PRONG, "petrol", 0.001, turn
                )
                x, y = x + 0.0145 * c, y + 0.0145 * s
                lip = (_PRONG[1], _PRONG[1] + 0.003)
                forms += (
                    prong,
                    Block(
                        (x - 0.0015, x + 0.0015), (y - 0.003, y + 0.003), lip, "petrol", 0.001, turn
                    ),
                )
            top.add_site(
                name=self.hook(n),
                pos=(_REACH * c, _REACH * s, _PRONG[1]),
                quat=about((0, 0, 1), math.degrees(a)),
                group=COLLISION_GROUP,
            )
        assemble(spec, top, self.name, forms, mass=0.25)
