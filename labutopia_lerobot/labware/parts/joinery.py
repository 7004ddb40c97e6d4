"""Units of furniture: a cupboard behind doors, a chest of drawers; every bench is made of them."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.fittings import tub
from labutopia_lerobot.labware.parts.form import Block, Form, Rod, Span
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.seat import Seat
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.solid import UNTURNED, Quaternion, Vector

BOARD = 0.018
"""Thickness of coated particle board, a usual one [m]."""
_DENSITY = 680.0
"""Density of particle board [kg/m^3]: EN 312 boards of 18 mm have 640 to 720."""
_GAP = 0.0015
"""Between a front and the edge of its unit [m]; two fronts are twice that apart."""
GRIP = 0.034
"""Projection of a grip before a front [m]."""
_WIDEST = math.radians(83.0)
"""Angle at which doors stop [rad]: a grip is then still within the sides of its box, and clear of a
drawer beside."""
TURNED_BACK: Quaternion = (0.0, 0.0, 0.0, 1.0)
"""Rotation of a unit that opens to the other side; scalar-first."""


@dataclass(frozen=True)
class Cupboard:
    """A box with shelves behind one door, hinged on its left, or behind two.

    Its origin is the centre of its base, its front faces -x. The doors turn about their outer front
    edges, so that nothing gets beyond the sides of the box.

    Attributes:
        name: Name of its body; prefix of all its elements.
        size: Depth, without grips, width and height [m].
        shelves: Heights of the shelves above its base [m], from below.
        doors: How many: 1 or 2.
        look: Finish of the box.
        front: Finish of the doors.
        plinth: Height of its base, which stands back [m].
        grip: Height of the middle of the grips, as a share of the door's.
        glazed: Whether one sees through the doors.
    """

    name: str
    size: Vector
    shelves: tuple[float, ...] = ()
    doors: int = 2
    look: str = "white"
    front: str = "white"
    plinth: float = 0.10
    grip: float = 0.80
    glazed: bool = False

    @property
    def mechanisms(self) -> tuple[Rotor, ...]:
        """The doors, the left one first."""
        sides = ("left", "right")[: self.doors]
        names = [f"{self.name}_{side}_door" for side in sides]
        return tuple(Rotor(name, 0.3, effort=4.0, widest=_WIDEST) for name in names)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middles of floor and shelves, from below."""
        deep, wide, _ = self.size
        width = 0.7 * min(deep, wide)
        heights = (self.plinth + BOARD, *(z + BOARD / 2 for z in self.shelves))
        return tuple(
            Seat(f"{self.name}_shelf_{number}", self.name, (0.0, 0.0, height), width)
            for number, height in enumerate(heights)
        )

    def add_to(
        self,
        spec: mujoco.MjSpec,
        parent: mujoco.MjsBody,
        piece: str,
        at: Vector = (0.0, 0.0, 0.0),
        quat: Quaternion = UNTURNED,
    ) -> None:
        """Build its body.

        Args:
            spec: What the parent is in (angles in radians).
            parent: What it is part of.
            piece: Name of that, prefix of the materials.
            at: Centre of its base in the parent's frame [m].
            quat: Orientation in the parent's frame, scalar-first.
        """
        deep, wide, tall = self.size
        box = parent.add_body(name=self.name, pos=at, quat=quat)
        inner = (-deep / 2 + BOARD + 0.004, deep / 2 - 0.008)
        across = (-wide / 2 + BOARD - 0.001, wide / 2 - BOARD + 0.001)
        boards = [
            Block(inner, across, (z - BOARD / 2, z + BOARD / 2), self.look, 0.0)
            for z in self.shelves
        ]
        case = carcass(_behind_front(deep), wide, tall, self.plinth, self.look)
        assemble(spec, box, piece, [*case, *boards])
        for place in self.places:
            place.add_to(box)
        leaf = wide / self.doors
        for door, side in zip(self.mechanisms, (1, -1), strict=False):
            hinge = (-deep / 2, side * (wide / 2 - _GAP), self.plinth + _GAP)
            body = door.add_to(spec, box, hinge, (0.0, 0.0, -float(side)))
            forms = self._leaf(side, leaf - 2 * _GAP, tall - self.plinth - 2 * _GAP)
            weight = _DENSITY * BOARD * leaf * (tall - self.plinth)
            assemble(spec, body, piece, forms, mass=weight)

    def _leaf(self, side: int, wide: float, tall: float) -> list[Form]:
        """Return a door whose hinge is its outer front edge."""
        bar, height = 0.045, self.grip * tall
        half = min(0.08, 0.3 * tall)
        near, thick, edge = (0.0, BOARD), BOARD, 0.0025
        if self.glazed:
            rim = 0.055
            skin: list[Form] = [
                Block(near, _across(side, 0.0, rim), (0.0, tall), self.front, edge),
                Block(near, _across(side, wide - rim, wide), (0.0, tall), self.front, edge),
                Block(near, _across(side, rim, wide - rim), (0.0, rim), self.front, edge),
                Block(near, _across(side, rim, wide - rim), (tall - rim, tall), self.front, edge),
                Block(
                    (0.4 * thick, 0.6 * thick),
                    _across(side, rim - 0.005, wide - rim + 0.005),
                    (rim - 0.005, tall - rim + 0.005),
                    "glass",
                    0.0,
                ),
            ]
            bar = rim / 2
        else:
            skin = [Block(near, _across(side, 0.0, wide), (0.0, tall), self.front, edge)]
        y = -side * (wide - bar)
        low, high = max(0.02, height - half), min(tall - 0.02, height + half)
        return [*skin, *bow((0.0, y, low), (0.0, y, high))]


