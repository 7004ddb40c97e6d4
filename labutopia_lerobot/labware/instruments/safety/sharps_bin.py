"""A sharps bin with a flap."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.fittings import tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.lid import Lid
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.seat import Seat


@dataclass(frozen=True)
class SharpsBin(Instrument):
    """A yellow bin for needles and broken glass; its flap opens up and back.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.200, 0.220, 0.233)
    mass = 0.5
    source = "200 x 220 x 230 mm, 7 l (ISO 23907 bins are alike); from memory"
    movable = True
    passive = True

    @property
    def flap(self) -> Lid:
        return Lid(f"{self.name}_flap", math.radians(100.0), reach=0.090, friction=0.02)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.flap,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The bottom, below the flap."""
        return (Seat(f"{self.name}_bottom", self.name, (-0.02, 0.0, 0.004), width=0.10),)

    def _forms(self) -> list[Form]:
        rim = (0.216, 0.226)
        return [
            *tub((-0.095, 0.095), (-0.105, 0.105), (0.0, 0.220), 0.004, "yellow", edge=0.003),
            Block((0.024, 0.100), (-0.110, 0.110), rim, "red"),
            Block((-0.100, -0.062), (-0.110, 0.110), rim, "red"),
            Block((-0.064, 0.026), (-0.110, -0.062), rim, "red"),
            Block((-0.064, 0.026), (0.062, 0.110), rim, "red"),
            Block((-0.0962, -0.095), (-0.060, 0.060), (0.040, 0.160), "white", 0.0, touch=False),
            *(
                Rod((-0.0970, y, z), (-0.0955, y, z), 0.036, "red", touch=False)
                for y, z in ((0.0, 0.122), (-0.022, 0.084), (0.022, 0.084))
            ),
            Rod((-0.0974, 0, 0.098), (-0.0955, 0, 0.098), 0.030, "white", touch=False),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        flap = self.flap.add_to(spec, body, (0.030, 0.0, 0.227))
        forms: list[Form] = [
            Block((-0.098, 0.0), (-0.068, 0.068), (0.0, 0.005), "red", edge=0.002),
            Block((-0.110, -0.090), (-0.015, 0.015), (0.001, 0.006), "red", edge=0.002),
        ]
        assemble(spec, flap, self.name, forms, mass=0.06)
