"""Contacts of particles with walls: each as a plane, computed once per step."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.bodies import BodyFrames, Glass, Shapes, into
from labutopia_lerobot.liquids.solver.obstacles import distance, half_lengths
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
    SMOOTH_START,
    Edges,
    first_crossing,
)

_ROOM = 6
"""Planes per particle that there is room for at first: a corner of a vessel against a hand."""

_ROUNDING = 1e-6
"""What boxes around shapes are too large by [m]."""

_COVER = 3
"""Index of the number of a joined wall that says how much of a plane it covers."""


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

    Edges of glass that follow each other smoothly are one wall: a plane that
    is the mean of theirs, each counting as much as it covers. So it does not matter how finely a
    straight or a round wall is cut.

    Args:
        positions: Shape (n, 3), metres, world frame, none in glass.
        glass: The vessels.
        shapes: Everything else.
        clear: How far from each vessel's glass they are at least [m], shape (vessels, n).
        reach: How far a wall matters [m].
    """
    near = _shapes_near(positions, shapes, reach)
    boxes = _boxes_around(shapes, near, reach)
    joined = np.append(glass.edges[:, SMOOTH_START] > 0.0, False)
    room = _ROOM * len(positions) + len(glass.edges) + len(near)
    while True:
        starts = np.zeros(len(positions) + 1, np.int64)
        normal, offset, extent = np.empty((room, 3)), np.empty(room), np.empty(room)
        contacts = Contacts(starts, normal, offset, extent, np.empty(room, np.int64), np.empty(0))
        if _list_walls(positions, glass, shapes, clear, reach, near, boxes, joined, contacts):
            break
        room *= 2
    count = starts[-1]
    return Contacts(
        starts,
        normal[:count],
        offset[:count],
        extent[:count],
        contacts.owner[:count],
        np.zeros(count),
    )


@kernel
def _list_walls(
    positions: NDArray[np.float64],
    glass: Glass,
    shapes: Shapes,
    clear: NDArray[np.float64],
    reach: float,
    near: NDArray[np.int64],
    boxes: NDArray[np.float64],
    joined: NDArray[np.bool_],
    contacts: Contacts,
) -> bool:
    """List the walls within reach of all particles; return whether there was room for them."""
    vessels, edges = len(glass.starts) - 1, glass.edges
    starts, normal, offset = contacts.starts, contacts.normal, contacts.offset
    extent, owner = contacts.extent, contacts.owner
    local, scratch, wall, count = np.empty(3), np.empty((3, 3)), np.zeros(4), 0
    for a in range(len(positions)):
        if count + len(edges) + len(near) > len(offset):
            return False
        point = positions[a]
        for v in range(vessels):
            if clear[v, a] >= reach:
                continue
            into(glass.now, v, point, local)
            radius = np.sqrt(local[0] ** 2 + local[1] ** 2)
            ux, uy = (local[0] / radius, local[1] / radius) if radius > 0.0 else (1.0, 0.0)
            wall[_COVER] = 0.0
            for e in range(glass.starts[v], glass.starts[v + 1]):
                r, z = radius - edges[e, RADIUS], local[2] - edges[e, HEIGHT]
                nr, nz = edges[e, NORMAL_R], edges[e, NORMAL_Z]
                far = nr * r + nz * z
                cover = 0.0
                if 0.0 <= far < reach:
                    place = edges[e, ALONG_R] * r + edges[e, ALONG_Z] * z
                    cover = _extent(edges, e, place, reach, joined[e] or joined[e + 1])
                if joined[e] or joined[e + 1]:
                    _add_edge(nr, nz, far, cover, wall)
                    if joined[e + 1]:
                        continue
                    nr, nz, far, cover = wall[0], wall[1], wall[2], wall[_COVER]
                    wall[_COVER] = 0.0
                if cover <= 0.0:
                    continue
                _turn(glass.now, v, nr * ux, nr * uy, nz, normal[count])
                if _another_is_nearer(clear, a, v, far) and _behind_glass(
                    glass, clear, a, v, normal[count], point, far, scratch
                ):
                    continue
                offset[count] = _dot(normal[count], point) - far
                extent[count], owner[count] = cover, v
                count += 1
        for index in range(len(near)):
            s = near[index]
            if _outside(boxes[index], point):
                continue
            into(shapes.now, s, point, local)
            far, (nx, ny, nz) = distance(
                shapes.kind[s], shapes.size[s], local[0], local[1], local[2]
            )
            if far >= reach:
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
    return True