@dataclass(frozen=True)
class Chest:
    """A box of drawers over each other.

    Its origin is the centre of its base, its front faces -x.

    Attributes:
        name: Name of its body; prefix of all its elements.
        size: Depth, without grips, width and height [m].
        count: How many drawers there are.
        look: Finish of the box.
        front: Finish of the drawers.
        plinth: Height of its base, which stands back [m].
    """

    name: str
    size: Vector
    count: int = 4
    look: str = "white"
    front: str = "white"
    plinth: float = 0.10

    @property
    def mechanisms(self) -> tuple[Slide, ...]:
        """The drawers, from below; full extension is a quarter of the depth less."""
        travel = 0.75 * self.size[0]
        names = [f"{self.name}_drawer_{number}" for number in range(self.count)]
        return tuple(Slide(name, travel, friction=4.0, effort=25.0) for name in names)

    @property
    def places(self) -> tuple[Seat, ...]:
        """The middles of the drawers, from below."""
        deep, wide, _ = self.size
        at = (deep / 2, 0.0, _TRAY + 0.004)
        width = 0.7 * min(deep, wide)
        return tuple(Seat(f"{d.name}_middle", d.name, at, width) for d in self.mechanisms)

    def add_to(
        self,
        spec: mujoco.MjSpec,
        parent: mujoco.MjsBody,
        piece: str,
        at: Vector = (0.0, 0.0, 0.0),
        quat: Quaternion = UNTURNED,
    ) -> None:
        """Build its body; see `Cupboard.add_to`."""
        deep, wide, tall = self.size
        box = parent.add_body(name=self.name, pos=at, quat=quat)
        case = carcass(_behind_front(deep), wide, tall, self.plinth, self.look)
        assemble(spec, box, piece, case)
        high = (tall - self.plinth) / self.count
        y = wide / 2
        for number, (drawer, place) in enumerate(zip(self.mechanisms, self.places, strict=True)):
            start = (-deep / 2, 0.0, self.plinth + number * high)
            body = drawer.add_to(spec, box, start, (-1.0, 0.0, 0.0))
            grip = min(0.08, 0.3 * wide)
            forms: list[Form] = [
                Block(
                    (0.0, BOARD), (_GAP - y, y - _GAP), (_GAP, high - _GAP), self.front, edge=0.0025
                ),
                *tub(
                    (BOARD - 0.002, deep - 0.03),
                    (-y + BOARD + 0.008, y - BOARD - 0.008),
                    (_TRAY, max(0.06, 0.7 * high)),
                    0.004,
                    "light_grey",
                    edge=0.0,
                ),
                *bow((0.0, -grip, 0.65 * high), (0.0, grip, 0.65 * high)),
            ]
            assemble(spec, body, piece, forms, mass=2.0 + _DENSITY * BOARD * wide * high)
            place.add_to(body)


_TRAY = BOARD + 0.006
"""Height of a drawer's floor over its front's lower edge [m]: the lowest clears the box's floor."""


def carcass(x: Span, wide: float, tall: float, plinth: float, look: str) -> list[Form]:
    """Return sides, floor, top and back of a box of boards; its front stays open.

    Args:
        x: From its front to its back [m].
        wide: Its width [m].
        tall: Its height, with its base [m].
        plinth: Height of the base, which stands back [m]; 0 for none.
        look: Its finish.
    """
    (front, back), y, inner = x, wide / 2, wide / 2 - BOARD
    forms: list[Form] = [
        Block(x, (inner, y), (plinth, tall), look, 0.0),
        Block(x, (-y, -inner), (plinth, tall), look, 0.0),
        Block(x, (-inner, inner), (plinth, plinth + BOARD), look, 0.0),
        Block(x, (-inner, inner), (tall - BOARD, tall), look, 0.0),
        Block((back - 0.008, back), (-inner, inner), (plinth + BOARD, tall - BOARD), look, 0.0),
    ]
    if plinth:
        base = (front + 0.04, back - 0.01), (-y + 0.002, y - 0.002), (0.0, plinth)
        forms.append(Block(*base, "anthracite", 0.0))
    return forms


def _behind_front(deep: float) -> Span:
    """Return from where to where a box reaches that has a front of one board before it [m]."""
    return -deep / 2 + BOARD + 0.001, deep / 2


def bow(start: Vector, stop: Vector, look: str = "steel") -> list[Form]:
    """Return a bar of 10 mm on two posts before a front that faces -x.

    Args:
        start: One end, on the front [m].
        stop: The other [m].
        look: Its finish.
    """
    diameter = 0.010
    x = -GRIP + diameter / 2
    (sx, sy, sz), (tx, ty, tz) = start, stop
    ends = [(sx + x, sy, sz), (tx + x, ty, tz)]
    posts = [
        tuple(a + share * (b - a) for a, b in zip(start, stop, strict=True)) for share in (0.1, 0.9)
    ]
    return [
        Rod(ends[0], ends[1], diameter, look, segments=10),
        *(Rod((px + x, py, pz), (px, py, pz), 0.008, look, segments=8) for px, py, pz in posts),
    ]


def _across(side: int, near: float, far: float) -> Span:
    """Return a span of a door by the distances from its hinge."""
    one, other = -side * near, -side * far
    return min(one, other), max(one, other)
