"""A cupboard for reagents that stands over the bench top."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.mouth import Mouth
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.shelf import Shelf

_DEEP, _WIDE, _BOTTOM, _TOP = 0.200, 0.280, 0.300, 0.800
"""Half its depth and width, and from where to where the box reaches [m]."""
_BOARD = 0.018
"""Thickness of its boards [m]."""
_SHELF = 0.340
"""Height of the middle of its shelf above the bench [m]."""
_INSET = 0.040
"""Distance from the door's free edge to the bar [m]."""


@dataclass(frozen=True)
class ReagentCupboard(Instrument):
    """A cupboard on four legs: one shelf behind a glazed door, hinged on the left.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.475, 0.560, 0.800)
    mass = 16.0
    source = "ours: shelf and handle as high as those of the drying oven of level 4"
    passive = True

    @property
    def door(self) -> Door[Handle]:
        handle = Handle(f"{self.name}_handle", 0.20)
        return Door(f"{self.name}_door", handle, math.radians(120.0), math.radians(0.3))

    @property
    def shelf(self) -> Shelf:
        """Where its bottles stand."""
        return Shelf(f"{self.name}_shelf")

    @property
    def shelf_height(self) -> float:
        """Height of its top above the bench [m]."""
        return _SHELF + 0.003

    @property
    def opening(self) -> Mouth:
        """Its doorway."""
        return Mouth(self.shelf.name, (-0.262, -0.08, 0.0), ahead=(0.585, 0.625))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return (self.door,)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middle of its shelf."""
        return (Seat(f"{self.shelf.name}_middle", self.shelf.name, (0.0, 0.0, 0.003), 0.25),)

    def _forms(self) -> list[Form]:
        x, y, low, high = _DEEP, _WIDE, _BOTTOM, _TOP
        legs = [(a * (x - 0.015), b * (y - 0.015)) for a in (-1, 1) for b in (-1, 1)]
        return [
            *(
                Block((u - 0.015, u + 0.015), (v - 0.015, v + 0.015), (0.0, low), "dark_steel")
                for u, v in legs
            ),
            Block((-x, x), (-y, y), (low, low + _BOARD), "white"),
            Block((-x, x), (-y, y), (high - _BOARD, high), "white"),
            Block((-x, x), (-y, -y + _BOARD), (low, high), "white"),
            Block((-x, x), (y - _BOARD, y), (low, high), "white"),
            Block((x - _BOARD, x), (-y, y), (low, high), "white"),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        steel = finish(spec, self.name, "steel")
        plate = (2 * (_DEEP - _BOARD), 2 * (_WIDE - _BOARD) - 0.002)
        self.shelf.add_to(body, plate, (-_BOARD / 2, 0.0, _SHELF), steel)
        self.places[0].add_to(spec.body(self.shelf.name))
        leaf = self.door.add_to(
            spec, body, (-_DEEP - 0.001, _WIDE, _BOTTOM), ajar=0.0, friction=0.4, damping=0.8
        )
        wide, tall, rim, thick = 2 * _WIDE, _TOP - _BOTTOM, 0.080, 0.020
        skin: list[Form] = [
            Block((-thick, 0.0), (-wide, 0.0), (0.0, rim), "light_blue"),
            Block((-thick, 0.0), (-wide, 0.0), (tall - rim, tall), "light_blue"),
            Block((-thick, 0.0), (-wide, -wide + rim), (rim, tall - rim), "light_blue"),
            Block((-thick, 0.0), (-rim, 0.0), (rim, tall - rim), "light_blue"),
            Block((-0.012, -0.008), (-wide + rim, -rim), (rim, tall - rim), "glass", 0.0),
        ]
        assemble(spec, leaf, self.name, skin, mass=4.0)
        spot = (-thick, -wide + _INSET, 0.45 * tall)
        self.door.handle.add_to(leaf, spot, steel, lying=False)
