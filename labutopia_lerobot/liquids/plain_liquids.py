"""Liquids in which nothing is dissolved, as chemistry has them: water, other liquids, mixtures."""

import math
from collections.abc import Sequence

import numpy as np

from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.network import HYDROXIDE, log_k_at, network
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.substances.substance import WATER, Substance
from labutopia_lerobot.world import FloatArray, Solution


class PlainLiquids:
    """The chemical state of liquids that hold nothing and do not react; volumes add.

    Args:
        substances: All that there are, each once.
        particle: Volume of a particle [m^3].
    """

    def __init__(self, substances: Sequence[Substance], particle: float) -> None:
        self._particle = particle
        compounds = [resolve(one.name) for one in substances]
        self._keys = [f"{one.formula}(l)" for one in compounds]
        densities = [one.density for one in substances]
        self._per_volume = np.array(densities) / [one.molar_mass for one in compounds]
        self._colors = np.array([one.rgba[:3] for one in substances])
        self._other = np.array([one != WATER for one in substances])

    def solution(self, what: Portion, capacities: FloatArray) -> Solution:
        """Return what is in a vessel: how warm, how mixed, of what; of water alone the pH.

        Args:
            what: The particles in it.
            capacities: What warms each by 1 K, shape (m,) [J/K].
        """
        count = len(what.origins)
        if not count:
            return Solution.nothing({})
        warm = float(capacities @ what.temperatures / capacities.sum())
        shares = what.amounts.mean(axis=0)
        apart = np.abs(what.amounts - shares).sum() / (2.0 * count)
        amounts = dict(zip(self._keys, (shares * self._per_volume).tolist(), strict=True))
        red, green, blue = (shares @ self._colors).tolist()
        return Solution(
            volume=count * self._particle,
            temperature=warm,
            ph=math.nan if shares[self._other].any() else _neutral(warm),
            concentrations={key: amount for key, amount in amounts.items() if amount},
            solids={},
            gas={},
            mixed=1.0 - float(apart),
            colour=(red, green, blue),
        )


def _neutral(temperature: float) -> float:
    """Return the pH of water at a temperature [K]: half of the logarithm of its ion product."""
    return -0.5 * log_k_at(network().species[HYDROXIDE], temperature)
