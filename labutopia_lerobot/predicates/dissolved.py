"""Facts about what is dissolved in a vessel: its pH, its concentrations, its colour.

Without liquid, and of an empty vessel, none of them holds.
"""

import math
from collections.abc import Mapping

from labutopia_lerobot.chemistry import colour
from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import Solution, Thing, World

MIXED = 0.95
"""Part of what is dissolved that must be where, and as, it is in the end; ours: no eye sees, and no
electrode measures, what is missing then."""

_CLOUDY = 0.01
"""What floats in a solution that is not clear [mol/m^3]; ours: as `chemistry.observe`."""


def _mixed(world: World, vessel: Thing) -> Solution | None:
    """Return what a vessel holds, if it holds something that has mixed."""
    solution = world.solution(vessel)
    return solution if solution is not None and _is_mixed(solution) else None


def _is_mixed(solution: Solution) -> bool:
    return solution.volume > 0.0 and solution.mixed >= MIXED


@predicate("pH of {vessel} between {low:g} and {high:g}")
def ph_between(world: World, vessel: Thing, *, low: float, high: float) -> bool:
    """What a vessel holds has mixed, and a pH meter reads between two values in it."""
    solution = _mixed(world, vessel)
    return solution is not None and low <= solution.ph <= high


@ph_between.measure
def _off_ph(world: World, vessel: Thing, *, low: float, high: float) -> Mapping[str, float]:
    solution = world.solution(vessel)
    if solution is None or math.isnan(solution.ph):
        return {}
    return {"ph": abs(solution.ph - (low + high) / 2)}


@predicate("pH of {vessel} above {than:g}, stirred")
def more_basic(world: World, vessel: Thing, *, than: float) -> bool:
    """A pH meter would read more than a value in what a vessel holds, once that has mixed."""
    solution = world.solution(vessel)
    return solution is not None and solution.ph > than


@predicate("{low:g} to {high:g} mol/l of {species} in {vessel}")
def concentration(world: World, vessel: Thing, *, species: str, low: float, high: float) -> bool:
    """What a vessel holds has mixed, and a dissolved species, as `Cu^2+(aq)`, is so concentrated.

    Args:
        world: The world.
        vessel: What holds it.
        species: Formula and phase.
        low: Least concentration [mol/l].
        high: Greatest concentration [mol/l].
    """
    solution = _mixed(world, vessel)
    if solution is None:
        return False
    return low <= 1e-3 * solution.concentrations.get(species, 0.0) <= high


@predicate("{vessel} looks {to}")
def colour_turned(world: World, vessel: Thing, *, to: str) -> bool:
    """What a vessel holds has a colour now, pale or not: 1 cm of it, what floats in it aside.

    Args:
        world: The world.
        vessel: What holds it.
        to: A word for it (`chemistry.colour.word`), such as `green`.
    """
    solution = world.solution(vessel)
    if solution is None or not solution.volume:
        return False
    return colour.word(solution.colour).removeprefix("pale ") == to


@predicate("all in {vessel} dissolved")
def dissolved(world: World, vessel: Thing) -> bool:
    """What a vessel holds has mixed and is clear: no solid is left, and none has formed."""
    solution = _mixed(world, vessel)
    return solution is not None and sum(solution.solids.values()) < _CLOUDY * solution.volume


@predicate("{vessel} clouded")
def clouded(world: World, vessel: Thing) -> bool:
    """What a vessel holds has mixed, and a solid floats in it or lies on its bottom."""
    solution = _mixed(world, vessel)
    return solution is not None and sum(solution.solids.values()) >= _CLOUDY * solution.volume


@predicate("{mmol:g} mmol of {solid} or more in {vessel}")
def precipitated(world: World, vessel: Thing, *, solid: str, mmol: float) -> bool:
    """What a vessel holds has mixed, and there is so much of a solid in it, as `BaSO4(s)`.

    Args:
        world: The world.
        vessel: What holds it.
        solid: Formula and phase.
        mmol: Least amount of it [mmol].
    """
    solution = _mixed(world, vessel)
    return solution is not None and 1e3 * solution.solids.get(solid, 0.0) >= mmol


@precipitated.measure
def _still_dissolved(
    world: World, vessel: Thing, *, solid: str, mmol: float
) -> Mapping[str, float]:
    solution = world.solution(vessel)
    if solution is None:
        return {}
    return {"mmol": max(0.0, mmol - 1e3 * solution.solids.get(solid, 0.0))}
