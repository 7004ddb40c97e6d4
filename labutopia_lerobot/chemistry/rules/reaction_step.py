"""A reaction that runs until something is used up, and what there is for it."""

from collections.abc import Mapping
from dataclasses import dataclass

from labutopia_lerobot.chemistry.network import PROTON, WATER, network


@dataclass(frozen=True)
class ReactionStep:
    """What a rule proposes.

    Attributes:
        coefficients: Balanced whole numbers, negative for what is used up.
        kind: ``reaction_type``.
        rationale: Why.
        confidence: From 0 to 1; an estimate of ours.
        slow: Whether it takes minutes or more.
        timed: Whether its rate is known.
        conversion: Part of the scarcest reactant that is used up at the end.
    """

    coefficients: Mapping[str, int]
    kind: str
    rationale: str
    confidence: float = 0.95
    slow: bool = False
    timed: bool = False
    conversion: float = 1.0


def core(key: str) -> str | None:
    """Return the one component besides protons and water in a species, if there is only one."""
    one = network().species.get(key)
    if one is None:
        return None
    names = [name for name in one.components if name not in (PROTON, WATER)]
    if not names:
        return key if key in (PROTON, WATER) else None
    return names[0] if len(names) == 1 else None


def available(state: Mapping[str, float], key: str) -> float:
    """Return how much there is of a species in all forms that hold its component [mol]."""
    component = core(key)
    if component is None:
        return state.get(key, 0.0)
    if component in (PROTON, WATER):
        return 1.0
    made = network().species
    return (
        sum(
            amount * made[name].components.get(component, 0.0)
            for name, amount in state.items()
            if name in made
        )
        / made[key].components[component]
    )


def in_what_is_there(
    coefficients: Mapping[str, int], state: Mapping[str, float]
) -> dict[str, float]:
    """Return a reaction with each reactant in the form that the vessel holds most of.

    The forms differ in protons, water and ligands, which go to the other side: hydrogensulfite
    stands for sulfite, silver chloride for silver ions.
    """
    made = network().species
    numbers: dict[str, float] = dict(coefficients)
    for key, n in coefficients.items():
        component = core(key)
        if n > 0 or component in (None, PROTON, WATER) or key not in made:
            continue
        assert component is not None
        own = state.get(key, 0.0)
        best = max(
            (name for name in state if name in made and component in made[name].components),
            key=lambda name: state[name] * made[name].components[component],
            default=key,
        )
        if best == key or own >= 0.1 * available(state, key):
            continue
        ratio = made[key].components[component] / made[best].components[component]
        numbers[key] = 0.0
        numbers[best] = numbers.get(best, 0.0) + n * ratio
        wanted, got = made[key].components, made[best].components
        for name in {*wanted, *got} - {component}:
            left = ratio * got.get(name, 0.0) - wanted.get(name, 0.0)
            numbers[name] = numbers.get(name, 0.0) - n * left
    return {key: n for key, n in numbers.items() if n}
