"""Slow reactions in water that run as fast as their rate laws say."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.network import MOLAR_GAS, PROTON, STANDARD_K
from labutopia_lerobot.chemistry.rules import known

Floats = NDArray[np.float64]

_PER_LITRE = 1e3
"""Litres in a cubic metre."""


@dataclass(frozen=True)
class _Path:
    """A way in which a reaction runs, in the order of the species.

    Attributes:
        constant: At 25 C [mol, l, s].
        activation: [J/mol].
        places: Which species the rate depends on.
        orders: Powers of their concentrations.
    """

    constant: float
    activation: float
    places: tuple[int, ...]
    orders: tuple[float, ...]

    def rate(self, molar: Floats, temperatures: Floats) -> Floats:
        """Return how fast it runs, shape (n,) [mol/(l s)].

        Args:
            molar: Concentrations, shape (n, species) [mol/l].
            temperatures: Shape (n,) [K].
        """
        colder = 1.0 / temperatures - 1.0 / STANDARD_K
        rate: Floats = self.constant * np.exp(-self.activation / MOLAR_GAS * colder)
        for place, order in zip(self.places, self.orders, strict=True):
            rate = rate * molar[:, place] ** order
        return rate


@dataclass(frozen=True)
class _Timed:
    """One reaction, in the order of the species.

    Attributes:
        coefficients: Negative for what is used up, shape (species,).
        paths: How it runs.
        acid: Which species is the hydrogen ion.
        least: Its concentration from which the reaction runs [mol/l].
        most: Its concentration up to which it runs [mol/l].
    """

    coefficients: Floats
    paths: tuple[_Path, ...]
    acid: int
    least: float
    most: float

    def rate(self, molar: Floats, temperatures: Floats) -> Floats:
        """Return how fast it runs, shape (n,) [mol/(l s)].

        Args:
            molar: Concentrations, shape (n, species) [mol/l].
            temperatures: Shape (n,) [K].
        """
        acid = molar[:, self.acid]
        runs = (self.least <= acid) & (acid <= self.most)
        paths = np.array([path.rate(molar, temperatures) for path in self.paths])
        rate: Floats = np.where(runs, paths.sum(axis=0), 0.0)
        return rate


class Kinetics:
    """What slow reactions make of particles while time goes on.

    Args:
        species: Keys of what particles hold, in order.
        forms: Keys of what may form, see `ReactionVessel`; None for all.
    """

    def __init__(self, species: Sequence[str], forms: frozenset[str] | None) -> None:
        place = {key: index for index, key in enumerate(species)}
        self._reactions: list[_Timed] = []
        for one in known.with_rates(frozenset(species)):
            made = {key for key, n in one.coefficients.items() if n > 0}
            if not made <= place.keys() or (forms is not None and forms.isdisjoint(made)):
                continue
            paths = tuple(
                _Path(
                    law.constant,
                    law.activation,
                    tuple(place[key] for key in law.orders),
                    tuple(law.orders.values()),
                )
                for law in one.record.rates
                if law.orders.keys() <= place.keys()
            )
            numbers = np.zeros(len(species))
            for key, n in one.coefficients.items():
                numbers[place[key]] = n
            least, most = 10.0**-one.record.highest_ph, 10.0**-one.record.lowest_ph
            if paths:
                self._reactions.append(_Timed(numbers, paths, place[PROTON], least, most))

    def __bool__(self) -> bool:
        """Return whether any runs among these species."""
        return bool(self._reactions)

    def advance(
        self, contents: Floats, volume: float, temperatures: Floats, period: float
    ) -> Floats:
        """Return what particles hold after a time, shape (n, species) [mol].

        Each reacts as if what there is least of were used up at a constant rate per amount, which
        is exact where the rest is in excess, and never uses up more than there is.

        Args:
            contents: What they hold, at equilibrium, shape (n, species) [mol].
            volume: Of each [m^3].
            temperatures: Of them, shape (n,) [K].
            period: Time [s].
        """
        for one in self._reactions:
            molar = np.maximum(contents, 0.0) / (_PER_LITRE * volume)
            used = np.flatnonzero(one.coefficients < 0.0)
            scarcest = (molar[:, used] / -one.coefficients[used]).min(axis=1)
            rate = one.rate(molar, temperatures)
            share = np.divide(rate, scarcest, out=np.zeros_like(rate), where=scarcest > 0.0)
            extent = -np.expm1(-share * period) * scarcest * _PER_LITRE * volume
            contents = contents + extent[:, None] * one.coefficients
        return contents
