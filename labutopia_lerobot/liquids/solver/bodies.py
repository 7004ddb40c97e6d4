"""The vessels and shapes that liquid is among: where they were, where they are."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.liquids.solver.obstacles import distance
from labutopia_lerobot.liquids.solver.walls import (
    HEIGHT,
    NORMAL_R,
    NORMAL_Z,
    RADIUS,
    distance_to_glass,
    first_crossing,
    stop_at_glass,
)

_ROUNDS = 4
"""Turns that every vessel gets at most, to stop what another one has moved."""

_LEAST_STEP = 2e-4
"""How far one goes on a way at least before the distance to a shape is asked again [m]; ours."""


class BodyFrames(NamedTuple):
    """Poses of bodies.

    Attributes:
        origin: Shape (bodies, 3), metres, world frame.
        rotation: Axes as columns, world frame, shape (bodies, 3, 3).
    """

    origin: NDArray[np.float64]
    rotation: NDArray[np.float64]


class Glass(NamedTuple):
    """The vessels.

    Attributes:
        edges: Of all vessels, one after the other, shape (edges, 9) (see `walls`).
        starts: Index of the first edge of each vessel, shape (vessels + 1,).
        middle: Height of the middle of each vessel [m], shape (vessels,).
        radius: Of the ball around that, which holds the vessel [m], shape (vessels,).
        before: Where they were at the beginning of the step.
        now: Where they are at its end.
    """

    edges: NDArray[np.float64]
    starts: NDArray[np.int64]
    middle: NDArray[np.float64]
    radius: NDArray[np.float64]
    before: BodyFrames
    now: BodyFrames


class Shapes(NamedTuple):
    """Everything else.

    Attributes:
        kind: See `obstacles`, shape (shapes,).
        size: As MuJoCo's geom_size, shape (shapes, 3), metres.
        fixed: Whether they can never move, shape (shapes,).
        before: Where they were at the beginning of the step.
        now: Where they are at its end.
    """

    kind: NDArray[np.int64]
    size: NDArray[np.float64]
    fixed: NDArray[np.bool_]
    before: BodyFrames
    now: BodyFrames


@kernel
def into(
    frames: BodyFrames, body: int, point: NDArray[np.float64], result: NDArray[np.float64]
) -> None:
    """Express a point of the world, shape (3,), in the frame of a body."""
    origin, rotation = frames.origin, frames.rotation
    x, y, z = point[0] - origin[body, 0], point[1] - origin[body, 1], point[2] - origin[body, 2]
    for k in range(3):
        result[k] = rotation[body, 0, k] * x + rotation[body, 1, k] * y + rotation[body, 2, k] * z


@kernel
def out_of(
    frames: BodyFrames, body: int, point: NDArray[np.float64], result: NDArray[np.float64]
) -> None:
    """Express a point in the frame of a body, shape (3,), in the world."""
    origin, rotation = frames.origin, frames.rotation
    for k in range(3):
        result[k] = origin[body, k] + (
            rotation[body, k, 0] * point[0]
            + rotation[body, k, 1] * point[1]
            + rotation[body, k, 2] * point[2]
        )


@kernel
def clearances(
    start: NDArray[np.float64], end: NDArray[np.float64], glass: Glass
) -> NDArray[np.float64]:
    """Return how far from every vessel's glass particles stay while they and the vessels move.

    In the frame of a vessel, a particle goes straight from where it was to where it is.

    Args:
        start: Where particles were, shape (n, 3), metres, world frame.
        end: Where they are to go, shape (n, 3).
        glass: The vessels.

    Returns:
        A lower bound [m], shape (vessels, n); negative where a particle may come to the glass.
    """
    clear = np.empty((len(glass.starts) - 1, len(start)))
    p, q = np.empty(3), np.empty(3)
    for v in range(len(clear)):
        edges = glass.edges[glass.starts[v] : glass.starts[v + 1]]
        middle, radius = glass.middle[v], glass.radius[v]
        for a in range(len(start)):
            into(glass.before, v, start[a], p)
            into(glass.now, v, end[a], q)
            square = p[0] * p[0] + p[1] * p[1]
            away = np.sqrt(square + (p[2] - middle) ** 2) - radius
            far = np.sqrt((q[0] - p[0]) ** 2 + (q[1] - p[1]) ** 2 + (q[2] - p[2]) ** 2)
            if away < radius:
                away = distance_to_glass(edges, np.sqrt(square), p[2])
            clear[v, a] = away - far
    return clear


@kernel
def stop_at_vessels(
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    glass: Glass,
    clear: NDArray[np.float64],
    mass: NDArray[np.float64],
    impulse: NDArray[np.float64],
) -> None:
    """Let no particle pass through glass while it and the vessels move.

    What one vessel moves may come to another one's glass, as in a spout inside a mouth: vessels
    take turns until none has to move the particle.

    Args:
        start: Where particles were, outside all glass, shape (n, 3), metres, world frame.
        end: Where they are to go; changed in place.
        glass: The vessels.
        clear: See `clearances`; reduced by what particles are moved.
        mass: Relative masses of the particles, shape (n,).
        impulse: How the vessels moved particles: the sum of displacements [m] times masses, and of
            their moments about the world's origin [m^2], shape (owners, 6); added to.
    """
    p, q, moved = np.empty(3), np.empty(3), np.empty(3)
    vessels = len(clear)
    for a in range(len(start)):
        if not _may_meet(clear, a):
            continue
        v, quiet = -1, 0
        for _ in range(_ROUNDS * vessels):
            if quiet == vessels:
                break
            v = (v + 1) % vessels
            quiet += 1
            if clear[v, a] >= 0.0:
                continue
            into(glass.before, v, start[a], p)
            into(glass.now, v, end[a], q)
            if stop_at_glass(glass.edges[glass.starts[v] : glass.starts[v + 1]], p, q):
                moved[:] = end[a]
                out_of(glass.now, v, q, end[a])
                moved[:] = end[a] - moved
                clear[:, a] -= np.sqrt(np.sum(moved**2))
                moved *= mass[a]
                add_moment(impulse[v], end[a], moved)
                quiet = 1


@kernel
def free_way(
    start: NDArray[np.float64], end: NDArray[np.float64], glass: Glass, shapes: Shapes
) -> float:
    """Return how much of a straight way nothing is in, 0 to 1.

    Args:
        start: Where it begins, outside all glass, shape (3,), metres, world frame. A shape that
            this is in, such as the piece that liquid leaves, is not in the way.
        end: Where it ends.
        glass: The vessels.
        shapes: Everything else.
    """
    p, q, free = np.empty(3), np.empty(3), 1.0
    for v in range(len(glass.starts) - 1):
        into(glass.now, v, start, p)
        into(glass.now, v, end, q)
        edges = glass.edges[glass.starts[v] : glass.starts[v + 1]]
        free = min(free, first_crossing(edges, p, q)[0])
    for s in range(len(shapes.kind)):
        into(shapes.now, s, start, p)
        into(shapes.now, s, end, q)
        free = min(free, _way_to_shape(shapes.kind[s], shapes.size[s], p, q))
    return free


@kernel
def no_glass_between(
    points: NDArray[np.float64], end: NDArray[np.float64], glass: Glass, thin: float
) -> NDArray[np.bool_]:
    """Return which points have no glass on the straight way to another one, shape (n,).

    Args:
        points: Outside all glass, shape (n, 3), metres, world frame.
        end: The other one, shape (3,).
        glass: The vessels.
        thin: How deep that may be in a surface [m].
    """
    clear = np.ones(len(points), np.bool_)
    p, q = np.empty(3), np.empty(3)
    for v in range(len(glass.starts) - 1):
        edges = glass.edges[glass.starts[v] : glass.starts[v + 1]]
        into(glass.now, v, end, q)
        radius = np.sqrt(q[0] ** 2 + q[1] ** 2)
        for a in range(len(points)):
            into(glass.now, v, points[a], p)
            _, k = first_crossing(edges, p, q)
            if k >= 0:
                beyond = edges[k, NORMAL_R] * (radius - edges[k, RADIUS])
                beyond += edges[k, NORMAL_Z] * (q[2] - edges[k, HEIGHT])
                clear[a] &= beyond >= -thin
    return clear


@kernel
def _way_to_shape(
    kind: int, size: NDArray[np.float64], start: NDArray[np.float64], end: NDArray[np.float64]
) -> float:
    """Return how much of a straight way, in the frame of a shape, it is not in; all of it if 1."""
    x, y, z = end[0] - start[0], end[1] - start[1], end[2] - start[2]
    far = np.sqrt(x * x + y * y + z * z)
    gone = 0.0
    while gone < far:
        t = gone / far
        room, _ = distance(kind, size, start[0] + t * x, start[1] + t * y, start[2] + t * z)
        if room < 0.0:
            return max(0.0, gone - _LEAST_STEP) / far if gone > 0.0 else 1.0
        gone += max(room, _LEAST_STEP)
    return 1.0


@kernel
def _may_meet(clear: NDArray[np.float64], a: int) -> bool:
    """Return whether a particle may come to the glass of any vessel."""
    near = False
    for v in range(len(clear)):
        near |= clear[v, a] < 0.0
    return near


@kernel
def add_moment(
    impulse: NDArray[np.float64], at: NDArray[np.float64], moved: NDArray[np.float64]
) -> None:
    """Add a vector, shape (3,), and its moment about the world's origin to a sum, shape (6,)."""
    for k in range(3):
        impulse[k] += moved[k]
    impulse[3] += at[1] * moved[2] - at[2] * moved[1]
    impulse[4] += at[2] * moved[0] - at[0] * moved[2]
    impulse[5] += at[0] * moved[1] - at[1] * moved[0]
