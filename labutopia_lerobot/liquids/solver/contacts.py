"""Where particles are near walls: each such place as a plane, found once per step."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.solver.bodies import Frames, Glass, Shapes, into
from labutopia_lerobot.liquids.compilation import kernel
from labutopia_lerobot.liquids.solver.obstacles import distance
from labutopia_lerobot.liquids.solver.walls import (
    ALONG_R,
    ALONG_Z,
    HEIGHT,
    LENGTH,
    NORMAL_R,
    NORMAL_Z,
    OPEN_END,
    OPEN_START,
    RADIUS,
    Edges,
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
    positions: NDArray[np.float64],
    glass: Glass,
    shapes: Shapes,
    clear: NDArray[np.float64],
    reach: float,
) -> Contacts:
    """Return every wall within reach of a particle.

    Args:
        positions: Shape (n, 3), metres, world frame, none in glass.
        glass: The vessels.
        shapes: Everything else.
        clear: How far from each vessel's glass they are at least [m], shape (vessels, n).
        reach: How far a wall matters [m].
    """
    n, vessels = len(positions), len(glass.starts) - 1
    room = _MOST * n
    starts = np.zeros(n + 1, np.int64)
    normal, offset, extent = np.empty((room, 3)), np.empty(room), np.empty(room)
    owner = np.empty(room, np.int64)
    # Only shapes that come near the ball around all the liquid.
    middle, half = np.empty(3), np.empty(3)
    for k in range(3):
        low, high = positions[:, k].min(), positions[:, k].max()
        middle[k], half[k] = 0.5 * (low + high), 0.5 * (high - low)
    around = reach + np.sqrt(np.sum(half**2))
    candidates = np.empty(len(shapes.kind), np.int64)
    chosen = 0
    local, scratch, count = np.empty(3), np.empty((3, 3)), 0
    for s in range(len(shapes.kind)):
        into(shapes.now, s, middle, local)
        far, _ = distance(shapes.kind[s], shapes.size[s], local[0], local[1], local[2])
        if far < around:
            candidates[chosen] = s
            chosen += 1
    edges = glass.edges
    for a in range(n):
        limit = count + _MOST
        point = positions[a]
        for v in range(vessels):
            if clear[v, a] >= reach:
                continue
            into(glass.now, v, point, local)
            radius = np.sqrt(local[0] ** 2 + local[1] ** 2)
            ux, uy = (local[0] / radius, local[1] / radius) if radius > 0.0 else (1.0, 0.0)
            for e in range(glass.starts[v], glass.starts[v + 1]):
                r, z = radius - edges[e, RADIUS], local[2] - edges[e, HEIGHT]
                nr, nz = edges[e, NORMAL_R], edges[e, NORMAL_Z]
                far = nr * r + nz * z
                if far < 0.0 or far >= reach:
                    continue
                part = _extent(edges, e, edges[e, ALONG_R] * r + edges[e, ALONG_Z] * z, reach)
                if part <= 0.0 or count == limit:
                    continue
                _turn(glass.now, v, nr * ux, nr * uy, nz, normal[count])
                if _another_is_nearer(clear, a, v, far) and _behind_glass(
                    glass, clear, a, v, normal[count], point, far, scratch
                ):
                    continue
                offset[count] = _dot(normal[count], point) - far
                extent[count], owner[count] = part, v
                count += 1
        for index in range(chosen):
            s = candidates[index]
            into(shapes.now, s, point, local)
            far, (nx, ny, nz) = distance(
                shapes.kind[s], shapes.size[s], local[0], local[1], local[2]
            )
            if far >= reach or count == limit:
                continue
            _turn(shapes.now, s, nx, ny, nz, normal[count])
            if _another_is_nearer(clear, a, -1, far) and _behind_glass(
                glass, clear, a, -1, normal[count], point, far, scratch
            ):
                continue
            offset[count] = _dot(normal[count], point) - far
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
    frames: Frames, body: int, x: float, y: float, z: float, result: NDArray[np.float64]
) -> None:
    """Express a direction in the frame of a body in the world."""
    rotation = frames.rotation
    for k in range(3):
        result[k] = rotation[body, k, 0] * x + rotation[body, k, 1] * y + rotation[body, k, 2] * z


@kernel
def _dot(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    product: float = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


@kernel
def _another_is_nearer(clear: NDArray[np.float64], a: int, owner: int, far: float) -> bool:
    """Tell whether a vessel may be nearer to a particle than the wall of another owner is."""
    nearer = False
    for v in range(len(clear)):
        nearer |= v != owner and clear[v, a] < far
    return nearer


@kernel
def _behind_glass(
    glass: Glass,
    clear: NDArray[np.float64],
    a: int,
    owner: int,
    normal: NDArray[np.float64],
    point: NDArray[np.float64],
    far: float,
    scratch: NDArray[np.float64],
) -> bool:
    """Tell whether another vessel's glass is between a particle and a wall, such as the bench."""
    start, end, foot = scratch[0], scratch[1], scratch[2]
    for k in range(3):
        foot[k] = point[k] - far * normal[k]
    for v in range(len(clear)):
        if v == owner or clear[v, a] >= far:
            continue
        into(glass.now, v, point, start)
        into(glass.now, v, foot, end)
        if first_crossing(glass.edges[glass.starts[v] : glass.starts[v + 1]], start, end)[1] >= 0:
            return True
    return False


@kernel
def _extent(edges: Edges, e: int, place: float, reach: float) -> float:
    """Return how much of a plane a wall is at a place along an edge [m].

    At the free end of a wall half a plane is seen, and beyond it less.
    """
    part = 1.0
    if edges[e, OPEN_START] > 0.0:
        part = min(part, 0.5 + place / reach)
    elif place < 0.0:
        return 0.0
    beyond = place - edges[e, LENGTH]
    if edges[e, OPEN_END] > 0.0:
        part = min(part, 0.5 - beyond / reach)
    elif beyond > 0.0:
        return 0.0
    return min(part, 1.0)
