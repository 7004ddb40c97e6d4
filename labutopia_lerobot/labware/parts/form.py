"""The forms that instruments are made of: what is seen of them, and what is touched."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple, Protocol

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts import shell
from labutopia_lerobot.labware.parts.shell import Outline, Shell
from labutopia_lerobot.labware.parts.solid import BOX, CYLINDER, UNTURNED, Quaternion, Vector

type Span = tuple[float, float]
"""Interval along an axis [m]."""

_UP: Vector = (0.0, 0.0, 1.0)


class Primitive(NamedTuple):
    """Contact shape: a primitive of MuJoCo, or the convex hull of points.

    Attributes:
        shape: Box, cylinder or mesh.
        size: Half sizes, or radius and half length [m].
        pos: Its centre in the body's frame [m].
        quat: Its orientation, scalar-first.
        volume: What it weighs in proportion to [m^3].
        points: Of a mesh, flattened [m], in the body's frame.
    """

    shape: mujoco.mjtGeom
    size: Vector
    pos: Vector
    quat: Quaternion
    volume: float
    points: tuple[float, ...] = ()


class Form(Protocol):
    """A form of one finish, in the frame of the body that it is part of."""

    @property
    def look(self) -> str:
        """Name of its finish, see `FINISHES`."""
        ...

    @property
    def touch(self) -> bool:
        """Whether it can be touched; what cannot weighs nothing."""
        ...

    def shell(self) -> Shell:
        """Return what is seen of it."""
        ...

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        ...


@dataclass(frozen=True)
class Block:
    """A box with rounded edges between two corners, turned about its middle.

    Attributes:
        x: From where to where [m]; so are y and z.
        y: See x.
        z: See x.
        look: Its finish.
        edge: Radius of its edges [m].
        turn: Orientation, scalar-first.
        touch: Whether it can be touched.
    """

    x: Span
    y: Span
    z: Span
    look: str
    edge: float = 0.003
    turn: Quaternion = UNTURNED
    touch: bool = True

    @property
    def _size(self) -> Vector:
        (x, far_x), (y, far_y), (z, far_z) = self.x, self.y, self.z
        return far_x - x, far_y - y, far_z - z

    @property
    def _middle(self) -> Vector:
        x, y, z = (sum(span) / 2 for span in (self.x, self.y, self.z))
        return x, y, z

    def shell(self) -> Shell:
        """Return what is seen of it."""
        return moved(shell.rounded_box(self._size, self.edge), self._middle, self.turn)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        x, y, z = self._size
        yield Primitive(BOX, (x / 2, y / 2, z / 2), self._middle, self.turn, x * y * z)


@dataclass(frozen=True)
class Prism:
    """A convex side view that is as it is over a width: a wedge, a housing with a sloping front.

    Attributes:
        outline: (x, z) corners [m], counterclockwise for who sees x to the right and z up.
        y: From where to where [m].
        look: Its finish.
        edge: Radius of its edges [m].
        touch: Whether it can be touched.
    """

    outline: Outline
    y: Span
    look: str
    edge: float = 0.003
    touch: bool = True

    def shell(self) -> Shell:
        """Return what is seen of it."""
        width, middle = self.y[1] - self.y[0], (0.0, sum(self.y) / 2, 0.0)
        return moved(shell.extruded(self.outline, width, self.edge), middle, UNTURNED)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        points = [(x, y, z) for x, z in self.outline for y in self.y]
        x, z = np.array(self.outline).T
        area = 0.5 * abs(x @ np.roll(z, -1) - z @ np.roll(x, -1))
        flat = tuple(float(c) for point in points for c in point)
        mesh, volume = mujoco.mjtGeom.mjGEOM_MESH, float(area) * (self.y[1] - self.y[0])
        yield Primitive(mesh, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), UNTURNED, volume, flat)


@dataclass(frozen=True)
class Rod:
    """A round bar from one point to another: a column, a shaft, a dial.

    Attributes:
        start: Middle of one end [m].
        stop: Middle of the other end [m].
        diameter: Of the bar [m].
        look: Its finish.
        touch: Whether it can be touched.
        segments: Around its axis.
    """

    start: Vector
    stop: Vector
    diameter: float
    look: str
    touch: bool = True
    segments: int = 24

    def shell(self) -> Shell:
        """Return what is seen of it."""
        length, radius = math.dist(self.start, self.stop), self.diameter / 2
        edge = min(0.0015, 0.2 * radius, 0.2 * length)
        profile = [(0, 0), (radius - edge, 0), (radius, edge)]
        profile += [(radius, length - edge), (radius - edge, length), (0, length)]
        return moved(shell.turned(profile, self.segments), self.start, self._turn)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        length, radius = math.dist(self.start, self.stop), self.diameter / 2
        x, y, z = ((a + b) / 2 for a, b in zip(self.start, self.stop, strict=True))
        volume = math.pi * radius**2 * length
        yield Primitive(CYLINDER, (radius, length / 2, 0.0), (x, y, z), self._turn, volume)

    @property
    def _turn(self) -> Quaternion:
        x, y, z = (b - a for a, b in zip(self.start, self.stop, strict=True))
        return towards((x, y, z))


@dataclass(frozen=True)
class Turned:
    """A profile turned about an axis: a foot, a burner's tube, a flask.

    Attributes:
        profile: (radius, height) corners [m]; rising ones give faces that look outwards. What can
            be touched must rise throughout.
        look: Its finish.
        at: Where height 0 of the axis is [m].
        axis: Which way the heights go.
        edge: Radius of its edges [m].
        touch: Whether it can be touched.
        segments: Around its axis.
    """

    profile: Outline
    look: str
    at: Vector = (0.0, 0.0, 0.0)
    axis: Vector = _UP
    edge: float = 0.0015
    touch: bool = True
    segments: int = shell.SEGMENTS

    def shell(self) -> Shell:
        """Return what is seen of it."""
        profile = shell.rounded(self.profile, self.edge, closed=False)
        return moved(shell.turned(profile, self.segments), self.at, towards(self.axis))

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it.

        Raises:
            ValueError: If the profile does not rise.
        """
        turn = Rotation.from_quat(towards(self.axis), scalar_first=True)
        for (near, low), (far, high) in pairwise(self.profile):
            if high < low:
                raise ValueError("a profile that can be touched must rise; else set touch=False")
            if high > low:
                radius, half = max(near, far), (high - low) / 2
                x, y, z = np.asarray(self.at) + turn.apply((0.0, 0.0, (low + high) / 2))
                pos, volume = (float(x), float(y), float(z)), 2 * math.pi * radius**2 * half
                yield Primitive(CYLINDER, (radius, half, 0.0), pos, towards(self.axis), volume)


