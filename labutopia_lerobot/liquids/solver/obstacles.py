"""Obstacles that liquid runs off, beside vessels: boxes, capsules, cylinders, balls and planes."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel

type Point = tuple[float, float, float]

PLANE, SPHERE, CAPSULE, CYLINDER, BOX = range(5)

_ENDLESS = 1e6
"""Half length of what has no end [m]."""


@kernel
def distance(
    kind: int, size: NDArray[np.float64], x: float, y: float, z: float
) -> tuple[float, Point]:
    """Return the signed distance of a point from a shape, and the direction away from it.

    Args:
        kind: One of the constants of this module.
        size: As MuJoCo's geom_size, shape (3,), metres: half lengths, or radius and half height.
        x: Of the point [m], frame of the shape (MuJoCo's: axes of cylinders and capsules along z).
        y: The same.
        z: The same.

    Returns:
        Distance [m], negative inside, and a unit vector in the frame of the shape.
    """
    if kind == PLANE:
        return z, (0.0, 0.0, 1.0)
    if kind == SPHERE:
        return _round(x, y, z, size[0])
    if kind == CAPSULE:
        return _round(x, y, z - min(max(z, -size[1]), size[1]), size[0])
    if kind == CYLINDER:
        radius = np.sqrt(x * x + y * y)
        ux, uy = (x / radius, y / radius) if radius > 0.0 else (1.0, 0.0)
        side, end = radius - size[0], abs(z) - size[1]
        up = 1.0 if z >= 0.0 else -1.0
        if side > 0.0 and end > 0.0:
            far = np.sqrt(side * side + end * end)
            return far, (ux * side / far, uy * side / far, up * end / far)
        if side > end:
            return side, (ux, uy, 0.0)
        return end, (0.0, 0.0, up)
    return _from_box(size, x, y, z)


@kernel
def half_lengths(kind: int, size: NDArray[np.float64], half: NDArray[np.float64]) -> None:
    """Set the half lengths, shape (3,) [m], of the box along a shape's own axes that holds it.

    Args:
        kind: One of the constants of this module.
        size: As of `distance`.
        half: Changed in place.
    """
    if kind == PLANE:  # what is below it, too
        half[:] = _ENDLESS
    elif kind == SPHERE:
        half[:] = size[0]
    elif kind == BOX:
        half[:] = size
    else:
        half[:] = size[0]
        half[2] = size[1] + (size[0] if kind == CAPSULE else 0.0)


@kernel
def _round(x: float, y: float, z: float, radius: float) -> tuple[float, Point]:
    far = np.sqrt(x * x + y * y + z * z)
    if far == 0.0:
        return -radius, (0.0, 0.0, 1.0)
    return far - radius, (x / far, y / far, z / far)


@kernel
def _from_box(size: NDArray[np.float64], x: float, y: float, z: float) -> tuple[float, Point]:
    bx, by, bz = abs(x) - size[0], abs(y) - size[1], abs(z) - size[2]
    sx = 1.0 if x >= 0.0 else -1.0
    sy = 1.0 if y >= 0.0 else -1.0
    sz = 1.0 if z >= 0.0 else -1.0
    if bx <= 0.0 and by <= 0.0 and bz <= 0.0:
        if bx >= by and bx >= bz:
            return bx, (sx, 0.0, 0.0)
        if by >= bz:
            return by, (0.0, sy, 0.0)
        return bz, (0.0, 0.0, sz)
    ox, oy, oz = max(bx, 0.0), max(by, 0.0), max(bz, 0.0)
    far = np.sqrt(ox * ox + oy * oy + oz * oz)
    return far, (sx * ox / far, sy * oy / far, sz * oz / far)
