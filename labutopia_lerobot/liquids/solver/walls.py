"""Walls of glass: the exact profile of a vessel, to liquid particles in the vessel's own frame.

The half-section of the glass is a closed polygon of (radius, height) corners, walked from the
middle of the cavity's bottom outwards, up the inside, over the lip, down the outside and back under
the base: liquid is always on the left. What is open below has a rim there for the bottom. Turned
about the axis, every edge is a piece of a cone, of which both distances and the crossing of a
straight path are exact.
"""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.labware.glass.profile import Profile

EDGE_NUMBERS = 10

type Edges = NDArray[np.float64]
"""Shape (edges, 10): start (radius, height) [m], direction (radius, height), length [m], normal
towards the liquid (radius, height), whether the wall goes on beyond the start and the end, and
whether it does so smoothly at the start, so that it and the edge before are parts of one wall."""

(
    RADIUS,
    HEIGHT,
    ALONG_R,
    ALONG_Z,
    LENGTH,
    NORMAL_R,
    NORMAL_Z,
    OPEN_START,
    OPEN_END,
    SMOOTH_START,
) = range(EDGE_NUMBERS)

_SMOOTH = 0.3
"""Sine of the angle up to which a joint is none: a curved wall cut into edges."""

SKIN = 2e-5
"""Distance of a stopped particle from the glass [m]: enough for rounding, too little to see."""

_ROUNDING = 1e-7
"""Two edges overlap by this much [m], so that nothing slips through between them."""

_TRIES = 4


def edges_of(profile: Profile) -> Edges:
    """Return the edges of a profile's glass."""
    inner, outer = profile.inner, profile.outer
    corners = [(0.0, profile.bottom), *inner, *outer[::-1], (0.0, 0.0)]
    if profile.open_below:  # its lower rim is the first edge, and closes the polygon
        corners = [outer[0], *inner, *outer[::-1]]
    starts, ends = np.array(corners[:-1]), np.array(corners[1:])
    along = ends - starts
    length = np.linalg.norm(along, axis=1)
    keep = length > 1e-9
    starts, along, length = starts[keep], along[keep], length[keep]
    along /= length[:, None]
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    # Where the polygon turns left, the liquid is in a corner and there is no wall beyond it; where
    # it goes straight on or turns right, the wall goes on around the corner.
    turn = along[:-1, 0] * along[1:, 1] - along[:-1, 1] * along[1:, 0]
    goes_on = (turn < _SMOOTH).astype(float)
    ends_open = float(profile.open_below)
    first, last = np.append(ends_open, goes_on), np.append(goes_on, ends_open)
    ahead = np.sum(along[:-1] * along[1:], axis=1) > 0.0
    smooth = np.append(0.0, (ahead & (abs(turn) < _SMOOTH)).astype(float))
    return np.column_stack([starts, along, length, normal, first, last, smooth])


@kernel
def holds(edges: Edges, inner: int, x: float, y: float, z: float) -> bool:
    """Return whether a point of the vessel's frame [m] is in the cavity.

    Args:
        edges: Of the glass.
        inner: Number of edges of the cavity: its bottom and the inside of its wall.
        x: Of the point.
        y: Of the point.
        z: Of the point.
    """
    if z <= edges[0, HEIGHT]:
        return False
    radius = np.sqrt(x * x + y * y)
    for k in range(1, inner):
        rise = edges[k, ALONG_Z] * edges[k, LENGTH]
        part = (z - edges[k, HEIGHT]) / rise
        if 0.0 <= part <= 1.0:
            limit: float = edges[k, RADIUS] + part * edges[k, ALONG_R] * edges[k, LENGTH]
            inside: bool = radius < limit
            return inside
    return False


@kernel
def in_glass(edges: Edges, x: float, y: float, z: float) -> bool:
    """Return whether a point of the vessel's frame [m] is within the glass (even-odd rule)."""
    radius = np.sqrt(x * x + y * y)
    odd = False
    for k in range(len(edges)):
        z0 = edges[k, HEIGHT]
        z1 = z0 + edges[k, ALONG_Z] * edges[k, LENGTH]
        if (z0 > z) != (z1 > z):
            r0 = edges[k, RADIUS]
            at = r0 + (z - z0) / (z1 - z0) * edges[k, ALONG_R] * edges[k, LENGTH]
            if radius < at:
                odd = not odd
    return odd


@kernel
def distance_to_glass(edges: Edges, radius: float, height: float) -> float:
    """Return the distance [m] of a point from the surface of the glass, on either side of it.

    What is nearest on a surface of revolution lies in the half-plane through the axis and the
    point, so that this is the distance from the edges of the half-section.

    Args:
        edges: Of the glass.
        radius: Of the point [m], vessel's frame.
        height: Of the point [m], vessel's frame.
    """
    least = np.inf
    for k in range(len(edges)):
        r, z = radius - edges[k, RADIUS], height - edges[k, HEIGHT]
        place = edges[k, ALONG_R] * r + edges[k, ALONG_Z] * z
        beyond = place - min(max(place, 0.0), edges[k, LENGTH])
        across = edges[k, NORMAL_R] * r + edges[k, NORMAL_Z] * z
        least = min(least, across * across + beyond * beyond)
    distance: float = np.sqrt(least)
    return distance