@dataclass(frozen=True)
class Ring:
    """An upright round wall: a pot, a bore, the collar of a clamp.

    Attributes:
        inner: Inner diameter [m].
        outer: Outer diameter [m].
        z: From where to where [m].
        look: Its finish.
        at: Where its axis is, x and y [m].
        touch: Whether it can be touched.
        segments: Around its axis.
        facets: Flat pieces that are touched around it.
    """

    inner: float
    outer: float
    z: Span
    look: str
    at: tuple[float, float] = (0.0, 0.0)
    touch: bool = True
    segments: int = shell.SEGMENTS
    facets: int = 12

    def shell(self) -> Shell:
        """Return what is seen of it."""
        inner, outer, (low, high) = self.inner / 2, self.outer / 2, self.z
        edge = min(0.0015, 0.3 * (outer - inner), 0.3 * (high - low))
        wall = [(inner, low), (outer - edge, low), (outer, low + edge), (outer, high - edge)]
        wall += [(outer - edge, high), (inner, high), (inner, low)]
        return moved(shell.turned(wall, self.segments), (*self.at, 0.0), UNTURNED)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        inner, outer, (low, high) = self.inner / 2, self.outer / 2, self.z
        thick, middle, half = outer - inner, (inner + outer) / 2, (high - low) / 2
        size = (thick / 2, middle * math.tan(math.pi / self.facets), half)
        for facet in range(self.facets):
            angle = 2 * math.pi * facet / self.facets
            x, y = self.at[0] + middle * math.cos(angle), self.at[1] + middle * math.sin(angle)
            quat = (math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))
            volume = math.pi * (outer**2 - inner**2) * (high - low) / self.facets
            yield Primitive(BOX, size, (x, y, low + half), quat, volume)


@dataclass(frozen=True)
class Bowl:
    """An upright round wall whose inside widens upwards: a rubber cup, a funnel.

    Attributes:
        lower: Inner diameter below [m].
        upper: Inner diameter above, less than the outer one [m].
        outer: Outer diameter [m].
        z: From where to where [m].
        look: Its finish.
        touch: Whether it can be touched.
        facets: Flat pieces that are touched around it.
    """

    lower: float
    upper: float
    outer: float
    z: Span
    look: str
    touch: bool = True
    facets: int = 16

    def shell(self) -> Shell:
        """Return what is seen of it."""
        near, far, wide, (low, high) = self.lower / 2, self.upper / 2, self.outer / 2, self.z
        wall = [(near, low), (wide, low), (wide, high), (far, high), (near, low)]
        return shell.turned(wall, shell.SEGMENTS)

    def primitives(self) -> Iterator[Primitive]:
        """Yield what can be touched of it."""
        half, (low, high) = math.pi / self.facets, self.z
        edges = [(r, low) for r in (self.lower / 2, self.outer / 2)]
        edges += [(r, high) for r in (self.upper / 2, self.outer / 2)]
        mesh, nowhere = mujoco.mjtGeom.mjGEOM_MESH, (0.0, 0.0, 0.0)
        inside = self.lower**2 + self.lower * self.upper + self.upper**2
        volume = math.pi / 4 * (high - low) * (self.outer**2 - inside / 3) / self.facets
        for facet in range(self.facets):
            turns = [2 * half * facet + side * half for side in (-1, 1)]
            points = [
                (r / math.cos(half) * math.cos(a), r / math.cos(half) * math.sin(a), z)
                for r, z in edges
                for a in turns
            ]
            flat = tuple(float(part) for point in points for part in point)
            yield Primitive(mesh, nowhere, nowhere, UNTURNED, volume, flat)


def towards(direction: Vector) -> Quaternion:
    """Return how to turn so that z points along a direction, scalar-first; the shortest way."""
    x, y, z = np.asarray(direction) / np.linalg.norm(direction)
    if z < -0.999999:
        return (0.0, 1.0, 0.0, 0.0)
    w, i, j = 1.0 + z, -y, x
    length = math.sqrt(w * w + i * i + j * j)
    return (float(w / length), float(i / length), float(j / length), 0.0)


def about(axis: Vector, degrees: float) -> Quaternion:
    """Return a turn about an axis of unit length [deg], scalar-first."""
    half = math.radians(degrees) / 2
    x, y, z = (math.sin(half) * part for part in axis)
    return (math.cos(half), x, y, z)


def moved(mesh: Shell, pos: Vector, quat: Quaternion) -> Shell:
    """Return a mesh turned, then moved [m]."""
    vertices, normals, faces = mesh
    turn = Rotation.from_quat(quat, scalar_first=True).as_matrix()
    return vertices @ turn.T + pos, normals @ turn.T, faces
