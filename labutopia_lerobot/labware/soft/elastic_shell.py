"""A closed elastic shell of revolution, as a MuJoCo flex between two rigid ends."""

from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.glass.profile import Point
from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ, SOLIMP, VISUAL_GROUP

_SOLREF = (1.0 / PHYSICS_HZ, 1.0)
"""Time constant [s] and damping ratio of contacts: one physics step. MuJoCo scales a contact's
stiffness by the inertia behind it, which for a single vertex is grams, so that the 8 ms of rigid
glass let a pad through the wall (measured: 3.8 mm deep, and out on the other side)."""

SKIN = 0.0015
"""Distance at which things meet the middle of the wall, on both sides [m]. A thin wall is pushed
back only as deep as this: with half a thickness of 0.4 mm, a gripper pad that pressed between two
rings of vertices went through (measured, with 35 N); with 1.5 mm it does not. Drawn the same."""

_PRIORITY = 2
"""Above the gripper pads' 1: the shell decides on contact stiffness, for the reason above. Its
friction is then that of the pads on smooth plastic, see `_FRICTION`."""

_FRICTION = (1.0, *FRICTION[1:])
"""Friction of a rubber pad on anything smooth (the pads in `robots/`)."""

OWN_CONTYPE = 2
"""Contact type of a shell and of the rigid parts it is fixed to: they meet everything else, whose
types and affinities are MuJoCo's default of 1, but not each other."""

_ELASTIC_BOTH = 3
"""MuJoCo's number for `elastic2d="both"`: the shell resists stretching and bending."""


@dataclass(frozen=True)
class Elastic:
    """An isotropic elastic material.

    Attributes:
        young: Young's modulus [Pa].
        poisson: Poisson's ratio.
        density: Density [kg/m^3].
        damping: Rayleigh damping: viscous over elastic stress, per strain rate [s].
    """

    young: float
    poisson: float
    density: float
    damping: float


@dataclass(frozen=True)
class Shell:
    """A thin wall of revolution about z, meshed by triangles; a disc closes either end.

    Its corners lie outside the true circles, so that every polygon has the area of its circle and
    the mesh at rest encloses the volume of the true body, whatever the number of segments.

    Attributes:
        rings: (radius, height) [m] of the rings of vertices, rising; the first and the last are
            fixed to the body, as are the discs that they bound.
        segments: Vertices of a ring; each ring is turned by half a segment against the last.
        thickness: Of the wall [m].
        material: What it is made of.
    """

    rings: tuple[Point, ...]
    segments: int
    thickness: float
    material: Elastic

    @property
    def area(self) -> float:
        """Area of the wall without the discs [m^2]: of the frustums between the rings."""
        return sum(
            np.pi * (r + s) * float(np.hypot(s - r, top - low))
            for (r, low), (s, top) in zip(self.rings, self.rings[1:], strict=False)
        )

    @property
    def mass(self) -> float:
        """Mass of the wall [kg]."""
        return self.area * self.thickness * self.material.density

    @cached_property
    def triangles(self) -> NDArray[np.int64]:
        """Vertex numbers, counterclockwise seen from outside, shape (triangles, 3)."""
        n, last = self.segments, len(self.rings) - 1
        bottom, top = n * (last + 1), n * (last + 1) + 1
        here = np.arange(n)
        after = (here + 1) % n
        faces = [(np.full(n, bottom), after, here)]
        for ring in range(last):
            a, b = ring * n + here, ring * n + after
            c, d = a + n, b + n
            if ring % 2 == 0:  # the ring above is half a segment ahead
                faces += [(a, b, c), (b, d, c)]
            else:
                faces += [(a, b, d), (a, d, c)]
        faces.append((np.full(n, top), last * n + here, last * n + after))
        return np.concatenate([np.column_stack(face) for face in faces])

    @cached_property
    def vertices(self) -> FloatArray:
        """Vertices at rest: ring after ring, then the centres of the discs, shape (n, 3) [m]."""
        step = 2 * np.pi / self.segments
        outward = np.sqrt(step / np.sin(step))
        corners = []
        for number, (radius, height) in enumerate(self.rings):
            angles = step * (np.arange(self.segments) + 0.5 * (number % 2))
            x, y = outward * radius * np.cos(angles), outward * radius * np.sin(angles)
            corners.append(np.column_stack([x, y, np.full(self.segments, height)]))
        centres = [(0.0, 0.0, self.rings[0][1]), (0.0, 0.0, self.rings[-1][1])]
        return np.concatenate([*corners, centres])

    @cached_property
    def volume(self) -> float:
        """Volume enclosed at rest [m^3]."""
        return enclosed_volume(self.vertices, self.triangles)

    def add_to(
        self, spec: mujoco.MjSpec, body: mujoco.MjsBody, name: str, look: str, carried: float
    ) -> None:
        """Build it onto a body as the flex `<name>`; each free vertex is a point on three slides.

        Args:
            spec: The spec of the body.
            body: What the end rings and discs are fixed to.
            name: Name of the flex; prefix of the names of the vertices' bodies and joints.
            look: Name of a material of the spec.
            carried: Mass that moves with the wall, besides its own [kg].
        """
        n = self.segments
        free = range(n, n * (len(self.rings) - 1))
        share = (self.mass + carried) / len(free)
        bodies, local = [], self.vertices.copy()
        for number, position in enumerate(self.vertices):
            if number not in free:
                bodies.append(body.name)
                continue
            vertex = f"{name}_{number:03d}"
            point = body.add_body(name=vertex, pos=position, explicitinertial=True, mass=share)
            point.ipos = (0.0, 0.0, 0.0)  # MuJoCo does not write an inertia without a place
            point.inertia = (share * 1e-6,) * 3  # not felt: it never turns
            for axis, direction in zip("xyz", np.eye(3), strict=True):
                slide = mujoco.mjtJoint.mjJNT_SLIDE
                point.add_joint(name=f"{vertex}_{axis}", type=slide, axis=direction)
            bodies.append(vertex)
            local[number] = 0.0
        spec.add_flex(
            name=name,
            dim=2,
            radius=SKIN,
            vertbody=bodies,
            vert=local.ravel(),
            elem=self.triangles.ravel(),
            young=self.material.young,
            poisson=self.material.poisson,
            damping=self.material.damping,
            thickness=self.thickness,
            elastic2d=_ELASTIC_BOTH,
            selfcollide=mujoco.mjtFlexSelf.mjFLEXSELF_NONE,
            contype=OWN_CONTYPE,
            priority=_PRIORITY,
            friction=_FRICTION,
            solref=_SOLREF,
            solimp=SOLIMP,
            material=[look],
            group=VISUAL_GROUP,
        )


def enclosed_volume(vertices: FloatArray, triangles: NDArray[np.int64]) -> float:
    """Return the volume inside a closed surface [m^3], by the divergence theorem.

    Every triangle adds the signed volume of the tetrahedron that it makes with the first vertex.

    Args:
        vertices: Shape (n, 3) [m], any frame.
        triangles: Vertex numbers, counterclockwise seen from outside, shape (m, 3).
    """
    first, second, third = np.moveaxis((vertices - vertices[0])[triangles], 1, 0)
    return float(np.einsum("ij,ij->", first, np.cross(second, third)) / 6.0)
