"""One balanced reaction and how far it went."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from labutopia_lerobot.chemistry.network import HYDROXIDE, PROTON, WATER, network


@dataclass(frozen=True)
class Change:
    """A reaction between species.

    Attributes:
        coefficients: By key, negative for what is used up; whole numbers without common divisor.
        extent: [mol].
        kind: The ``reaction_type`` of the answer.
        rationale: Why it happens.
        confidence: From 0 to 1; an estimate of ours.
        slow: Whether it takes minutes or more.
        used: Fraction of the scarcest reactant that is used up.
    """

    coefficients: Mapping[str, int]
    extent: float
    kind: str
    rationale: str
    confidence: float = 0.95
    slow: bool = False
    used: float = 1.0

    @property
    def reactants(self) -> list[str]:
        return [key for key, n in self.coefficients.items() if n < 0]

    @property
    def products(self) -> list[str]:
        return [key for key, n in self.coefficients.items() if n > 0]

    def written(self) -> str:
        """Return the equation: reactants, an arrow, products, phases but for what is dissolved."""
        return f"{_side(self.coefficients, -1)} -> {_side(self.coefficients, 1)}"


def shown(key: str) -> str:
    """Return a species as it stands in an equation."""
    return "H2O" if key == WATER else key.removesuffix("(aq)")


def _side(coefficients: Mapping[str, int], sign: int) -> str:
    terms = [(key, n * sign) for key, n in coefficients.items() if n * sign > 0]
    terms.sort(key=lambda term: term[0] == WATER)
    return " + ".join(shown(key) if n == 1 else f"{n} {shown(key)}" for key, n in terms)


def whole(coefficients: Mapping[str, float]) -> dict[str, int] | None:
    """Return the smallest whole numbers in these ratios, or None if there are none below 100."""
    largest = max((abs(n) for n in coefficients.values()), default=0.0)
    near = {key: round(n) for key, n in coefficients.items() if round(n)}
    if near and all(abs(n - near.get(key, 0)) < 1e-9 for key, n in coefficients.items()):
        divisor = math.gcd(*near.values())
        near = {key: n // divisor for key, n in near.items()}
        return near if max(map(abs, near.values())) <= 100 and is_balanced(near) else None
    kept = {key: n for key, n in coefficients.items() if abs(n) > 1e-7 * largest}
    if not kept:
        return None
    fractions = {key: Fraction(n).limit_denominator(60) for key, n in kept.items()}
    if any(abs(float(fractions[key]) - n) > 1e-6 * largest for key, n in kept.items()):
        return None
    scale = math.lcm(*(one.denominator for one in fractions.values()))
    numbers = {key: int(one * scale) for key, one in fractions.items()}
    divisor = math.gcd(*numbers.values())
    numbers = {key: n // divisor for key, n in numbers.items()}
    if not all(numbers.values()) or max(abs(n) for n in numbers.values()) > 100:
        return None
    return numbers if is_balanced(numbers) else None


def is_balanced(coefficients: Mapping[str, float]) -> bool:
    """Whether atoms and charge are the same on both sides."""
    totals: dict[str, float] = {}
    for key, n in coefficients.items():
        composition = network().species[key].composition
        totals["charge"] = totals.get("charge", 0.0) + n * composition.charge
        for element, count in composition.atoms.items():
            totals[element] = totals.get(element, 0.0) + n * count
    return all(abs(total) < 1e-9 for total in totals.values())


def parse_side(text: str) -> dict[str, int]:
    """Return species and numbers of one side of an equation as the data files write it."""
    made = network()
    numbers: dict[str, int] = {}
    for term in text.split(" + "):
        words = term.split()
        count, name = (int(words[0]), words[1]) if len(words) == 2 else (1, words[0])
        if name == "H2O":
            key = WATER
        elif name.endswith(("(s)", "(l)", "(g)")):
            formula, letter = name[:-3], name[-2]
            key = made.same(formula, letter) or name  # type: ignore[arg-type]
        else:
            key = made.same(name, "aq") or made.dissolved(name).key
        numbers[key] = numbers.get(key, 0) + count
    return numbers


def parse_equation(text: str) -> dict[str, int]:
    """Return the coefficients of ``2 H2O2 -> 2 H2O + O2(g)`` by key, reactants negative."""
    left, right = text.split(" -> ")
    numbers = {key: -n for key, n in parse_side(left).items()}
    for key, n in parse_side(right).items():
        numbers[key] = numbers.get(key, 0) + n
    return {key: n for key, n in numbers.items() if n}


def with_acid_of(
    coefficients: Mapping[str, float], state: Mapping[str, float], weakest: float
) -> dict[str, float] | None:
    """Return a reaction with its protons taken from, or given to, what the solution holds.

    Args:
        coefficients: With protons and hydroxide as the half reactions write them.
        state: Amounts before [mol].
        weakest: Largest pKa of an acid that may give the protons; water counts as 14.

    Returns:
        The reaction, or None where nothing can give the protons.
    """
    made = network().species
    numbers = dict(coefficients)
    hydroxide = numbers.pop(HYDROXIDE, 0.0)
    protons = numbers.pop(PROTON, 0.0) - hydroxide
    numbers[WATER] = numbers.get(WATER, 0.0) + hydroxide
    if protons < 0:
        source = _strongest_acid(state, numbers)
        if source is None:
            if weakest < 14.0:
                return None
            numbers[WATER] += protons
            numbers[HYDROXIDE] = -protons
        elif source == PROTON:
            numbers[PROTON] = protons
        else:
            base = _BASES[source]
            if made[source].log_k - made[base].log_k > weakest:
                return None
            numbers[source] = numbers.get(source, 0.0) + protons
            numbers[base] = numbers.get(base, 0.0) - protons
    elif protons > 0:
        if state.get(HYDROXIDE, 0.0) > 1e-9:
            numbers[HYDROXIDE] = -protons
            numbers[WATER] += protons
        else:
            numbers[PROTON] = protons
    return {key: n for key, n in numbers.items() if abs(n) > 1e-12}


class _Bases(dict[str, str]):
    """By acid its base, worked out when first asked."""

    def __missing__(self, acid: str) -> str:
        made = network().species
        wanted = dict(made[acid].components)
        wanted[PROTON] = wanted.get(PROTON, 0.0) - 1.0
        wanted = {name: n for name, n in wanted.items() if n}
        base = next(
            (k for k, one in made.items() if one.phase == "aq" and dict(one.components) == wanted),
            "",
        )
        self[acid] = base
        return base


_BASES = _Bases()


def _strongest_acid(state: Mapping[str, float], taken: Mapping[str, float]) -> str | None:
    made = network().species
    acids = [
        key
        for key, amount in state.items()
        if amount > 1e-12
        and key in made
        and made[key].phase == "aq"
        and made[key].components.get(PROTON, 0.0) > 0
        and key not in taken
        and key != PROTON
        and _BASES[key]
    ]
    strongest = min(acids, key=lambda k: made[k].log_k - made[_BASES[k]].log_k, default=None)
    free, bound = state.get(PROTON, 0.0), state.get(strongest, 0.0) if strongest else 0.0
    if free > 1e-12 and free > _FREE_PART * bound:
        return PROTON
    return strongest


_FREE_PART = 0.1
"""Part of a weak acid from which free protons are written before it; an estimate of ours."""
