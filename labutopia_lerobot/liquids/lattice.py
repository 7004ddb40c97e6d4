"""Particles for a vessel that is filled."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.labware.glass.profile import Profile

_DISORDER = 0.05
"""Particles stand off a perfect lattice by up to this part of the spacing: it would stay one."""

_WALL_GAP = 0.45
"""Distance from the glass in spacings: about where a settled liquid keeps it."""

_TIGHTENING = 0.98


def lattice(
    profile: Profile, count: int, spacing: float, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Return the lowest `count` places of a cubic lattice in a vessel.

    A nearly full vessel, in which so many do not fit, gets a tighter lattice, and runs over.

    Args:
        profile: Of the vessel.
        count: Number of particles.
        spacing: Edge of the cube that each one fills [m].
        rng: Where the disorder comes from.

    Returns:
        Shape (count, 3), metres, vessel's frame.
    """
    places = _places(profile, spacing)
    edge = spacing
    while len(places) < count:
        edge *= _TIGHTENING
        places = _places(profile, edge)
    return places[:count] + rng.uniform(-_DISORDER, _DISORDER, (count, 3)) * edge


def _places(profile: Profile, spacing: float) -> NDArray[np.float64]:
    """Return every place in the cavity, from below, shape (places, 3), metres."""
    layers = []
    widest = max(radius for radius, _ in profile.inner)
    steps = np.arange(-np.ceil(widest / spacing), np.ceil(widest / spacing) + 1) * spacing
    x, y = (grid.ravel() for grid in np.meshgrid(steps, steps))
    for z in np.arange(profile.bottom + 0.5 * spacing, profile.height, spacing).tolist():
        inside = np.hypot(x, y) < profile.inner_radius(z) - _WALL_GAP * spacing
        layers.append(np.column_stack([x[inside], y[inside], np.full(inside.sum(), z)]))
    return np.vstack(layers)
