"""Triangle meshes with normals of their own: edges that are rounded to the eye with few faces."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

type Outline = Sequence[tuple[float, float]]
"""Corners in a plane [m]."""

type Shell = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]
"""Vertices, shape (n, 3) [m], their normals, shape (n, 3), and triangles, shape (m, 3)."""

SEGMENTS = 32
"""Around an axis."""

_COARSE = ContextVar("coarse", default=False)
_COARSE_SEGMENTS, _COARSE_STEP, _NEGLIGIBLE = 8, 0.004, 0.02
"""Most segments, shortest step of a profile and least size of what is coarse [m]: a pixel at 2 m is
7 mm wide in a picture of 256 pixels and 55 degrees."""

type _Pair = tuple[tuple[float, float], tuple[float, float]]

_CREASE = np.cos(np.radians(50.0))
"""Two faces that meet at less are shaded as one; cosine."""


@contextmanager
def coarse() -> Iterator[None]:
    """Let what is made within this have sharp edges and few segments: what is looked at from afar.

    A room has a tenth of the triangles so, and what is larger than a hand looks the same at 2 m.
    """
    token = _COARSE.set(True)
    try:
        yield
    finally:
        _COARSE.reset(token)


def rounded_box(size: Sequence[float], edge: float) -> Shell:
    """Return a box around the origin whose edges have a radius, in two steps.

    Args:
        size: Full sides [m].
        edge: Radius of the edges [m]; 0 for sharp ones.
    """
    half = np.asarray(size) / 2
    edge = 0.0 if _COARSE.get() else min(edge, *(0.99 * half))
    # Across an edge: towards the neighbour, half way, and straight out from the face.
    steps = np.array([-1.0, -1.0, 1.0, 1.0]) if edge else np.array([-1.0, 1.0])
    lean = np.array([-1.0, 0.0, 0.0, 1.0]) if edge else np.array([0.0, 0.0])
    u, v = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    du, dv = (grid.ravel() for grid in np.meshgrid(lean, lean, indexing="ij"))
    count = len(steps)
    index = np.arange(count * count).reshape(count, count)
    a, b, c, d = (
        corner.ravel()
        for corner in (index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:])
    )
    faces = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    shells = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            one, two = (axis + 1) % 3, (axis + 2) % 3
            core, out = np.zeros((len(u), 3)), np.zeros((len(u), 3))
            core[:, axis], core[:, one], core[:, two] = side, u, v
            out[:, axis], out[:, one], out[:, two] = side, du, dv
            normals = out / np.linalg.norm(out, axis=1, keepdims=True)
            vertices = core * (half - edge) + edge * normals
            shells.append((vertices, normals, faces if side > 0 else faces[:, ::-1]))
    return joined(shells)


def turned(profile: Outline, segments: int = SEGMENTS) -> Shell:
    """Return a polyline turned about the z axis.

    Args:
        profile: (radius, height) corners [m]; rising ones give faces that look away from the axis.
        segments: Number of steps around the axis.
    """
    if _COARSE.get():
        segments, profile = min(segments, _COARSE_SEGMENTS), _thinned(profile)
    angles = np.linspace(0, 2 * np.pi, segments + 1)
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    shells: list[Shell] = []
    for (start, stop), (first, last) in _smoothed(profile, closed=False):
        vertices, normals = [], []
        for (radius, height), (out, up) in ((start, first), (stop, last)):
            vertices.append(np.column_stack([radius * around, np.full(segments + 1, height)]))
            normals.append(np.column_stack([out * around, np.full(segments + 1, up)]))
        i = np.arange(segments)
        j = i + segments + 1
        below, above = start[0] > 1e-9, stop[0] > 1e-9
        faces = [np.column_stack([i, i + 1, j])] if below else []
        faces += [np.column_stack([i + 1, j + 1, j])] if above else []
        if faces:
            shells.append((np.concatenate(vertices), np.concatenate(normals), np.vstack(faces)))
    return joined(shells)


def extruded(outline: Outline, width: float, edge: float) -> Shell:
    """Return a convex outline in the x-z plane, extruded along y around y = 0.

    Args:
        outline: (x, z) corners [m], counterclockwise for who sees x to the right and z up.
        width: Along y [m].
        edge: Radius of its edges [m], in one step; 0 for sharp ones.
    """
    edge = 0.0 if _COARSE.get() else edge
    corners = rounded(outline, edge) if edge else list(outline)
    inner = inset(corners, edge) if edge else corners
    half = width / 2
    shells: list[Shell] = []
    for side in (-1.0, 1.0):  # the two flat sides, as fans around the middle
        ring = np.array([(x, side * half, z) for x, z in inner])
        vertices = np.vstack([ring.mean(axis=0), ring])
        i = np.arange(1, len(ring) + 1)
        faces = np.column_stack([np.zeros_like(i), i, np.roll(i, -1)])
        normals = np.tile((0.0, side, 0.0), (len(vertices), 1))
        shells.append((vertices, normals, faces if side < 0 else faces[:, ::-1]))
    rims = [*pairwise(inner), (inner[-1], inner[0])]
    quad = np.array([[0, 2, 1], [0, 3, 2]])
    sides = zip(_smoothed(corners, closed=True), rims, strict=True)
    for ((start, stop), (first, last)), (near, far) in sides:
        outward = np.array([(n[0], 0.0, n[1]) for n in (first, last)])
        low, high = edge - half, half - edge
        points = [(start, low), (stop, low), (stop, high), (start, high)]
        flat = np.vstack([outward, outward[::-1]])
        shells.append((np.array([(x, y, z) for (x, z), y in points]), flat, quad))
        for side in (-1.0, 1.0) if edge else ():
            at, rim = side * (half - edge), side * half
            points = [(start, at), (stop, at), (far, rim), (near, rim)]
            vertices = np.array([(x, y, z) for (x, z), y in points])
            normals = np.vstack([outward, np.tile((0.0, side, 0.0), (2, 1))])
            shells.append((vertices, normals, quad if side > 0 else quad[:, ::-1]))
    return joined(shells)


def rounded(outline: Outline, radius: float, closed: bool = True) -> list[tuple[float, float]]:
    """Return an outline whose corners are cut to arcs of three points.

    Args:
        outline: Corners [m].
        radius: From the corner to where the arc begins, at most a third of a side [m].
        closed: Whether the last corner is joined to the first; else both ends stay.
    """
    if _COARSE.get():
        return list(outline)
    points = [np.asarray(point, float) for point in outline]
    result: list[tuple[float, float]] = []
    for number, point in enumerate(points):
        if not closed and number in (0, len(points) - 1):
            result.append((float(point[0]), float(point[1])))
            continue
        before, after = points[number - 1] - point, points[(number + 1) % len(points)] - point
        long_before, long_after = np.linalg.norm(before), np.linalg.norm(after)
        cut = min(radius, long_before / 3, long_after / 3)
        start, stop = point + cut * before / long_before, point + cut * after / long_after
        middle = (start + stop) / 2
        middle = middle + 0.41 * (point - middle)  # on the arc, where the corner is a right angle
        result += [(float(p[0]), float(p[1])) for p in (start, middle, stop)]
    return result


def inset(outline: Outline, by: float) -> list[tuple[float, float]]:
    """Return a convex, counterclockwise outline with every side moved inwards [m]."""
    points = np.asarray(outline, float)
    along = np.roll(points, -1, axis=0) - points
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    inward = np.column_stack([-along[:, 1], along[:, 0]])
    before = np.roll(inward, 1, axis=0)
    share = by / (1.0 + np.einsum("ij,ij->i", before, inward))
    moved = points + share[:, None] * (before + inward)
    return [(float(x), float(y)) for x, y in moved]


def joined(shells: Sequence[Shell]) -> Shell:
    """Return the shells as one."""
    offsets = np.cumsum([0, *(len(vertices) for vertices, _, _ in shells[:-1])])
    vertices, normals, faces = zip(*shells, strict=True)
    shifted = [part + offset for part, offset in zip(faces, offsets, strict=True)]
    return np.vstack(vertices), np.vstack(normals), np.vstack(shifted)


def negligible(mesh: Shell) -> bool:
    """Return whether a form is too small to be seen, where all is coarse."""
    return _COARSE.get() and bool(np.ptp(mesh[0], axis=0).max() < _NEGLIGIBLE)


def _thinned(profile: Outline) -> list[tuple[float, float]]:
    """Return a profile without its short steps; its ends stay."""
    kept = [profile[0]]
    step = min(_COARSE_STEP, 0.25 * float(np.ptp(np.asarray(profile), axis=0).max()))
    for point in profile[1:-1]:
        if np.hypot(point[0] - kept[-1][0], point[1] - kept[-1][1]) > step:
            kept.append(point)
    return [*kept, profile[-1]]


def _smoothed(outline: Outline, closed: bool) -> list[tuple[_Pair, _Pair]]:
    """Return the sides of an outline, each as its two ends and the two normals there.

    At a corner that is no crease the normal leans to the longer side, so that flat faces look flat.
    """
    points = [*outline, outline[0]] if closed else list(outline)
    sides = [(a, b) for a, b in pairwise(points) if np.hypot(b[0] - a[0], b[1] - a[1]) > 1e-9]
    along = np.array([np.subtract(b, a) for a, b in sides])
    long = np.linalg.norm(along, axis=1)
    normals = np.column_stack([along[:, 1], -along[:, 0]]) / long[:, None]
    ends: list[_Pair] = []
    for number in range(len(sides)):
        pair = []
        for other in (number - 1, number + 1):
            normal = normals[number]
            inside = closed or 0 <= other < len(sides)
            other %= len(sides)
            if inside and normals[other] @ normal > _CREASE:
                normal = long[number] ** 2 * normal + long[other] ** 2 * normals[other]
            out, up = normal / np.linalg.norm(normal)
            pair.append((float(out), float(up)))
        ends.append((pair[0], pair[1]))
    return list(zip(sides, ends, strict=True))
