"""Which species a solution holds once everything that is fast has come to equilibrium."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.equilibrium import Equilibrium, solve
from labutopia_lerobot.chemistry.network import (
    HYDROXIDE,
    PROTON,
    WATER,
    Species,
    log_k_at,
    network,
)

_WARM = 320.0
"""Temperature from which an open vessel loses ammonia within minutes [K]; an estimate of ours."""


def escape_pressure(gas: str, temperature: float) -> float:
    """Return the pressure at which a gas leaves an open, stirred vessel [bar]; estimates of ours.

    Carbon dioxide leaves in bubbles; ammonia is smelt, but leaves only when warm or concentrated.
    """
    if gas == "NH3(g)":
        return 0.004 if temperature > _WARM else 0.1
    return 0.1 if gas == "CO2(g)" else 0.01


_TRACE = 1e-25
"""Amount below which a species is left out of the answer [mol]."""


_LEAST = 1e-15
"""Part of the largest total at which a component is what rounding has left: it stays as it is."""


@dataclass(frozen=True)
class _Selection:
    components: tuple[str, ...]
    dissolved: tuple[Species, ...]
    phases: tuple[Species, ...]
    dissolved_matrix: NDArray[np.float64]
    phase_matrix: NDArray[np.float64]
    constants: NDArray[np.float64]
    phase_constants: NDArray[np.float64]
    simple: tuple[bool, ...]


def settle(
    amounts: Mapping[str, float],
    volume: float,
    temperature: float,
    *,
    open_system: bool,
    ph: float | None = None,
    forms: frozenset[str] | None = None,
) -> dict[str, float]:
    """Return the amounts of species at equilibrium, oxidation numbers unchanged.

    Args:
        amounts: By key, as ``Cu^2+(aq)`` [mol].
        volume: Of the solution [m^3].
        temperature: [K].
        open_system: Whether gases leave at their escape pressure, else at 1 bar.
        ph: What a buffer that is not modelled holds; protons are not conserved then.
        forms: Keys of the solids and gases that may form; None for all.

    Raises:
        NoEquilibriumError: None was reached.
    """
    made = network().species
    litres = volume * 1000.0
    takes = {key: amount for key, amount in amounts.items() if takes_part(key)}
    totals = _totals(takes)
    least = _LEAST * max((n for name, n in totals.items() if name != WATER), default=0.0)
    gone = {name for name, n in totals.items() if n <= least} - {PROTON, WATER}
    stays = {key for key in takes if not gone.isdisjoint(made[key].components)}
    kept = {key: n for key, n in amounts.items() if n and (key in stays or key not in takes)}
    if stays:
        totals = _totals({key: amount for key, amount in takes.items() if key not in stays})
    water = totals.pop(WATER, 0.0)
    totals.setdefault(PROTON, 0.0)
    present = frozenset(name for name, n in totals.items() if n > 0.0 or name == PROTON)
    dissolving = frozenset(k for k in amounts if k in made and made[k].only_dissolves)
    chosen = _select(present, dissolving, round(temperature, 6), open_system, ph, forms)
    right = np.array([totals[name] / litres for name in chosen.components])
    possible = _possible(chosen, right)
    answer = solve(
        chosen.constants,
        chosen.dissolved_matrix,
        np.ascontiguousarray(chosen.phase_constants[possible]),
        np.ascontiguousarray(chosen.phase_matrix[possible]),
        right,
    )
    concentrations, phases = _balanced(chosen, possible, answer, right)
    for one, concentration in zip(chosen.dissolved, concentrations.tolist(), strict=True):
        kept[one.key] = concentration * litres
        water -= one.components.get(WATER, 0.0) * concentration * litres
    for index, amount in zip(possible, phases.tolist(), strict=True):
        one = chosen.phases[index]
        if amount > 0.0:
            kept[one.key] = amount * litres
            water -= one.components.get(WATER, 0.0) * amount * litres
    kept[WATER] = water
    return {key: amount for key, amount in kept.items() if abs(amount) > _TRACE}


def _totals(amounts: Mapping[str, float]) -> dict[str, float]:
    """Return how much of each component some species consist of [mol]."""
    totals: dict[str, float] = {}
    for key, amount in amounts.items():
        for component, number in network().species[key].components.items():
            totals[component] = totals.get(component, 0.0) + number * amount
    return totals


def _balanced(
    chosen: _Selection, possible: list[int], answer: Equilibrium, totals: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return dissolved species and phases of an answer, changed so that nothing is lost [mol/l].

    The solver leaves some 1e-11 of each total. One more step of Newton's method, with the phases
    among the species, shares that out: each species changes in proportion to what there is of it.
    """
    matrix = np.vstack([chosen.dissolved_matrix, chosen.phase_matrix[possible]])
    amounts = np.concatenate([answer.concentrations, answer.phases])
    lost = totals - matrix.T @ amounts
    curvature = matrix.T @ (amounts[:, None] * matrix)
    scale = 1.0 / np.sqrt(np.maximum(np.diagonal(curvature), 1e-300))
    shares = scale * np.linalg.lstsq(curvature * np.outer(scale, scale), scale * lost)[0]
    amounts = np.maximum(amounts * (1.0 + matrix @ shares), 0.0)
    count = len(chosen.dissolved)
    return amounts[:count], amounts[count:]


