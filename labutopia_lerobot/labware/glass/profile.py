"""The half cross-section of a vessel of revolution, and every number that follows from it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

type Point = tuple[float, float]
"""Radius and height [m] of a corner of a polyline."""

BOROSILICATE_DENSITY = 2230.0
"""Density of borosilicate glass 3.3 [kg/m^3] (ISO 3585; Schott Duran data sheet: 2.23 g/cm^3)."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)


class MassProperties(NamedTuple):
    """Rigid-body properties of a body of revolution about the vertical axis."""

    mass: float
    """Mass [kg]."""
    com_height: float
    """Height of the centre of mass above the base [m]."""
    transverse_inertia: float
    """Moment of inertia about a horizontal axis through the centre of mass [kg m^2]."""
    axial_inertia: float
    """Moment of inertia about the vertical axis [kg m^2]."""


@dataclass(frozen=True)
class Profile:
    """A glass wall turned about the vertical axis; hashable.

    Attributes:
        outer: (radius, height) corners [m] of the outer surface, from the rim the vessel stands on
            (height 0) up to the lip; heights increase strictly.
        wall: Wall thickness, measured horizontally [m].
        bottom: Thickness of the bottom [m]; 0 of what is open below, as funnels are.

    Raises:
        ValueError: The polyline does not rise from height 0, or the walls leave no cavity.
    """

    outer: tuple[Point, ...]
    wall: float
    bottom: float

    def __post_init__(self) -> None:
        heights = [height for _, height in self.outer]
        if len(heights) < 2 or heights[0] != 0 or any(b <= a for a, b in pairwise(heights)):
            raise ValueError(f"heights must rise strictly from 0 to the lip, not {heights}")
        if not 0 <= self.bottom < heights[-1]:
            raise ValueError(f"bottom must lie between 0 and {heights[-1]} m, not {self.bottom}")
        narrowest = min(radius for radius, _ in self.outer)
        if not 0 < self.wall < narrowest:
            raise ValueError(f"wall must lie between 0 and {narrowest} m, not {self.wall}")

    @property
    def height(self) -> float:
        """Height of the lip above the base [m]."""
        return self.outer[-1][1]

    @property
    def open_below(self) -> bool:
        """Whether it has no bottom: what is poured in runs out."""
        return self.bottom == 0

    @cached_property
    def inner(self) -> tuple[Point, ...]:
        """(radius, height) corners [m] of the cavity, from the inner bottom up to the lip."""
        heights = [self.bottom, *(height for _, height in self.outer if height > self.bottom)]
        return tuple((self.inner_radius(height), height) for height in heights)

    def outer_radius(self, height: float) -> float:
        """Return the radius of the outer surface at `height` [m]."""
        radii, heights = zip(*self.outer, strict=True)
        return float(np.interp(height, heights, radii))

    def outer_height(self, radius: float) -> float:
        """Return where the outside first is as wide as `radius`, no less than its base [m]."""
        for (r, z), (s, top) in pairwise(self.outer):
            if r <= radius < s:
                return z + (top - z) * (radius - r) / (s - r)
        return self.height

    def inner_radius(self, height: float) -> float:
        """Return the radius of the cavity at `height` [m], for heights above the inner bottom."""
        return self.outer_radius(height) - self.wall

    @cached_property
    def capacity(self) -> float:
        """Volume [m^3] of the whole cavity."""
        return self.capacity_below(self.height)

    @cached_property
    def _levels(self) -> tuple[NDArray[np.floating], NDArray[np.floating]]:
        """Heights [m] from the inner bottom to the lip and the volumes [m^3] below them."""
        radii, corners = zip(*self.inner, strict=True)
        heights = np.linspace(self.bottom, self.height, 256)
        r = np.interp(heights, corners, radii)
        frusta = np.pi / 3 * (r[:-1] ** 2 + r[:-1] * r[1:] + r[1:] ** 2) * np.diff(heights)
        return heights, np.cumsum([0.0, *frusta])

    def capacity_below(self, height: float) -> float:
        """Return the volume [m^3] of the cavity below `height` [m]."""
        top = min(height, self.height)
        if top <= self.bottom:
            return 0.0
        below = [point for point in self.inner if point[1] < top]
        return float(_moments([*below, (self.inner_radius(top), top)])[0])

    def fill_height(self, volume: float) -> float:
        """Return the height [m] that a `volume` [m^3] of liquid reaches, within 0.1 mm.

        Raises:
            ValueError: The vessel does not hold that much.
        """
        if not 0 <= volume <= self.capacity:
            raise ValueError(
                f"volume must lie between 0 and {self.capacity:.2e} m^3, not {volume:.2e}"
            )
        heights, volumes = self._levels
        return float(np.interp(volume, volumes, heights))

    def depth(self, volume: float) -> float:
        """Return how deep a `volume` [m^3] of liquid is when the vessel stands upright [m]."""
        return self.fill_height(min(volume, self.capacity)) - self.bottom

    def mass_properties(self, density: float = BOROSILICATE_DENSITY) -> MassProperties:
        """Return mass, centre of mass and principal inertia of the wall at `density` [kg/m^3]."""
        solid = density * (_moments(self.outer) - _moments(self.inner))
        mass, first, transverse, axial = (float(moment) for moment in solid)
        return MassProperties(mass, first / mass, transverse - first**2 / mass, axial)


def _moments(points: Sequence[Point]) -> NDArray[np.float64]:
    """Integrate a solid of revolution of unit density, exactly.

    A stack of discs of radius r(z): volume and first moment are the integrals of pi r^2 and
    pi r^2 z; the second moment of a disc is pi r^4 / 4 about its diameter, moved to height 0 by
    Steiner's theorem, and pi r^4 / 2 about its axis. With r linear between corners these are
    polynomials of degree 4 at most, for which three Gauss-Legendre nodes are exact (degree 5).

    Args:
        points: (radius, height) corners [m], rising.

    Returns:
        Shape (4,): volume [m^3], first moment about height 0 [m^4], second moments about a
        horizontal axis at height 0 and about the vertical axis [m^5].
    """
    corners = np.asarray(points, dtype=float)
    lower, upper = corners[:-1, :, None], corners[1:, :, None]
    radius, height = np.moveaxis((lower + upper) / 2 + (upper - lower) / 2 * _NODES, 1, 0)
    dz = (upper - lower)[:, 1] / 2 * _WEIGHTS
    area = np.pi * radius**2
    second = area * radius**2
    integrands = (area, area * height, second / 4 + area * height**2, second / 2)
    return np.array([np.sum(integrand * dz) for integrand in integrands])
