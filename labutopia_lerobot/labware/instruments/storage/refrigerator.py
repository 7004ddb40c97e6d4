"""A laboratory refrigerator over a freezer."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.form import (
    Block,
    Form,
)
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.shelf import Shelf
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.processes import DoorGap, Process

_DEPTH, _WIDTH, _HEIGHT = 0.650, 0.600, 1.900
_WALL, _LEAF = 0.050, 0.055
"""Thickness of walls and of doors [m]."""
_SPLIT, _FOOT = 0.620, 0.060
"""Height of the wall between freezer and refrigerator, and of the plinth [m]."""


@dataclass(frozen=True)
class Refrigerator(Instrument):
    """A refrigerator with three shelves over a freezer with one; both doors are hinged on the left.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.708, 0.600, 1.900)
    mass = 85.0
    source = "600 x 650 x 1900 mm without handles, 300 l, as usual; from memory"

    @property
    def upper(self) -> Door[Handle]:
        """The door of the refrigerator."""
        return self._door("upper", 0.40)

    @property
    def lower(self) -> Door[Handle]:
        """The door of the freezer."""
        return self._door("lower", 0.25)

    def _door(self, part: str, handle: float) -> Door[Handle]:
        name = f"{self.name}_{part}"
        grip = Handle(f"{name}_handle", handle, diameter=0.020)
        return Door(f"{name}_door", grip, math.radians(110.0), closed_within=math.radians(0.3))

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.upper, self.lower

    @property
    def shelves(self) -> tuple[Shelf, ...]:
        """Shelves from below: in the freezer, then in the refrigerator."""
        return tuple(Shelf(f"{self.name}_shelf_{n}") for n in range(4))

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middles of the shelves, from below."""
        return tuple(
            Seat(f"{shelf.name}_middle", shelf.name, (0.0, 0.0, 0.003), width=0.20)
            for shelf in self.shelves
        )

    @property
    def works(self) -> tuple[Process, ...]:
        """Its freezer at -18 degrees, and its upper room at 4, each with 150 W of cold, usual.

        Their leaks are ours.
        """
        x, y = _DEPTH / 2, _WIDTH / 2 - _WALL
        rooms: list[Process] = []
        for door, bottom, top, celsius, called in (
            (self.lower, _FOOT + _WALL, _SPLIT, -18.0, f"{self.name}_freezer"),
            (self.upper, _SPLIT + 0.06, _HEIGHT - _WALL, 4.0, self.name),
        ):
            low, high = (-x + _LEAF, -y, bottom), (x - _WALL, y, top)
            gap = DoorGap(door.joint, 2 * y * (top - bottom), top - bottom)
            by = Regulated(-150.0, celsius, begins=celsius, resolution=0.1, warning="DOOR OPEN")
            rooms += chamber(self.name, low, high, 1.5, gap, by, called)
        return tuple(rooms)

    @property
    def displays(self) -> tuple[Display, ...]:
        return (Display(f"{self.name}_display", (0.110, 0.040), self.works[-1]),)

    def _forms(self) -> list[Form]:
        back, front, y = _DEPTH / 2, -_DEPTH / 2 + _LEAF, _WIDTH / 2
        return [
            Block((front, back), (y - _WALL, y), (_FOOT, _HEIGHT), "white"),
            Block((front, back), (-y, -y + _WALL), (_FOOT, _HEIGHT), "white"),
            Block((back - _WALL, back), (-y + 0.01, y - 0.01), (_FOOT, _HEIGHT), "white"),
            *(
                Block((front, back - 0.01), (-y + 0.01, y - 0.01), (z, z + t), "white")
                for z, t in ((_FOOT, _WALL), (_SPLIT, 0.06), (_HEIGHT - _WALL, _WALL))
            ),
            Block((front + 0.04, back - 0.03), (-y + 0.02, y - 0.02), (0.0, _FOOT), "anthracite"),
            Block(
                (0.0, 0.20),
                (-0.10, 0.10),
                (_HEIGHT - _WALL - 0.003, _HEIGHT - _WALL),
                "glow",
                0.0,
                touch=False,
            ),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        front, wide = -_DEPTH / 2 + _LEAF, _WIDTH - 2 * _WALL - 0.01
        for shelf, place, z in zip(
            self.shelves, self.places, (0.36, 0.90, 1.20, 1.50), strict=True
        ):
            finish(spec, self.name, "glass_edge")
            shelf.add_to(body, (0.44, wide), (0.04, 0.0, z), f"{self.name}_glass_edge")
            place.add_to(spec.body(shelf.name))
        for door, low, high in ((self.lower, _FOOT, 0.645), (self.upper, 0.655, _HEIGHT)):
            pos, tall = (front, _WIDTH / 2, low), high - low
            leaf = door.add_to(spec, body, pos, ajar=0.0, friction=0.5, damping=1.0)
            skin: list[Form] = [
                Block((-_LEAF, -0.004), (-_WIDTH, 0.0), (0.0, tall), "white", edge=0.010),
                Block((-0.005, 0.0), (-_WIDTH + 0.02, -0.02), (0.02, tall - 0.02), "grey", 0.002),
            ]
            assemble(spec, leaf, self.name, skin, mass=12.0)
            finish(spec, self.name, "steel")
            at = (-_LEAF, -_WIDTH + 0.05, tall / 2)
            door.handle.add_to(leaf, at, f"{self.name}_steel", lying=False)
            if door == self.upper:
                self.displays[0].add_to(spec, leaf, (-_LEAF - 0.001, -0.30, tall - 0.10), ON_FRONT)
