"""Where particles are near walls: each such place as a plane, found once per step."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.bodies import Glass, Shapes, into
from labutopia_lerobot.liquids.compilation import kernel
from labutopia_lerobot.liquids.obstacles import distance
from labutopia_lerobot.liquids.walls import (
    ALONG_R,
    ALONG_Z,
    HEIGHT,
    LENGTH,
    NORMAL_R,
    NORMAL_Z,
    OPEN_END,
    OPEN_START,
    RADIUS,
    first_crossing,
)

_MOST = 6
"""Planes per particle at most: a corner of a vessel on the bench against a hand."""


class Contacts(NamedTuple):
    """Planes near particles, ordered by particle.

    Attributes:
        starts: Index of the first plane of each particle, shape (n + 1,).
        normal: Unit vectors from the wall to the liquid, shape (planes, 3), world frame.
        offset: Distance of the plane from the origin along its normal [m], shape (planes,).
        extent: How much of a whole plane the wall is there, 0 to 1, shape (planes,).
        owner: Index of the vessel, or the number of vessels plus that of the shape.
        push: How far the wall has moved the particle along the normal [m], shape (planes,).
    """

    starts: NDArray[np.int64]
    normal: NDArray[np.float64]
    offset: NDArray[np.float64]
    extent: NDArray[np.float64]
    owner: NDArray[np.int64]
    push: NDArray[np.float64]


@kernel
def gap(contacts: Contacts, c: int, x: float, y: float, z: float) -> float:
    """Return the distance of a point from a plane [m]."""
    normal = contacts.normal
    along: float = normal[c, 0] * x + normal[c, 1] * y + normal[c, 2] * z
    distance: float = along - contacts.offset[c]
    return distance


@kernel
def find_contacts(
    positions: NDArray[np.float64], glass: Glass, shapes: Shapes, reach: float
) -> Contacts:
    """Return every wall within reach of a particle.

    Args:
        positions: Shape (n, 3), metres, world frame, none in glass.
        glass: The vessels.
        shapes: Everything else.
        reach: How far a wall matters [m].
    """
    n, vessels = len(positions), len(glass.starts) - 1
    room = _MOST * n
    starts = np.zeros(n + 1, np.int64)
    normal, offset, extent = np.empty((room, 3)), np.empty(room), np.empty(room)
    owner = np.empty(room, np.int64)
    # Only shapes that come near any liquid at all.
    low, high = np.empty(3), np.empty(3)
    for k in range(3):
        low[k], high[k] = positions[:, k].min() - reach, positions[:, k].max() + reach
    candidates = np.empty(len(shapes.kind), np.int64)
    chosen = 0
    for s in range(len(shapes.kind)):
        far = 0.0
        for k in range(3):
            centre = shapes.origin[s, k]
            far += max(low[k] - centre, 0.0, centre - high[k]) ** 2
        if far < shapes.radius[s] ** 2:
            candidates[chosen] = s
            chosen += 1
    local, scratch, count = np.empty(3), np.empty((3, 3)), 0
    for a in range(n):
        limit = count + _MOST
        point = positions[a]
        for v in range(vessels):
            into(glass.origin[v], glass.rotation[v], point, local)
            ball = local[0] ** 2 + local[1] ** 2 + (local[2] - glass.middle[v]) ** 2
            if ball > (glass.radius[v] + reach) ** 2:
                continue
            radius = np.sqrt(local[0] ** 2 + local[1] ** 2)
            ux, uy = (local[0] / radius, local[1] / radius) if radius > 0.0 else (1.0, 0.0)
            for e in range(glass.starts[v], glass.starts[v + 1]):
                edge = glass.edges[e]
                r, z = radius - edge[RADIUS], local[2] - edge[HEIGHT]
                clear = edge[NORMAL_R] * r + edge[NORMAL_Z] * z
                if clear < 0.0 or clear >= reach:
                    continue
                part = _extent(edge, edge[ALONG_R] * r + edge[ALONG_Z] * z, reach)
                if part <= 0.0 or count == limit:
                    continue
                nr, nz = edge[NORMAL_R], edge[NORMAL_Z]
                _turn(glass.rotation[v], nr * ux, nr * uy, nz, normal[count])
                if _behind_glass(glass, v, point, normal[count], clear, scratch):
                    continue
                offset[count] = _dot(normal[count], point) - clear
                extent[count], owner[count] = part, v
                count += 1
        for index in range(chosen):
            s = candidates[index]
            into(shapes.origin[s], shapes.rotation[s], point, local)
            if local[0] ** 2 + local[1] ** 2 + local[2] ** 2 > (shapes.radius[s] + reach) ** 2:
                continue
            clear, (nx, ny, nz) = distance(
                shapes.kind[s], shapes.size[s], local[0], local[1], local[2]
            )
            if clear >= reach or count == limit:
                continue
            _turn(shapes.rotation[s], nx, ny, nz, normal[count])
            if _behind_glass(glass, -1, point, normal[count], clear, scratch):
                continue
            offset[count] = _dot(normal[count], point) - clear
            extent[count], owner[count] = 1.0, vessels + s
            count += 1
        starts[a + 1] = count
    return Contacts(
        starts,
        normal[:count],
        offset[:count],
        extent[:count],
        owner[:count],
        np.zeros(count),
    )


@kernel
def _turn(
    rotation: NDArray[np.float64], x: float, y: float, z: float, result: NDArray[np.float64]
) -> None:
    for k in range(3):
        result[k] = rotation[k, 0] * x + rotation[k, 1] * y + rotation[k, 2] * z


@kernel
def _dot(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    product: float = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


@kernel
def _behind_glass(
    glass: Glass,
    owner: int,
    point: NDArray[np.float64],
    normal: NDArray[np.float64],
    clear: float,
    scratch: NDArray[np.float64],
) -> bool:
    """Tell whether another vessel's glass is between a point and a wall, such as the bench."""
    start, end, foot = scratch[0], scratch[1], scratch[2]
    for v in range(len(glass.starts) - 1):
        if v == owner:
            continue
        into(glass.origin[v], glass.rotation[v], point, start)
        ball = start[0] ** 2 + start[1] ** 2 + (start[2] - glass.middle[v]) ** 2
        if ball > glass.radius[v] ** 2:
            continue
        for k in range(3):
            foot[k] = point[k] - clear * normal[k]
        into(glass.origin[v], glass.rotation[v], foot, end)
        if first_crossing(glass.edges[glass.starts[v] : glass.starts[v + 1]], start, end)[1] >= 0:
            return True
    return False


@kernel
def _extent(edge: NDArray[np.float64], place: float, reach: float) -> float:
    """Return how much of a plane a wall is at a place along an edge [m].

    At the free end of a wall half a plane is seen, and beyond it less.
    """
    part = 1.0
    if edge[OPEN_START] > 0.0:
        part = min(part, 0.5 + place / reach)
    elif place < 0.0:
        return 0.0
    beyond = place - edge[LENGTH]
    if edge[OPEN_END] > 0.0:
        part = min(part, 0.5 - beyond / reach)
    elif beyond > 0.0:
        return 0.0
    return min(part, 1.0)
