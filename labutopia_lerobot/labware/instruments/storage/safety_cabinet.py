"""A cabinet for flammable liquids."""

import math
from dataclasses import dataclass
from typing import Literal

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.fittings import tub
from labutopia_lerobot.labware.parts.form import Block, Form, Turned, about
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.shelf import Shelf

_DEPTH, _WIDTH, _HEIGHT = 0.550, 0.900, 1.950
_WALL, _LEAF, _FOOT = 0.050, 0.045, 0.080
"""Thickness of walls and of wings, height of the plinth [m]."""


@dataclass(frozen=True)
class SafetyCabinet(Instrument):
    """A yellow cabinet for flammable liquids: two wings before three shelves and a sump.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.597, 0.900, 1.950)
    mass = 120.0
    source = "900 x 550 x 1950 mm without its handles (EN 14470-1 cabinets are alike); from memory"
    passive = True

    @property
    def wings(self) -> tuple[Door[Handle], Door[Handle]]:
        """The left and the right one."""
        sides: tuple[Literal["left"], Literal["right"]] = ("left", "right")
        widest, shut = math.radians(100.0), math.radians(0.3)
        left, right = (
            Door(f"{self.name}_{side}_wing", self._handle(side), widest, shut, hinge=side)
            for side in sides
        )
        return left, right

    def _handle(self, side: str) -> Handle:
        return Handle(f"{self.name}_{side}_handle", 0.200, diameter=0.018, standoff=0.037)

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.wings

    @property
    def shelves(self) -> tuple[Shelf, ...]:
        """Shelves from below."""
        return tuple(Shelf(f"{self.name}_shelf_{n}") for n in range(3))

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middles of the shelves, from below."""
        return tuple(
            Seat(f"{shelf.name}_middle", shelf.name, (0.0, 0.0, 0.003), width=0.20)
            for shelf in self.shelves
        )

    def _forms(self) -> list[Form]:
        back, front, y = _DEPTH / 2, -_DEPTH / 2 + _LEAF, _WIDTH / 2
        return [
            Block((front + 0.03, back - 0.02), (-y + 0.02, y - 0.02), (0.0, _FOOT), "anthracite"),
            Block((front, back), (y - _WALL, y), (_FOOT, _HEIGHT), "yellow"),
            Block((front, back), (-y, -y + _WALL), (_FOOT, _HEIGHT), "yellow"),
            Block((back - _WALL, back), (-y + 0.01, y - 0.01), (_FOOT, _HEIGHT), "light_grey"),
            *(
                Block((front, back - 0.01), (-y + 0.01, y - 0.01), (z, z + _WALL), "yellow")
                for z in (_FOOT, _HEIGHT - _WALL)
            ),
            *tub(
                (front + 0.01, back - _WALL),
                (-y + _WALL + 0.005, y - _WALL - 0.005),
                (_FOOT + _WALL, _FOOT + 0.13),
                0.004,
                "dark_steel",
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        front, y = -_DEPTH / 2 + _LEAF, _WIDTH / 2
        material = finish(spec, self.name, "steel")
        for shelf, place, z in zip(self.shelves, self.places, (0.45, 0.90, 1.35), strict=True):
            shelf.add_to(body, (0.40, 0.78), (0.02, 0.0, z), material)
            place.add_to(spec.body(shelf.name))
        tall, wide = _HEIGHT - _FOOT - 0.004, y - 0.002
        for wing, side in zip(self.wings, (1, -1), strict=True):
            hinge = (front - 0.001, side * y, _FOOT + 0.002)
            leaf = wing.add_to(spec, body, hinge, ajar=0.0, friction=0.6, damping=0.6)

            def across(near: float, far: float, side: int = side) -> tuple[float, float]:
                return min(-side * near, -side * far), max(-side * near, -side * far)

            bar = -side * (wide - 0.05)
            skin: list[Form] = [
                Block((-_LEAF, -0.003), across(0.0, wide), (0.0, tall), "yellow", edge=0.008),
                Block((-0.004, 0.0), across(0.06, wide - 0.03), (0.06, tall - 0.06), "grey", 0.001),
            ]
            if side > 0:  # the sign of flammable substances
                skin += _warning(-wide / 2, tall - 0.35)
            assemble(spec, leaf, self.name, skin, mass=18.0)
            black = finish(spec, self.name, "black")
            wing.handle.add_to(leaf, (-_LEAF, bar, 0.96), black, lying=False)


def _warning(y: float, z: float) -> list[Form]:
    """Return a square on its corner with a flame in it, on the front of a wing."""
    turn, x = about((1.0, 0.0, 0.0), 45.0), -_LEAF
    return [
        Block((x - 0.0010, x), (y - 0.08, y + 0.08), (z - 0.08, z + 0.08), "red", 0.0, turn, False),
        Block(
            (x - 0.0016, x),
            (y - 0.068, y + 0.068),
            (z - 0.068, z + 0.068),
            "white",
            0.0,
            turn,
            False,
        ),
        Turned(
            ((0.0, -0.030), (0.020, -0.022), (0.026, 0.0), (0.014, 0.024), (0.0, 0.052)),
            "black",
            (x, y, z),
            edge=0.0,
            touch=False,
            segments=4,
        ),
        Block(
            (x - 0.0030, x),
            (y - 0.030, y + 0.030),
            (z - 0.040, z - 0.034),
            "black",
            0.0,
            touch=False,
        ),
    ]
