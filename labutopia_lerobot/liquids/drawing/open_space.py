"""Distance from the glass and share of open space, everywhere near a vessel.

Tables over radius and height in the frame of a vessel, so that drawing its liquid costs two
interpolations per point. Open is the cavity and all that is above the rim.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel
from labutopia_lerobot.labware.glass.profile import Profile

_STEP = 1e-3  # an interpolated distance is then exact but within a millimetre of a corner [m]


_FAR = 1.0  # further than anything in a vessel is from its glass [m]


class OpenSpace(NamedTuple):
    """Surroundings of a place at a radius and a height; beyond the tables their edges hold.

    Attributes:
        step: Distance between entries [m].
        lowest: Height of the first entries [m].
        rim: Height above which all space is open [m].
        depth: Distance from the glass [m], negative within and behind it, shape (radii, heights).
        share: Share of a kernel around the place that is in the open, shape (radii, heights).
    """

    step: float
    lowest: float
    rim: float
    depth: NDArray[np.float32]
    share: NDArray[np.float32]


@kernel
def poly6(square: float) -> float:
    """Return the weight (1 - q^2)^3 of a point at q times the kernel's reach, from q^2.

    The "poly6" of Mueller et al. (2003), "Particle-Based Fluid Simulation", equation 20.
    """
    return (1.0 - square) ** 3 if square < 1.0 else 0.0


KERNEL_VOLUME = 64 * np.pi / 315
"""Integral of `poly6` over space, for a reach of 1."""

KERNEL_SLOPE = np.pi / 4 / KERNEL_VOLUME
"""Rate of change, at the plane, of the kernel's share behind a plane, for a reach of 1.

The plane through the middle cuts a disc out of the kernel, whose integral is pi / 4."""


@lru_cache
def inside_vessel(profile: Profile, reach: float) -> OpenSpace:
    """Return the space in and above a vessel, for a kernel of a `reach` [m]."""
    inner = np.array([(0.0, profile.bottom), *profile.inner])
    margin = reach + 4 * _STEP
    widest = max(radius for radius, _ in profile.outer)
    radii = np.arange(0.0, widest + margin, _STEP).astype(np.float64)
    heights = np.arange(-margin, profile.height + margin, _STEP).astype(np.float64)
    depth = np.empty((len(radii), len(heights)), np.float32)
    share = np.empty_like(depth)
    _measure(inner, radii, heights, reach, depth, share)
    return OpenSpace(_STEP, float(heights[0]), profile.height, depth, share)


@lru_cache
def above_plane(reach: float) -> OpenSpace:
    """Return the space above the plane at height 0, for a kernel of a `reach` [m].

    Nothing is hidden behind the plane: what is below it, as when it has run off the bench, is drawn
    as if the plane were not there.
    """
    heights = np.arange(-2, np.ceil(reach / _STEP) + 2) * _STEP
    share = np.ones((2, len(heights)), np.float32)
    for index, height in enumerate(heights):
        if height >= 0.0:
            # The part of the kernel above a plane: the integral of its discs pi / 4 (1 - t^2)^4.
            t = np.linspace(-min(height / reach, 1.0), 1.0, 257)
            share[:, index] = np.trapezoid((1 - t**2) ** 4, t) * np.pi / 4 / KERNEL_VOLUME
    depth = np.full_like(share, _FAR)
    return OpenSpace(_STEP, float(heights[0]), _FAR, depth, share)


class PlacedSpace(NamedTuple):
    """An open space and the frame that its vessel has in the world.

    Attributes:
        space: The tables.
        position_w: Origin of the frame [m], shape (3,).
        rotation_wb: Its axes, as columns, shape (3, 3).
    """

    space: OpenSpace
    position_w: NDArray[np.float64]
    rotation_wb: NDArray[np.float64]


@kernel
def look_up(placed: PlacedSpace, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return what surrounds a point of the world.

    Returns:
        Height above the vessel's base, distance from its glass, negative within and behind it [m],
        and open share; the last two interpolated.
    """
    space, origin, axes = placed.space, placed.position_w, placed.rotation_wb
    dx, dy, dz = x - origin[0], y - origin[1], z - origin[2]
    bx = axes[0, 0] * dx + axes[1, 0] * dy + axes[2, 0] * dz
    by = axes[0, 1] * dx + axes[1, 1] * dy + axes[2, 1] * dz
    height = axes[0, 2] * dx + axes[1, 2] * dy + axes[2, 2] * dz
    radii, heights = space.depth.shape
    a = min(np.sqrt(bx * bx + by * by) / space.step, radii - 1.001)
    b = min(max((height - space.lowest) / space.step, 0.0), heights - 1.001)
    i, j = int(a), int(b)
    a, b = a - i, b - j
    p, q, r, s = (1 - a) * (1 - b), (1 - a) * b, a * (1 - b), a * b
    t, u = space.depth, space.share
    depth = p * t[i, j] + q * t[i, j + 1] + r * t[i + 1, j] + s * t[i + 1, j + 1]
    share = p * u[i, j] + q * u[i, j + 1] + r * u[i + 1, j] + s * u[i + 1, j + 1]
    return height, depth, share


@kernel
def _depth(inner: NDArray[np.float64], r: float, z: float) -> float:
    """Return the distance from the glass, negative out of the open."""
    rim_radius, rim = inner[-1]
    nearest = abs(z - rim) if r > rim_radius else _FAR
    is_open = z > rim
    for k in range(len(inner) - 1):
        (r0, z0), (r1, z1) = inner[k], inner[k + 1]
        length = (r1 - r0) ** 2 + (z1 - z0) ** 2
        t = min(max(((r - r0) * (r1 - r0) + (z - z0) * (z1 - z0)) / length, 0.0), 1.0)
        nearest = min(nearest, np.hypot(r - r0 - t * (r1 - r0), z - z0 - t * (z1 - z0)))
        if z0 < z <= z1:
            is_open = r < r0 + (z - z0) / (z1 - z0) * (r1 - r0)
    return nearest if is_open else -nearest


@kernel
def _measure(
    inner: NDArray[np.float64],
    radii: NDArray[np.float64],
    heights: NDArray[np.float64],
    reach: float,
    depth: NDArray[np.float32],
    share: NDArray[np.float32],
) -> None:
    """Fill the tables; the kernel is summed over a lattice of points, 12 across."""
    for a in range(len(radii)):
        for b in range(len(heights)):
            depth[a, b] = _depth(inner, radii[a], heights[b])
    spacing = reach / 6
    for a in range(len(radii)):
        for b in range(len(heights)):
            if depth[a, b] >= reach:
                share[a, b] = 1.0
                continue
            total, in_open = 0.0, 0.0
            for i in range(12):
                for j in range(6):  # the other half is its mirror image
                    for k in range(12):
                        x, y, z = (i - 5.5) * spacing, (j + 0.5) * spacing, (k - 5.5) * spacing
                        w = poly6((x * x + y * y + z * z) / reach**2)
                        if w > 0.0:
                            far = _depth(inner, np.hypot(radii[a] + x, y), heights[b] + z)
                            total += w
                            in_open += w * min(max(far / spacing + 0.5, 0.0), 1.0)
            share[a, b] = in_open / total
