"""An incubator with an outer door and an inner door of glass."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.dials import Scale
from labutopia_lerobot.labware.parts.display import Display
from labutopia_lerobot.labware.parts.finish import finish
from labutopia_lerobot.labware.parts.fittings import feet
from labutopia_lerobot.labware.parts.form import Block, Form
from labutopia_lerobot.labware.parts.instrument import Instrument
from labutopia_lerobot.labware.parts.knob import Knob
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.openable import Door, Handle
from labutopia_lerobot.labware.parts.panel import ON_FRONT
from labutopia_lerobot.labware.parts.rocker import Rocker
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.shelf import Shelf
from labutopia_lerobot.labware.parts.warmth import Regulated, chamber
from labutopia_lerobot.processes import DoorGap, Process
from labutopia_lerobot.world import ON

_DEPTH, _WIDTH, _HEIGHT = 0.600, 0.640, 0.850
_WALL, _LEAF = 0.045, 0.045
"""Thickness of walls and of the outer door [m]."""
_FOOT, _PANEL = 0.030, 0.110
"""Height of the feet and of the panel above the door [m]."""


@dataclass(frozen=True)
class Incubator(Instrument):
    """An incubator with two shelves; one looks in through its inner door without cooling it.

    Attributes:
        name: Name of its root body; prefix of all its elements.
    """

    name: str
    size = (0.657, 0.640, 0.850)
    mass = 60.0
    source = "640 x 600 x 850 mm without its handle, 110 l, as usual; from memory"

    @property
    def door(self) -> Door[Handle]:
        handle = Handle(f"{self.name}_handle", 0.24, diameter=0.018)
        return Door(f"{self.name}_door", handle, math.radians(110.0), math.radians(0.3))

    @property
    def inner_door(self) -> Door[Handle]:
        handle = Handle(f"{self.name}_inner_handle", 0.06, diameter=0.008, standoff=0.012)
        return Door(f"{self.name}_inner_door", handle, math.radians(90.0), math.radians(0.5))

    @property
    def heat(self) -> Knob:
        return Knob(f"{self.name}_heat", diameter=0.040)

    @property
    def power(self) -> Rocker:
        return Rocker(f"{self.name}_power", look="green")

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        return self.door, self.inner_door, self.heat, self.power

    @property
    def shelves(self) -> tuple[Shelf, Shelf]:
        """The lower and the upper one."""
        return Shelf(f"{self.name}_lower_shelf"), Shelf(f"{self.name}_upper_shelf")

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middles of the shelves."""
        return tuple(
            Seat(f"{shelf.name}_middle", shelf.name, (0.0, 0.0, 0.003), width=0.20)
            for shelf in self.shelves
        )

    @property
    def warming(self) -> tuple[Process, ...]:
        """What knob and switch say, the air, the liner and the thermostat: 300 W, usual; leak ours.

        Its inner door, of glass, lets nothing through: the outer one loses by it what it does.
        """
        knob, power = (
            Scale(self.heat, 20, 70, "\u00b0C", resolution=0.1),
            Scale(self.power, 0, 1, ON),
        )
        x, y = _DEPTH / 2, _WIDTH / 2 - _WALL
        low = (-x + _LEAF, -y, _FOOT + _WALL)
        high = (x - _WALL, y, _HEIGHT - _PANEL)
        gap = DoorGap(self.inner_door.joint, 2 * y * (high[2] - low[2]), high[2] - low[2])
        by = Regulated(300.0, knob.name, power.name, resolution=0.1)
        return knob, power, *chamber(self.name, low, high, 1.2, gap, by)

    @property
    def works(self) -> tuple[Process, ...]:
        return self.warming

    @property
    def displays(self) -> tuple[Display, ...]:
        return (
            Display(f"{self.name}_display", (0.120, 0.044), self.warming[-1], ink=(255, 90, 60)),
        )

    def _forms(self) -> list[Form]:
        back, front, y = _DEPTH / 2, -_DEPTH / 2 + _LEAF, _WIDTH / 2
        top = _HEIGHT - _PANEL
        return [
            Block((front, back), (y - _WALL, y), (_FOOT, _HEIGHT - 0.01), "cream"),
            Block((front, back), (-y, -y + _WALL), (_FOOT, _HEIGHT - 0.01), "cream"),
            Block((back - _WALL, back), (-y + 0.01, y - 0.01), (_FOOT, _HEIGHT - 0.01), "steel"),
            Block((front, back - 0.01), (-y + 0.01, y - 0.01), (_FOOT, _FOOT + _WALL), "steel"),
            Block((front - _LEAF, back), (-y, y), (top, _HEIGHT), "cream", edge=0.008),
            Block(
                (front - _LEAF - 0.001, front),
                (-y + 0.02, y - 0.02),
                (top + 0.015, _HEIGHT - 0.015),
                "petrol",
                0.0,
                touch=False,
            ),
            *feet(_DEPTH - 0.05, _WIDTH, _FOOT),
        ]

    def _add_parts(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        front, y, low = -_DEPTH / 2 + _LEAF, _WIDTH / 2, _FOOT + _WALL
        steel, glass = (finish(spec, self.name, look) for look in ("steel", "glass_edge"))
        for shelf, place, z in zip(self.shelves, self.places, (0.28, 0.50), strict=True):
            shelf.add_to(body, (0.40, _WIDTH - 2 * _WALL - 0.01), (0.04, 0.0, z), steel)
            place.add_to(spec.body(shelf.name))
        top = _HEIGHT - _PANEL - 0.004
        x, z = front - _LEAF - 0.001, _HEIGHT - _PANEL / 2
        self.displays[0].add_to(spec, body, (x - 0.001, 0.10, z), ON_FRONT)
        self.heat.add_to(spec, self.name, body, (x, -0.10, z), ON_FRONT)
        self.power.add_to(spec, self.name, body, (x, -0.22, z), ON_FRONT)
        pane = self.inner_door.add_to(
            spec,
            body,
            (front + 0.040, y - _WALL - 0.009, low + 0.004),
            ajar=0.0,
            friction=0.1,
            damping=0.2,
        )
        wide, tall = _WIDTH - 2 * _WALL - 0.014, top - low - 0.004
        sheet: list[Form] = [
            Block((-0.006, 0.0), (-wide, 0.0), (0.0, tall), "glass", 0.0),
            *(
                Block(
                    (-0.007, 0.0),
                    (-wide, 0.0),
                    (a * (tall - 0.012), a * (tall - 0.012) + 0.012),
                    "glass_edge",
                    0.001,
                )
                for a in (0, 1)
            ),
        ]
        assemble(spec, pane, self.name, sheet, mass=2.5)
        self.inner_door.handle.add_to(pane, (-0.006, -wide + 0.03, tall / 2), glass, lying=False)
        leaf = self.door.add_to(spec, body, (front, y, _FOOT), ajar=0.0, friction=0.5, damping=1.0)
        high = top - _FOOT
        skin: list[Form] = [
            Block((-_LEAF, -0.004), (-_WIDTH, 0.0), (0.0, high), "cream", edge=0.010),
            Block((-0.005, 0.0), (-_WIDTH + 0.03, -0.03), (0.03, high - 0.03), "grey", 0.002),
        ]
        assemble(spec, leaf, self.name, skin, mass=8.0)
        self.door.handle.add_to(leaf, (-_LEAF, -_WIDTH + 0.05, high / 2), steel, lying=False)
