"""The species of a scene in a fixed order, so that what a particle holds is a row of numbers."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.course import ReactionVessel, proceed, too_slow
from labutopia_lerobot.chemistry.equation import Composition, composition
from labutopia_lerobot.chemistry.equilibrium import NoEquilibriumError
from labutopia_lerobot.chemistry.kinetics import Kinetics
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.network import HYDROXIDE, PROTON, WATER, network
from labutopia_lerobot.chemistry.portions import WATER_PER_VOLUME, poured
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.chemistry.rules import known, redox
from labutopia_lerobot.chemistry.speciation import takes_part

Floats = NDArray[np.float64]

_STEP = 0.25
"""Constants are those of the nearest of such steps of temperature [K]; ours: 0.01 of pH."""

_AT_REST = 1e-9
"""Change, as a part of what there is of a species, below which nothing has happened; ours."""

_TRACE = 1e-18
"""Change, as a part of all that is dissolved, that is too little to be any; ours: a solution of 1
mol/l and pH 15 has a thousand times as many protons."""

_ROOM = 293.15
"""Temperature at which fillings are made up [K]: that of a room."""


class NotDissolvedError(ChemistryError):
    """A solution that cannot be made up; the message says how much dissolves."""


@dataclass(frozen=True)
class Solute:
    """One compound that a filling has in solution.

    Attributes:
        of: Name, formula, id or CAS number of the compound.
        molar: Of its formula units [mol/l].
    """

    of: str
    molar: float

    @property
    def compound(self) -> Compound:
        """The compound.

        Raises:
            UnknownCompoundError: It is not in the table.
            AmbiguousCompoundError: The name fits several.
        """
        return resolve(self.of)


def made_up(solutes: Iterable[Solute]) -> dict[str, float]:
    """Return what a solution in water holds, before anything has reacted [mol/m^3].

    Args:
        solutes: All that it is made up of; none for water.

    Raises:
        NotDissolvedError: A compound does not dissolve, or not as much of it.
    """
    amounts = {WATER: WATER_PER_VOLUME}
    for solute in solutes:
        if not 0.0 < solute.molar < 20.0:
            raise NotDissolvedError(
                f"{solute.molar:g} mol/l of {solute.of} cannot be: choose more than 0 and less "
                "than 20 mol/l"
            )
        brought = poured(solute.compound, 1e3 * solute.molar, 1.0, _ROOM, wet=True)
        pure = sum(mol for key, mol in brought.items() if not key.endswith("(aq)") and key != WATER)
        if pure:
            most = solute.molar - 1e-3 * pure
            raise NotDissolvedError(
                f"{solute.molar:g} mol/l of {solute.of} do not dissolve in water: "
                + (f"at most {most:.2g} mol/l do" if most > 0.0 else "it is no solution")
            )
        for key, mol in brought.items():
            amounts[key] = amounts.get(key, 0.0) + mol
    return amounts


class Inventory:
    """All species that the contents of a scene are, or may become.

    Rows of amounts have their order; the amounts are those of a volume.

    Args:
        species: Their keys.
        forms: Keys of what may form (see `ReactionVessel`); None for all that the rules know.

    Attributes:
        species: Their keys, sorted.
    """

    def __init__(self, species: Iterable[str], forms: frozenset[str] | None = None) -> None:
        self.species = tuple(sorted(species))
        self._forms = forms
        self._settled = lru_cache(maxsize=64)(self._settle)

    @classmethod
    def of(
        cls,
        solutions: Iterable[Sequence[Solute]],
        solids: Collection[str] = (),
        named: Collection[Composition] | None = None,
    ) -> "Inventory":
        """Return the inventory of solutions that may be poured together.

        Args:
            solutions: The solutes of each vessel.
            solids: Keys of the species that lie in them beside.
            named: Of what may form, whatever its phase, beside those solids, acids, bases and
                complexes; None for all that the rules know.

        Raises:
            NotDissolvedError: A compound does not dissolve, or not as much of it.
        """
        keys = {key for solutes in solutions for key in made_up(solutes)}
        species = _reachable(keys | {WATER, PROTON, *solids})
        if named is None:
            return cls(species)
        made = network().species
        forms = {key for key in species if composition(made[key].composition) in named}
        return cls(species, frozenset((forms | {*solids}) - {WATER, PROTON, HYDROXIDE}))

    def row(self, amounts: Mapping[str, float]) -> Floats:
        """Return amounts as a row, shape (species,).

        Raises:
            KeyError: If there is a species that is not in the inventory.
        """
        row = np.zeros(len(self.species))
        for key, amount in amounts.items():
            row[self._places[key]] = amount
        return row

    def amounts(self, row: Floats) -> dict[str, float]:
        """Return a row as amounts by key, without those of which there is nothing."""
        return {key: mol for key, mol in zip(self.species, row.tolist(), strict=True) if mol}

    def filled(self, solutes: Iterable[Solute], volume: float) -> Floats:
        """Return what a volume [m^3] of a solution holds, made up, shape (species,) [mol]."""
        made = self.row({key: mol * volume for key, mol in made_up(solutes).items()})
        settled, _ = self.settled(made, volume, _ROOM)
        return np.where(self.gaseous, 0.0, settled)

    def settled(self, row: Floats, volume: float, temperature: float) -> tuple[Floats, str]:
        """Return what becomes of amounts when they have mixed, gases among it.

        Slow reactions do not happen, see `kinetics` and `too_slow`. What the rules cannot work out
        stays as it is.

        Args:
            row: Shape (species,) [mol]; never negative.
            volume: In which they are [m^3].
            temperature: [K].

        Returns:
            Shape (species,) [mol], the same numbers where nothing happens; and why nothing was
            worked out, in words, else nothing.
        """
        step = round(temperature / _STEP) * _STEP
        content, why = self._settled(row.tobytes(), volume, step)
        return np.frombuffer(content), why

    def _settle(self, content: bytes, volume: float, temperature: float) -> tuple[bytes, str]:
        row: Floats = np.frombuffer(content)
        vessel = ReactionVessel(volume, temperature, slow=False, forms=self._forms)
        try:
            after = self.row(proceed(self.amounts(row), vessel, described=False)[0])
        except NoEquilibriumError:  # its message has numbers: each particle would have its own
            return content, "no equilibrium was found of what has been mixed"
        except ChemistryError as error:
            return content, str(error)
        trace = _TRACE * row[self.dissolved].sum()
        still = (np.abs(after - row) <= _AT_REST * row + trace).all()
        return (content if still else after.tobytes()), ""

    @cached_property
    def kinetics(self) -> Kinetics:
        """The slow reactions whose rates are known."""
        return Kinetics(self.species, self._forms)

    def too_slow(self, row: Floats, volume: float, temperature: float) -> str:
        """Return the equation of a slow reaction whose rate is not known, or nothing.

        Args:
            row: As `settled` returned it, shape (species,) [mol].
            volume: In which it is [m^3].
            temperature: [K].
        """
        if not self._any_slow:
            return ""
        return too_slow(self.amounts(row), ReactionVessel(volume, temperature, forms=self._forms))

    @cached_property
    def _any_slow(self) -> bool:
        return known.any_slow(frozenset(self.species))

    @cached_property
    def _places(self) -> dict[str, int]:
        return {key: index for index, key in enumerate(self.species)}

    @cached_property
    def enthalpies(self) -> Floats:
        """Of formation, shape (species,) [J/mol]."""
        made = network().species
        return np.array([made[key].enthalpy for key in self.species])

    @cached_property
    def molar_masses(self) -> Floats:
        """Of each species, electrons weigh nothing, shape (species,) [kg/mol]."""
        made = network().species
        return np.array([made[key].composition.molar_mass for key in self.species])

    @cached_property
    def gaseous(self) -> NDArray[np.bool_]:
        """Which species leave a solution as bubbles, shape (species,)."""
        return np.array([key.endswith("(g)") for key in self.species])

    @cached_property
    def watery(self) -> NDArray[np.bool_]:
        """Which species is water, shape (species,)."""
        return np.array([key == WATER for key in self.species])

    @cached_property
    def dissolved(self) -> NDArray[np.bool_]:
        """Which species are in solution, water not among them, shape (species,)."""
        return np.array([key.endswith("(aq)") for key in self.species])


def _reachable(keys: set[str]) -> set[str]:
    """Return everything that species can become by equilibria, redox and listed reactions."""
    made = network().species
    while True:
        parts = {part for key in keys for part in made[key].components} | {WATER}
        found = {
            key
            for key, one in made.items()
            if parts.issuperset(one.components)
            and takes_part(key)
            and (key in keys or not one.only_dissolves)
        }
        found |= {key for key in redox.products(frozenset(parts)) if key in made}
        found |= {key for key in known.products(frozenset(keys | found)) if key in made}
        if found <= keys:
            return keys
        keys = keys | found
