"""Properties of liquids for the solver: of the scene, of every substance, of every particle."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.solver.smoothing import SECOND_MOMENT
from labutopia_lerobot.substances.substance import Substance

LIQUID_HZ = 150
"""Steps per second as a rule: one for every two of physics. A step moves the fastest wall that the
robot can swing, 2 m/s, by less than three particles."""

DEEP_HZ = 300
"""Steps per second of a deep liquid: one for every step of physics."""

_DEEP = 0.9
"""A liquid is deep if gravity * depth / (`LIQUID_HZ` * spacing)^2 is more than this. The push that
a particle needs in a step goes with it: at 1.1 liquid lies still, at 2.2 it boils (measured)."""

_ITERATIONS = {LIQUID_HZ: 4, DEEP_HZ: 2}
"""Times that a step moves particles apart."""

GRAVITY = 9.81
"""Acceleration of free fall [m/s^2], as in MuJoCo."""

REACH = 2.0
"""Reach of the kernel in particle spacings: some thirty neighbours in the bulk."""

PACKING = 0.925
"""Density of a packed liquid in sums of the kernel. A cubic lattice has 1; this makes up for what a
settled liquid is compressed by when corrections end after a few iterations (`docs/liquids.md`)."""

_LEAST_VISCOSITY = 0.02
"""Part of the velocity difference to its neighbours that a particle always loses in a step: less
than this, 12 times water's viscosity at 0.1 ml, cannot be distinguished at this resolution."""

_MOST_VISCOSITY = 0.5
"""Part that may be evened out at once; a thicker liquid takes several passes."""

_COHESION = 0.1
"""Pull between particles per surface tension / (density * spacing^2)."""


class Flow(NamedTuple):
    """Numbers that all the liquid of a scene has in common.

    Attributes:
        hertz: Steps per second.
        iterations: Times that a step moves particles apart.
        spacing: Edge of the cube that a particle's volume fills [m].
        passes: Passes of viscosity and cohesion per step.
    """

    hertz: int
    iterations: int
    spacing: float
    passes: int


class Matter(NamedTuple):
    """Properties of each particle, as the solver needs them; shape (n,) each.

    Masses are those of particles of the lightest substance in the scene: an inverse mass, by which
    corrections and changes of velocity are multiplied, is then hardly ever more than 1. Where there
    is one substance and nothing is dissolved, all are 1, and no result differs by a bit from what
    it is without masses.

    Attributes:
        mass: Relative mass.
        lightness: Its inverse.
        viscosity: Part of the velocity difference that is evened out in a pass.
        thickness: Half of that times the mass: what the particle adds to a pair's exchange.
        cohesion: Half of the greatest momentum by one neighbour in a pass, per unit mass [m/s].
    """

    mass: NDArray[np.float64]
    lightness: NDArray[np.float64]
    viscosity: NDArray[np.float64]
    thickness: NDArray[np.float64]
    cohesion: NDArray[np.float64]


class Mixing:
    """The substances of a scene, at its resolution: from what particles are made of to numbers.

    Args:
        substances: All that there are, each once.
        volume: Of a particle [m^3].
        depth: How deep all of it would be [m].

    Attributes:
        flow: Numbers common to all particles.
        density: Of the lightest substance [kg/m^3], which relative masses refer to.
    """

    def __init__(self, substances: Sequence[Substance], volume: float, depth: float) -> None:
        spacing = volume ** (1 / 3)
        deep = GRAVITY * depth > _DEEP * (LIQUID_HZ * spacing) ** 2
        hertz = DEEP_HZ if deep else LIQUID_HZ
        dt = 1.0 / hertz
        self.density = min(substance.density for substance in substances)
        self._unit = self.density * volume
        self._mass = np.array([substance.density / self.density for substance in substances])
        wanted = np.array([_viscosity(substance, spacing, dt) for substance in substances])
        passes = int(np.ceil((self._mass * wanted).max() / _MOST_VISCOSITY))
        self.flow = Flow(hertz, _ITERATIONS[hertz], spacing, passes)
        self._viscosity = wanted / passes
        pulls = np.array([s.surface_tension / (s.density * spacing**2) for s in substances])
        self._cohesion = _COHESION * pulls * dt / passes

    def matter(
        self, amounts: NDArray[np.float64], solutes: NDArray[np.float64] | float = 0.0
    ) -> Matter:
        """Return what particles are made of.

        What is dissolved weighs, but changes neither the dynamic viscosity nor the surface tension.

        Volumes add up, so that densities mix by volume; surface tensions do so to first order.
        Viscosities mix by their logarithms (Arrhenius 1887, "Ueber die innere Reibung verduennter
        waesseriger Loesungen", Z. Phys. Chem. 1, 285).

        Args:
            amounts: Part of each particle's volume that is each substance, shape (n, substances).
            solutes: By how much each is heavier than that, shape (n,) [kg].
        """
        pure_mass = amounts @ self._mass
        cohesion = (amounts @ (self._mass * self._cohesion)) / pure_mass
        # What is pure has its substance's own numbers, to the last bit.
        pure, kind = amounts.max(axis=1, initial=0.0) == 1.0, amounts.argmax(axis=1)
        mixed = np.exp(amounts @ np.log(self._viscosity))
        viscosity = np.where(pure, self._viscosity[kind], mixed)
        cohesion = np.where(pure, self._cohesion[kind], cohesion)
        half, mass = 0.5 * pure_mass, pure_mass + solutes / self._unit
        return Matter(mass, 1.0 / mass, viscosity, half * viscosity, half * cohesion)


def _viscosity(substance: Substance, spacing: float, dt: float) -> float:
    """Return the part of velocity differences that is to be evened out in a step.

    Evening out a part c of the difference in every step of duration dt spreads momentum like the
    kinematic viscosity c M / (2 dt), where M is the kernel's second moment along an axis.
    """
    moment = SECOND_MOMENT * (REACH * spacing) ** 2
    return _LEAST_VISCOSITY + 2 * substance.kinematic_viscosity * dt / moment
