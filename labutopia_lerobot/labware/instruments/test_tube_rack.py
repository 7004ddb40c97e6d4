"""A test tube rack: two plates with square openings over each other, between two end walls."""

from dataclasses import dataclass

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.solid import BOX, Vector, add_look
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, SOLIMP, SOLREF

WIDTH, LENGTH, HEIGHT = 0.085, 0.286, 0.193
"""Outer dimensions along x, y and z [m] (original)."""

ROWS, COLUMNS = 3, 7
"""Openings along x and along y: odd, so that one is in the middle."""

OPENING = 0.010
"""Side of an opening [m], for the smallest usual test tubes; a 6 mm rod leans by 0.7 degrees."""

_FLOOR = 0.006  # thickness of the floor that tubes stand on [m]
_PLATE = 0.005  # thickness of the two plates [m]
_WALL = 0.005  # thickness of the end walls [m]
_GUIDE_HEIGHT = 0.07  # of the lower plate's middle above the base [m]

_BLUE = (0.16, 0.38, 0.62, 1.0)


@dataclass(frozen=True)
class TestTubeRack(Equipment):
    """A polypropylene rack that is fixed to the bench: origin at the centre of its base, z up.

    Attributes:
        name: Name of the body; prefix of the names of all its elements.
    """

    name: str
    size = (0.085, 0.286, 0.193)
    mass = 0.4
    source = "original"
    passive = True

    @property
    def middle(self) -> Vector:
        """Position of a rod or tube in the middle opening, in the rack's frame [m]."""
        return (0.0, 0.0, _FLOOR)

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around it [m]."""
        return float(np.hypot(WIDTH, LENGTH)) / 2

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build one jointless body into a spec, at the origin of the parent.

        Returns:
            The body.
        """
        body = parent.add_body(name=self.name)
        spec.add_material(name=self.name, rgba=_BLUE, specular=0.15, shininess=0.2)
        self._add_bar(body, "floor", (WIDTH, LENGTH, _FLOOR), (0, 0, _FLOOR / 2))
        for side, y in (("left", 1), ("right", -1)):
            pos = (0, y * (LENGTH - _WALL) / 2, HEIGHT / 2)
            self._add_bar(body, f"wall_{side}", (WIDTH, _WALL, HEIGHT), pos)
        for plate, z in (("guide", _GUIDE_HEIGHT), ("top", HEIGHT - _PLATE / 2)):
            self._add_plate(body, plate, z)
        body.add_geom(
            name=f"{self.name}_hull",
            type=BOX,
            size=(WIDTH / 2, LENGTH / 2, HEIGHT / 2),
            pos=(0, 0, HEIGHT / 2),
            group=HULL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )
        return body

    def _add_plate(self, body: mujoco.MjsBody, plate: str, z: float) -> None:
        """Add a plate whose middle is at height `z` [m], as bars across each other."""
        wide, middles = _between_openings(WIDTH, ROWS)
        for index, x in enumerate(middles):
            self._add_bar(body, f"{plate}_along_{index}", (wide, LENGTH, _PLATE), (x, 0, z))
        wide, middles = _between_openings(LENGTH, COLUMNS)
        for index, y in enumerate(middles):
            self._add_bar(body, f"{plate}_across_{index}", (WIDTH, wide, _PLATE), (0, y, z))

    def _add_bar(self, body: mujoco.MjsBody, part: str, size: Vector, pos: Vector) -> None:
        """Add a box of full side lengths `size` around `pos` [m], to be seen and touched."""
        name = f"{self.name}_{part}"
        half = (size[0] / 2, size[1] / 2, size[2] / 2)
        add_look(body, name, half, pos, self.name)
        body.add_geom(
            name=f"{name}_contact",
            type=BOX,
            size=half,
            pos=pos,
            group=COLLISION_GROUP,
            friction=FRICTION,
            solref=SOLREF,
            solimp=SOLIMP,
            mass=0,
        )


def _between_openings(side: float, count: int) -> tuple[float, list[float]]:
    """Return width and middles [m] of the bars that leave `count` openings along a side [m]."""
    wide = (side - count * OPENING) / (count + 1)
    first = (wide - side) / 2
    return wide, [first + index * (wide + OPENING) for index in range(count + 1)]
