"""The smoothing kernel: how much a particle counts at a distance, and what a wall counts for.

The cubic spline of Monaghan (1992, "Smoothed Particle Hydrodynamics", section 3), scaled so that it
ends at the distance 1, in three dimensions.
"""

from inspect import unwrap

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.kernel import kernel

_WALL_ENTRIES = 128


@kernel
def weight(q: float) -> float:
    """Return W(q) h^3 at the distance q h."""
    if q >= 1.0:
        return 0.0
    if q < 0.5:
        return 8.0 / np.pi * (1.0 - 6.0 * q * q * (1.0 - q))
    rest = 1.0 - q
    return 16.0 / np.pi * (rest * (rest * rest))  # not `** 3`, which rounds otherwise in Python


@kernel
def slope(q: float) -> float:
    """Return the derivative of `weight` over the distance, W'(q) h^3 / q; negative, also at 0."""
    if q >= 1.0:
        return 0.0
    if q < 0.5:
        return -48.0 / np.pi * (2.0 - 3.0 * q)
    return -48.0 / np.pi * (1.0 - q) ** 2 / q


_uncompiled_weight = unwrap(weight)
"""The same to the last bit: a few thousand values are not worth loading numba."""


def _integrate(values: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Return the integral from every entry to the last, by the trapezoidal rule."""
    strips = (values[1:] + values[:-1]) * step / 2
    return np.append(np.cumsum(strips[::-1])[::-1], 0.0)


def _wall_tables() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Integrate the kernel over the half-space behind a wall.

    At the distance s from a plane wall, a sheet at depth z counts 2 pi times the integral of
    W(r) r over r from z to h; what is behind the wall is the integral of that from s to h.
    """
    fine = np.linspace(0.0, 1.0, 16 * _WALL_ENTRIES + 1)
    sheet = 2 * np.pi * _integrate(np.array([_uncompiled_weight(q) * q for q in fine]), fine[1])
    behind = _integrate(sheet, fine[1])
    return behind[::16].copy(), sheet[::16].copy()


BEHIND_WALL, AT_WALL = _wall_tables()
"""Share of the kernel behind a wall at the distance q = i / 128, and minus its derivative by q."""

_RADII = np.linspace(0.0, 1.0, 2001)
SECOND_MOMENT = float(
    np.trapezoid([4 * np.pi / 3 * q**4 * _uncompiled_weight(q) for q in _RADII], _RADII)
)
"""Integral of x^2 W over space, divided by h^2."""


@kernel
def look_up(table: NDArray[np.float64], q: float) -> float:
    """Interpolate a wall table at the distance q; below 0 it stays what it is at 0."""
    if q >= 1.0:
        return 0.0
    place = max(q, 0.0) * (len(table) - 1)
    index = int(place)
    part = place - index
    value: float = table[index] * (1.0 - part) + table[index + 1] * part
    return value
