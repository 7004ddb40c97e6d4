"""Crystals on the bottom of vessels: where they lie at first, and how they go into solution."""

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Inventory
from labutopia_lerobot.world import FloatArray

_TREMBLE = 0.006
"""Mean speed up to which a vessel is at rest [m/s]; ours: its particles have 0.005 then."""

_PLENTY = 2e4
"""More of a solid than dissolves [mol/m^3]; ours: `chemistry.inventory` has as much at most."""
_HALVINGS = 8
"""How often that is halved where the water does not do for it, as where it binds some; ours."""


class Dissolving:
    """The crystals of a scene.

    Args:
        crystals: All that are filled in; of one salt they are of one size.
        inventory: The species.

    Attributes:
        columns: Which species they are, shape (species,).
    """

    def __init__(self, crystals: Iterable[Crystals], inventory: Inventory) -> None:
        self._crystals: dict[int, Crystals] = {}
        self._filled: dict[int, float] = {}
        self._made: dict[int, FloatArray] = {}
        for one in crystals:
            column = inventory.species.index(one.species)
            self._crystals[column] = one
            self._filled[column] = self._filled.get(column, 0.0) + one.mol
            self._made[column] = inventory.row(one.dissolves_into)
        self.columns: NDArray[np.bool_] = np.zeros(len(inventory.species), dtype=bool)
        self.columns[list(self._crystals)] = True
        self._inventory = inventory

    @property
    def grains(self) -> dict[str, float]:
        """Diameter of a grain by species [m]."""
        return {one.species: 1e-3 * one.grain_mm for one in self._crystals.values()}

    @property
    def scattering(self) -> dict[str, float]:
        """What grains that are stirred up scatter out of the way, by species [m^2/kg]."""
        return {one.species: one.scattering for one in self._crystals.values()}

    def heaped(self, amounts: FloatArray) -> float:
        """Return the volume of crystals in a heap, with what is between them [m^3].

        Args:
            amounts: How much there is of each species, shape (species,) [mol].
        """
        return sum(float(amounts[c]) * one.heaped_volume for c, one in self._crystals.items())

    def strew(
        self, contents: FloatArray, heights: FloatArray, layer: float, crystals: Iterable[Crystals]
    ) -> None:
        """Put crystals into what is lowest in a vessel, in place.

        Args:
            contents: Amounts of each species that its particles hold, shape (m, species) [mol].
            heights: Of the particles, shape (m,) [m].
            layer: Height of a layer [m].
            crystals: Those that are put in.
        """
        lowest = np.flatnonzero(heights < heights.min() + layer)
        for one in crystals:
            contents[lowest, self._inventory.species.index(one.species)] += one.mol / len(lowest)

    def dissolve(
        self,
        own: FloatArray,
        everything: FloatArray,
        volume: float,
        temperature: float,
        speed: float,
        period: float,
    ) -> tuple[float, str]:
        """Let crystals of a vessel go into solution where they are, in place.

        As fast as `Crystals.rate` has it, and no more than the solution takes. How much that is
        shows in an equilibrium with more of the solid than can dissolve.

        Args:
            own: Amounts that its particles hold, shape (m, species) [mol].
            everything: Amounts that all particles of the scene hold, shape (species,) [mol].
            volume: Of a particle [m^3].
            temperature: Of the vessel's liquid [K].
            speed: Mean speed in the vessel [m/s].
            period: Time [s].

        Returns:
            The heat [J], and why some did not dissolve, in words, else nothing.
        """
        mean: FloatArray = own.mean(axis=0)
        heat, unknown = 0.0, ""
        for column, one in self._crystals.items():
            if not mean[column]:
                continue
            taken, why = self._taken(column, mean, volume, temperature)
            unknown = unknown or why
            left = float(everything[column]) / self._filled[column]
            rate = one.rate(left, max(0.0, speed - _TREMBLE), taken / volume)
            part = min(-math.expm1(-rate * period), taken / float(mean[column]))
            going = part * own[:, column]
            own += np.outer(going, self._made[column])
            own[:, column] -= going
            enthalpies = self._inventory.enthalpies
            heat += float(going.sum() * (enthalpies[column] - self._made[column] @ enthalpies))
        return heat, unknown

    def _taken(
        self, column: int, mean: FloatArray, volume: float, temperature: float
    ) -> tuple[float, str]:
        """Return how much of a solid a particle takes [mol]; and why that is not known, if not."""
        why = ""
        for halvings in range(_HALVINGS):
            with_more = mean.copy()
            with_more[column] += _PLENTY / 2**halvings * volume
            goal, why = self._inventory.settled(with_more, volume, temperature)
            if not why:
                return max(0.0, float(with_more[column] - goal[column])), ""
        return 0.0, why