def ph_of(amounts: Mapping[str, float], volume: float) -> float:
    """Return minus the logarithm of the concentration of protons in mol/l."""
    return -math.log10(max(amounts.get(PROTON, 0.0), 1e-30) / (volume * 1000.0))


@lru_cache(maxsize=100_000)
def takes_part(key: str) -> bool:
    """Whether a species belongs to the equilibrium; a metal or an insoluble solid does not."""
    one = network().species.get(key)
    return one is not None and (one.phase == "aq" or not one.is_component or key == WATER)


@lru_cache(maxsize=4096)
def _select(
    present: frozenset[str],
    dissolving: frozenset[str],
    temperature: float,
    open_system: bool,
    ph: float | None,
    forms: frozenset[str] | None,
) -> _Selection:
    allowed = present | {WATER}
    chosen = [
        one
        for one in network().species.values()
        if one.key != WATER
        and allowed.issuperset(one.components)
        and takes_part(one.key)
        and (not one.only_dissolves or one.key in dissolving)
        and (forms is None or one.phase == "aq" or one.key in forms)
    ]
    dissolved = tuple(one for one in chosen if one.phase == "aq")
    phases = tuple(one for one in chosen if one.phase != "aq")
    components = tuple(sorted(present if ph is None else present - {PROTON}))

    def matrix(rows: tuple[Species, ...]) -> NDArray[np.float64]:
        numbers = [[one.components.get(name, 0.0) for name in components] for one in rows]
        return np.array(numbers, dtype=np.float64).reshape(len(rows), len(components))

    def constant(one: Species) -> float:
        log_k = log_k_at(one, temperature) * math.log(10)
        if one.phase == "g" and open_system:
            log_k -= math.log(escape_pressure(one.key, temperature))
        if ph is not None:
            log_k -= one.components.get(PROTON, 0.0) * ph * math.log(10)
        return log_k

    return _Selection(
        components,
        dissolved,
        phases,
        matrix(dissolved),
        matrix(phases),
        np.array([constant(one) for one in dissolved]),
        np.array([constant(one) for one in phases]),
        tuple(min(one.components.values()) > 0 and PROTON not in one.components for one in phases),
    )


def _possible(chosen: _Selection, totals: NDArray[np.float64]) -> list[int]:
    """Return the phases that could be saturated if nothing else held their components."""
    logarithms = np.log(np.maximum(totals, 1e-300))
    most = chosen.phase_constants + chosen.phase_matrix @ logarithms
    return [p for p in range(len(chosen.phases)) if most[p] > 0.0 or not chosen.simple[p]]


__all__ = ["HYDROXIDE", "PROTON", "WATER", "ph_of", "settle", "takes_part"]
