"""From amounts before and after to the reactions that a chemist would write.

A reaction is the formation of something new from what was there. What was there most of becomes
the basis in which everything else is written (a change of components: Smith and Missen, Chemical
Reaction Equilibrium Analysis, 1982), so each reaction is balanced and the only one of its kind.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.change import Change, whole
from labutopia_lerobot.chemistry.network import HYDROXIDE, PROTON, WATER, network
from labutopia_lerobot.chemistry.rules import (
    complexation,
    dissolution,
    gas_evolution,
    hydrolysis,
    neutralization,
    precipitation,
)

_RULES = (hydrolysis, precipitation, gas_evolution, complexation, dissolution, neutralization)
"""In this order: the first that explains a reaction names it."""

_WORTH_SAYING = 0.02
"""Part of a reactant that has to react for a reaction to be listed; an estimate of ours."""

_TRACE = 1e-12
"""Part of the largest amount below which nothing is described."""

_LEAST_HYDROLYSIS = 5e-6
"""The same for hydrolysis of a salt in water, which one sees by its pH; an estimate of ours."""

_SOLUTION_FIRST = 10.0
"""How much a dissolved reactant counts before a solid of the same amount; an estimate of ours."""


def describe(
    before: Mapping[str, float], after: Mapping[str, float], *, alone: bool
) -> list[Change]:
    """Return the reactions between two states that differ by equilibria only.

    Args:
        before: Amounts [mol].
        after: Amounts [mol].
        alone: Whether one compound met nothing but water: else a reaction that each would have
            undergone by itself, hydrolysis, is not listed.
    """
    made = network().species
    least = _TRACE * max(before.values(), default=0.0)
    names = [
        key
        for key in {**before, **after}
        if key in made and (before.get(key, 0.0) > 0.0 or after.get(key, 0.0) > least)
    ]
    components = sorted({part for key in names for part in made[key].components})
    rows = {
        key: np.array([made[key].components.get(part, 0.0) for part in components]) for key in names
    }
    basis = _basis(before, after, rows, len(components))
    matrix = np.array([rows[key] for key in basis]).T
    inverse = np.linalg.pinv(matrix)
    found: list[Change] = []
    for key in names:
        change = after.get(key, 0.0) - before.get(key, 0.0)
        if key in basis or abs(change) < 1e-12:
            continue
        if change > 0 and before.get(key, 0.0) > 0 and key in (PROTON, HYDROXIDE):
            continue
        parts = inverse @ rows[key]
        if np.abs(matrix @ parts - rows[key]).max() > 1e-9:
            continue
        numbers = {part: -n for part, n in zip(basis, parts.tolist(), strict=True)}
        numbers[key] = 1.0
        signed = {k: (n if change > 0 else -n) for k, n in numbers.items()}
        if _used(signed, abs(change), before) <= (_LEAST_HYDROLYSIS if alone else _WORTH_SAYING):
            continue
        balanced = whole(signed)
        if balanced is None:
            continue
        extent = abs(change) / abs(balanced[key])
        used = _used(balanced, extent, before)
        one = _named(Change(balanced, extent, "", "", used=min(used, 1.0)))
        if _is_worth_saying(one, alone=alone):
            found.append(one)
    found.sort(key=lambda one: -_weight(one))
    return _fullest_complexes(found)


def _used(coefficients: Mapping[str, float], extent: float, before: Mapping[str, float]) -> float:
    """Return the largest part of a reactant that a reaction uses up."""
    return max(
        (
            -n * extent / before[key]
            for key, n in coefficients.items()
            if n < -1e-9 and key != WATER and before.get(key, 0.0) > 0.0
        ),
        default=0.0,
    )


def _is_worth_saying(one: Change, *, alone: bool) -> bool:
    if one.kind == hydrolysis.KIND and not _is_solid_hydrolysis(one):
        return alone and one.used > _LEAST_HYDROLYSIS
    if one.kind == complexation.KIND and alone:
        return False  # of a salt's own ions: it did not meet anything
    return one.used > _WORTH_SAYING


def _weight(one: Change) -> float:
    """Return how early a reaction is listed: what one sees counts thrice, water a tenth."""
    seen = {precipitation.KIND: 3.0, gas_evolution.KIND: 3.0}
    rest = {hydrolysis.KIND: 0.1, dissolution.KIND: 0.1}
    return one.extent * seen.get(one.kind, 1.0) * rest.get(one.kind, 1.0)


def _fullest_complexes(found: list[Change]) -> list[Change]:
    """Leave of the steps of one metal with one ligand that with most ligands which matters."""
    made = network().species
    kept = list(found)
    for one in found:
        parts = _complex_parts(one)
        rivals = [other for other in found if parts and _complex_parts(other) == parts]
        most = max((other.extent for other in rivals), default=0.0)
        ranked = [other for other in rivals if other.extent >= 0.25 * most]
        if ranked:
            best = max(
                ranked, key=lambda o: max(sum(made[k].components.values()) for k in o.products)
            )
            if one is not best:
                kept.remove(one)
    return kept


def _complex_parts(one: Change) -> frozenset[str]:
    """Return the components of the complex that forms, or nothing if none does."""
    made = network().species
    if one.kind != complexation.KIND:
        return frozenset()
    return frozenset(
        part for key in one.products if made[key].is_complex for part in made[key].components
    )


def _is_solid_hydrolysis(one: Change) -> bool:
    return any(not key.endswith("(aq)") and key != WATER for key in one.reactants)


def _named(change: Change) -> Change:
    for rule in _RULES:
        why = rule.explains(change)
        if why is not None:
            return Change(change.coefficients, change.extent, rule.KIND, why, used=change.used)
    raise AssertionError("neutralization explains what is left")


def _basis(
    before: Mapping[str, float],
    after: Mapping[str, float],
    rows: Mapping[str, NDArray[np.float64]],
    size: int,
) -> list[str]:
    """Return as many independent species as there are components, the most plentiful first."""

    def weight(key: str) -> float:
        return before[key] * (_SOLUTION_FIRST if key.endswith("(aq)") else 1.0)

    def weight_after(key: str) -> float:
        return after[key] * (_SOLUTION_FIRST if key in (PROTON, HYDROXIDE) else 1.0)

    first = sorted((key for key in before if key in rows), key=weight, reverse=True)
    later = sorted((k for k in after if k in rows and k not in before), key=weight_after)[::-1]
    chosen: list[str] = []
    reduced: list[NDArray[np.float64]] = []
    for key in [WATER, *first, *later]:
        if key not in rows or key in chosen:
            continue
        rest = rows[key].copy()
        for one in reduced:
            rest -= (rest @ one) * one
        length = float(np.linalg.norm(rest))
        if length > 1e-6 * float(np.linalg.norm(rows[key])):
            chosen.append(key)
            reduced.append(rest / length)
        if len(chosen) == size:
            break
    return chosen
