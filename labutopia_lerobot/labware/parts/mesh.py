"""Triangle meshes of surfaces of revolution, for the eye only."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.glass.profile import Point

type Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Vertices, shape (n, 3) [m], and triangles, shape (m, 3), of vertex numbers."""

SEGMENTS = 32
"""Segments around the axis."""


def revolve(
    points: Sequence[Point], segments: int = SEGMENTS, start: float = 0.0, sweep: float = 2 * np.pi
) -> Mesh:
    """Turn a polyline about the z axis into a triangle mesh.

    Args:
        points: (radius, height) corners [m]; rising ones give faces that look away from the axis.
        segments: Number of steps around the axis.
        start: Azimuth of the first meridian [rad].
        sweep: Angle turned through [rad].

    Returns:
        Vertices, shape (len(points) * (segments + 1), 3) [m], and faces, shape (triangles, 3).
    """
    angles = start + np.linspace(0, sweep, segments + 1)
    radii, heights = np.asarray(points, dtype=float).T
    x, y = np.outer(np.cos(angles), radii), np.outer(np.sin(angles), radii)
    vertices = np.stack([x, y, np.broadcast_to(heights, x.shape)], axis=-1).reshape(-1, 3)
    index = np.arange(len(vertices)).reshape(segments + 1, len(points))
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    faces = np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    first, second, third = np.moveaxis(vertices[faces], 1, 0)
    area = np.linalg.norm(np.cross(second - first, third - first), axis=-1) / 2
    return vertices, faces[area > 1e-12]  # corners on the axis leave triangles without area


def bead(radius: float, height: float, thickness: float) -> list[Point]:
    """Return the five-cornered section of a ring of glass around the axis, to be revolved."""
    angles = np.linspace(0, 2 * np.pi, 6)
    return [(radius + thickness * np.cos(a), height + thickness * np.sin(a)) for a in angles]


def join(*meshes: Mesh) -> Mesh:
    """Return the meshes as one."""
    vertices, faces = zip(*meshes, strict=True)
    offsets = np.cumsum([0, *(len(part) for part in vertices[:-1])])
    shifted = [part + offset for part, offset in zip(faces, offsets, strict=True)]
    return np.concatenate(vertices), np.concatenate(shifted)
