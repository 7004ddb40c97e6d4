"""What a portion brings into the vessel, before anything meets."""

import math

from labutopia_lerobot.chemistry.compound import Compound
from labutopia_lerobot.chemistry.network import (
    LETTERS,
    WATER,
    SpeciesPhase,
    network,
    without_water,
)

WATER_PER_VOLUME = 55_345.0
"""Of water at 25 C [mol/m^3]: 997.05 kg/m^3 (CRC Handbook) over 0.018015 kg/mol."""

_SEEN_TO_DISSOLVE = 0.1
"""Part of a portion that has to dissolve for it to be called a solution; an estimate of ours."""

_VERY_SOLUBLE_GAS = 200.0
"""Solubility from which a gas is sold and poured as a solution, as ammonia is [kg/m^3]."""


def phase_at(compound: Compound, temperature: float) -> SpeciesPhase:
    """Return the phase of a pure compound; what is not known to change stays as at 25 C."""
    if compound.phase is None:
        return "aq"
    if compound.boiling_point is not None and temperature > compound.boiling_point:
        return "g"
    if compound.melting_point is not None and compound.phase == "solid":
        return "s"  # a melt is written as the solid: nothing in the engine depends on it
    return LETTERS[compound.phase]


def poured(
    compound: Compound, amount: float, volume: float, temperature: float, *, wet: bool
) -> dict[str, float]:
    """Return the species that a portion consists of.

    Args:
        compound: What it is.
        amount: Of it [mol].
        volume: Of its solution in water [m^3]; 0 for the pure compound.
        temperature: [K].
        wet: Whether there is water in the vessel.
    """
    made = network()
    if compound.formula == "H2O":
        return {WATER: amount}
    phase = phase_at(compound, temperature)
    if wet and compound.phase is not None:
        phase = LETTERS[compound.phase]
    pure = made.same(compound.formula, phase) or f"{compound.formula}({phase})"
    if not wet or (volume == 0.0 and compound.phase is not None):
        return {pure: amount}
    dissolved = _dissolved(compound)
    if not dissolved:
        return {pure: amount}
    most = _molar_solubility(compound, pure) * volume * 1000.0
    part = 1.0 if most >= amount else most / amount
    part = part if part >= _SEEN_TO_DISSOLVE else 0.0
    if compound.phase == "gas" and _is_bubbled(compound):
        part = 0.0
    brought = {pure: amount * (1.0 - part)}
    for key, count in dissolved.items():
        brought[key] = brought.get(key, 0.0) + count * amount * part
    return {key: mol for key, mol in brought.items() if mol}


def _is_bubbled(compound: Compound) -> bool:
    solubility = compound.solubility
    return not compound.ions and (
        not isinstance(solubility, int | float) or solubility < _VERY_SOLUBLE_GAS
    )


def _dissolved(compound: Compound) -> dict[str, int]:
    """Return what one formula unit gives in water; empty for what does not dissolve."""
    made = network()
    if compound.ions:
        parts: dict[str, int] = {}
        for ion, count in compound.ions.items():
            key = WATER if ion == "H2O" else made.dissolved(ion).key
            parts[key] = parts.get(key, 0) + count
        return parts
    own = made.same(compound.formula, "aq")
    if own is not None:
        return {own: 1}
    less = without_water(made, compound.formula)
    if less is not None:
        return {less: 1, WATER: 1}
    if compound.phase == "solid" and (compound.solubility == 0 or _is_element_or_oxide(compound)):
        return {}
    if compound.phase == "liquid" and compound.solubility != "miscible":
        return {}
    if compound.phase == "gas":
        return {}
    return {made.dissolved(compound.formula).key: 1}


def _is_element_or_oxide(compound: Compound) -> bool:
    kinds = set(compound.reactivity)
    return bool(kinds & {"metal", "nonmetal", "noble gas", "hydrocarbon"}) or any(
        kind.endswith("oxide") for kind in kinds
    )


def _molar_solubility(compound: Compound, pure: str) -> float:
    """Return what dissolves in water alone, no protons counted [mol/l]; infinite if unlimited."""
    one = network().species.get(pure)
    if compound.solubility == "miscible" or one is None or one.is_component:
        return math.inf
    if not compound.ions or compound.log_ksp is None:
        solubility = compound.solubility
        if solubility is None or isinstance(solubility, str):
            return math.inf
        return solubility / compound.molar_mass / 1000.0
    counts = [n for name, n in compound.ions.items() if name != "H2O"]
    product = compound.log_ksp - sum(n * math.log10(n) for n in counts)
    return float(10.0 ** (product / sum(counts)))
