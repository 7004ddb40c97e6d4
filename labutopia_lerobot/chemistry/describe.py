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

_RULES = (precipitation, gas_evolution, complexation, dissolution, hydrolysis, neutralization)
"""In this order: the first that explains a reaction names it."""

_WORTH_SAYING = 0.02
"""Part of a reactant that has to react for a reaction to be listed; an estimate of ours."""

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
    names = [key for key in {**before, **after} if key in made]
    components = sorted({part for key in names for part in made[key].components})
    rows = {
        key: np.array([made[key].components.get(part, 0.0) for part in components]) for key in names
    }
    basis = _basis(before, after, rows, len(components))
    matrix = np.array([rows[key] for key in basis]).T
    found: list[Change] = []
    for key in names:
        change = after.get(key, 0.0) - before.get(key, 0.0)
        if key in basis or abs(change) < 1e-12:
            continue
        if change > 0 and before.get(key, 0.0) > 0 and key in (PROTON, HYDROXIDE):
            continue
        parts, *_ = np.linalg.lstsq(matrix, rows[key], rcond=None)
        if not np.allclose(matrix @ parts, rows[key], atol=1e-9):
            continue
        numbers = {part: -n for part, n in zip(basis, parts.tolist(), strict=True)}
        numbers[key] = 1.0
        balanced = whole({k: (n if change > 0 else -n) for k, n in numbers.items()})
        if balanced is None:
            continue
        extent = abs(change) / abs(balanced[key])
        used = max(
            (
                -n * extent / before[k]
                for k, n in balanced.items()
                if n < 0 and k != WATER and before.get(k, 0.0) > 0
            ),
            default=0.0,
        )
        if used < _WORTH_SAYING:
            continue
        one = _named(Change(balanced, extent, "", "", used=min(used, 1.0)))
        if alone or one.kind != hydrolysis.KIND or _is_solid_hydrolysis(one):
            found.append(one)
    found.sort(key=lambda one: -_size(one))
    return found


def _size(one: Change) -> float:
    return one.extent * (0.1 if one.kind in (hydrolysis.KIND, dissolution.KIND) else 1.0)


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

    first = sorted((key for key in before if key in rows), key=weight, reverse=True)
    later = sorted((k for k in after if k in rows and k not in before), key=lambda k: -after[k])
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
