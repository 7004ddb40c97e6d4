"""Tubes and cones of ware: side arms, necks, stems, plugs."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts import shell
from labutopia_lerobot.labware.parts.form import Primitive, Rod, moved, towards
from labutopia_lerobot.labware.parts.shell import Shell
from labutopia_lerobot.labware.parts.solid import BOX, MESH, UNTURNED, Quaternion, Vector

_FACETS = 12
"""Flat pieces around a bore that can be touched inside."""

_ROUND = 96
"""Corners of a cone that is touched: round to 0.01 mm, so that a plug sits alike at any angle."""

_WIDE = 0.008
"""Bore into which something can be put [m]; a narrower one is touched as a solid rod."""


@dataclass(frozen=True)
class Pipe:
    """A straight round tube from one point to another, open at its far end.

    Attributes:
        start: Middle of one end [m].
        stop: Middle of the other end [m].
        diameter: Outer diameter [m].
        wall: Thickness of its wall [m].
        look: Its finish.
        touch: Whether it can be touched.
        segments: Around its axis.
    """

    start: Vector
    stop: Vector
    diameter: float
    wall: float
    look: str
    touch: bool = True
    segments: int = 20

    def shell(self) -> Shell:
        """Return what is seen of it."""
        length, outer = math.dist(self.start, self.stop), self.diameter / 2
        inner = outer - self.wall
        wall = [(inner, 0), (outer, 0), (outer, length), (inner, length), (inner, 0)]
        return moved(shell.turned(wall, self.segments), self.start, self._turn)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it: flat pieces around a wide bore, else a rod."""
        if self.diameter - 2 * self.wall < _WIDE:
            yield from Rod(self.start, self.stop, self.diameter, self.look).primitives()
            return
        length, outer = math.dist(self.start, self.stop), self.diameter / 2
        middle = outer - self.wall / 2
        size = (self.wall / 2, middle * math.tan(math.pi / _FACETS), length / 2)
        turn = Rotation.from_quat(self._turn, scalar_first=True)
        centre = (np.asarray(self.start) + self.stop) / 2
        volume = 2 * math.pi * middle * self.wall * length / _FACETS
        for facet in range(_FACETS):
            around = Rotation.from_euler("z", 2 * math.pi * facet / _FACETS)
            x, y, z = centre + (turn * around).apply((middle, 0.0, 0.0))
            a, b, c, d = (turn * around).as_quat(scalar_first=True)
            quat = (float(a), float(b), float(c), float(d))
            yield Primitive(BOX, size, (float(x), float(y), float(z)), quat, volume)

    @property
    def _turn(self) -> Quaternion:
        x, y, z = (b - a for a, b in zip(self.start, self.stop, strict=True))
        return towards((x, y, z))


@dataclass(frozen=True)
class Cone:
    """A solid round cone with its point cut off: a stopper, a bung; touched all around alike.

    Attributes:
        low: Diameter of the lower end [m].
        high: Diameter of the upper end [m].
        z: From where to where [m].
        look: Its finish.
        touch: Whether it can be touched.
        segments: Around its axis.
    """

    low: float
    high: float
    z: tuple[float, float]
    look: str
    touch: bool = True
    segments: int = shell.SEGMENTS

    def shell(self) -> Shell:
        """Return what is seen of it."""
        (bottom, top), low, high = self.z, self.low / 2, self.high / 2
        return shell.turned([(0, bottom), (low, bottom), (high, top), (0, top)], self.segments)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        angles = 2 * np.pi * np.arange(_ROUND) / _ROUND
        points = [
            (d / 2 * np.cos(a), d / 2 * np.sin(a), z)
            for a in angles
            for d, z in zip((self.low, self.high), self.z, strict=True)
        ]
        flat = tuple(float(part) for point in points for part in point)
        low, high, tall = self.low / 2, self.high / 2, self.z[1] - self.z[0]
        volume = math.pi / 3 * tall * (low**2 + low * high + high**2)
        yield Primitive(MESH, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), UNTURNED, volume, flat)