@kernel
def _crossing(
    edge: NDArray[np.float64], px: float, py: float, pz: float, dx: float, dy: float, dz: float
) -> float:
    """Return the t from 0 to 1 at which p + t d enters the glass through an edge; 2 if none."""
    r0, z0, tr, tz = edge[RADIUS], edge[HEIGHT], edge[ALONG_R], edge[ALONG_Z]
    nr, nz, length = edge[NORMAL_R], edge[NORMAL_Z], edge[LENGTH]
    # On the cone: nr (r - r0) + nz (z - z0) = 0, that is (nr r)^2 = (c + nz dz t)^2 with the right
    # sign of r.
    c0 = nr * r0 - nz * (pz - z0)
    c1 = -nz * dz
    a = nr * nr * (dx * dx + dy * dy) - c1 * c1
    b = nr * nr * (px * dx + py * dy) - c0 * c1
    c = nr * nr * (px * px + py * py) - c0 * c0
    first, second = 2.0, 2.0
    if nr == 0.0:
        if c1 != 0.0:
            first = -c0 / c1
    elif abs(a) < 1e-14 * nr * nr:
        if b != 0.0:
            first = -c / (2.0 * b)
    else:
        discriminant = b * b - a * c
        if discriminant < 0.0:
            return 2.0
        root = np.sqrt(discriminant)
        # The stable pair of roots: never the difference of two nearly equal numbers.
        pivot = -(b + root) if b > 0.0 else root - b
        first = pivot / a
        second = c / pivot if pivot != 0.0 else 2.0
        if second < first:
            first, second = second, first
    for t in (first, second):
        if 0.0 <= t <= 1.0:
            x, y, z = px + t * dx, py + t * dy, pz + t * dz
            r = np.sqrt(x * x + y * y)
            place = (r - r0) * tr + (z - z0) * tz
            if -_ROUNDING <= place <= length + _ROUNDING:
                dr = (x * dx + y * dy) / r if r > 0.0 else np.sqrt(dx * dx + dy * dy)
                # The equation also knows the mirror image of the cone, beyond the axis.
                on_cone = abs(nr * (r - r0) + nz * (z - z0)) < _ROUNDING
                if on_cone and nr * dr + nz * dz < 0.0:
                    return t
    return 2.0


@kernel
def first_crossing(
    edges: Edges, start: NDArray[np.float64], end: NDArray[np.float64]
) -> tuple[float, int]:
    """Return when (0 to 1) a straight path first enters the glass, and through which edge.

    Args:
        edges: Of the glass.
        start: Where the path begins, outside the glass, shape (3,), metres, vessel's frame.
        end: Where it ends.

    Returns:
        The fraction of the path and the index of the edge; (2, -1) if it does not.
    """
    px, py, pz = start
    dx, dy, dz = end[0] - px, end[1] - py, end[2] - pz
    rp = np.sqrt(px * px + py * py)
    rq = np.sqrt(end[0] ** 2 + end[1] ** 2)
    far = np.sqrt(dx * dx + dy * dy + dz * dz)
    best, hit = 2.0, -1
    for k in range(len(edges)):
        nr, nz = edges[k, NORMAL_R], edges[k, NORMAL_Z]
        from_start = nr * (rp - edges[k, RADIUS]) + nz * (pz - edges[k, HEIGHT])
        if from_start > far:
            continue
        if nr <= 0.0:
            # The radius is convex along a straight path, so this distance is concave: between two
            # points in front of such an edge there is none behind it.
            to_end = nr * (rq - edges[k, RADIUS]) + nz * (end[2] - edges[k, HEIGHT])
            if from_start > 0.0 and to_end > 0.0:
                continue
        t = _crossing(edges[k], px, py, pz, dx, dy, dz)
        if -_ROUNDING < from_start <= 0.0:
            # Rounded to the wrong side of the surface: deeper it does not go.
            place = (rp - edges[k, RADIUS]) * edges[k, ALONG_R]
            place += (pz - edges[k, HEIGHT]) * edges[k, ALONG_Z]
            to_end = nr * (rq - edges[k, RADIUS]) + nz * (end[2] - edges[k, HEIGHT])
            if -_ROUNDING <= place <= edges[k, LENGTH] + _ROUNDING and to_end < from_start:
                t = 0.0
        if t < best:
            best, hit = t, k
    return best, hit


@kernel
def stop_at_glass(edges: Edges, start: NDArray[np.float64], end: NDArray[np.float64]) -> bool:
    """Shorten a straight path so that it does not enter the glass; `end` slides along the wall.

    Args:
        edges: Of the glass.
        start: Where the path begins, outside the glass, shape (3,), metres, vessel's frame.
        end: Where it ends; changed in place.

    Returns:
        Whether anything had to be changed.
    """
    changed = False
    for attempt in range(_TRIES):
        t, k = first_crossing(edges, start, end)
        if k < 0:
            return changed
        changed = True
        nr, nz = edges[k, NORMAL_R], edges[k, NORMAL_Z]
        radius = np.sqrt(end[0] ** 2 + end[1] ** 2)
        beyond = nr * (radius - edges[k, RADIUS]) + nz * (end[2] - edges[k, HEIGHT])
        moved = radius + nr * (SKIN - beyond)
        if attempt + 1 < _TRIES and beyond < SKIN and radius > 0.0 and moved > 0.0:
            end[0] *= moved / radius
            end[1] *= moved / radius
            end[2] += nz * (SKIN - beyond)
        else:
            # Before the wall, on the path itself, which is free up to there.
            far = np.sqrt(np.sum((end - start) ** 2))
            t = max(0.0, t - SKIN / far) if far > 0.0 else 0.0
            end[:] = start + t * (end - start)
            return True
    return changed