@kernel
def _shapes_near(positions: NDArray[np.float64], shapes: Shapes, reach: float) -> NDArray[np.int64]:
    """Return the indices of those shapes that come near the ball around all the liquid."""
    middle, half, local = np.empty(3), np.empty(3), np.empty(3)
    for k in range(3):
        low, high = positions[:, k].min(), positions[:, k].max()
        middle[k], half[k] = 0.5 * (low + high), 0.5 * (high - low)
    around = reach + np.sqrt(np.sum(half**2))
    chosen, count = np.empty(len(shapes.kind), np.int64), 0
    for s in range(len(shapes.kind)):
        into(shapes.now, s, middle, local)
        far, _ = distance(shapes.kind[s], shapes.size[s], local[0], local[1], local[2])
        if far < around:
            chosen[count] = s
            count += 1
    return chosen[:count]


@kernel
def _boxes_around(shapes: Shapes, near: NDArray[np.int64], reach: float) -> NDArray[np.float64]:
    """Return boxes along the world's axes that hold all within reach of shapes [m].

    Args:
        shapes: The shapes.
        near: Indices of those that matter, shape (m,).
        reach: How far from a shape it matters [m].

    Returns:
        Lowest and highest corner of each, shape (m, 2, 3), a little too large for rounding.
    """
    boxes = np.empty((len(near), 2, 3))
    half = np.empty(3)
    for index in range(len(near)):
        s = near[index]
        rotation = shapes.now.rotation[s]
        half_lengths(shapes.kind[s], shapes.size[s], half)
        for k in range(3):
            far = reach + _ROUNDING
            for axis in range(3):
                far += abs(rotation[k, axis]) * half[axis]
            boxes[index, 0, k] = shapes.now.origin[s, k] - far
            boxes[index, 1, k] = shapes.now.origin[s, k] + far
    return boxes


@kernel
def _outside(box: NDArray[np.float64], point: NDArray[np.float64]) -> bool:
    """Return whether a point, shape (3,), is outside a box, shape (2, 3)."""
    beyond = False
    for k in range(3):
        beyond |= point[k] < box[0, k] or point[k] > box[1, k]
    return beyond


@kernel
def _add_edge(nr: float, nz: float, far: float, cover: float, wall: NDArray[np.float64]) -> None:
    """Add an edge to the wall that it is part of.

    Args:
        nr: Normal of the edge, radius.
        nz: The same, height.
        far: Distance of a point from the edge [m].
        cover: How much of a plane it covers there; nothing happens if none.
        wall: Mean normal (radius, height) and distance [m] of the parts so far, and how much of a
            plane they cover, shape (4,); changed in place.
    """
    if cover <= 0.0:
        return
    new = cover / (max(wall[_COVER], 0.0) + cover)
    wr, wz = (1.0 - new) * wall[0] + new * nr, (1.0 - new) * wall[1] + new * nz
    length = np.sqrt(wr * wr + wz * wz)
    wall[0], wall[1] = wr / length, wz / length
    wall[2] += new * (far - wall[2])
    wall[_COVER] = min(wall[_COVER] + cover, 1.0)


@kernel
def _turn(
    frames: BodyFrames, body: int, x: float, y: float, z: float, result: NDArray[np.float64]
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
    """Return whether a vessel may be nearer to a particle than the wall of another owner is."""
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
    """Return whether another vessel's glass is between a particle and a wall, such as the bench."""
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
def _extent(edges: Edges, e: int, place: float, reach: float, in_wall: bool) -> float:
    """Return how much of a plane a wall is at a place along an edge [m].

    At the free end of a wall half a plane is seen, and beyond it less. Of an edge that is part of a
    longer wall only what it covers itself counts: those of all parts add up to that of the wall.
    """
    start, end = 1.0, 1.0
    if edges[e, OPEN_START] > 0.0:
        start = min(start, 0.5 + place / reach)
    elif place < 0.0:
        return 0.0
    beyond = place - edges[e, LENGTH]
    if edges[e, OPEN_END] > 0.0:
        end = min(end, 0.5 - beyond / reach)
    elif beyond > 0.0:
        return 0.0
    if in_wall and start < 1.0 and end < 1.0:
        return start + end - 1.0
    return min(start, end)
