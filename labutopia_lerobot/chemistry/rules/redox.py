"""Redox: of two couples the one with the higher potential takes the electrons.

Standard potentials are those of the CRC Handbook (`data/half_reactions.json`); they are corrected
for pH and for what complexes or solids hold back by Nernst's equation. Potentials say nothing of
how fast: which couples react within minutes is listed with each of them, after Greenwood and
Earnshaw, Chemistry of the Elements.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files

from pydantic import BaseModel, ConfigDict

from labutopia_lerobot.chemistry.change import parse_side, whole, with_acid_of
from labutopia_lerobot.chemistry.network import HYDROXIDE, MOLAR_GAS, PROTON, WATER, network
from labutopia_lerobot.chemistry.rules.reaction_step import (
    ReactionStep,
    available,
    core,
    in_what_is_there,
)
from labutopia_lerobot.chemistry.speciation import ph_of

_NERNST = math.log(10) * MOLAR_GAS / 96485.33212
"""Of Nernst's equation, per decade and kelvin [V/K]: 59.16 mV at 25 C."""

_LEAST_VOLTAGE = 0.05
"""Voltage below which a pair is left alone [V]; an estimate of ours."""

_ESCAPE_VOLTAGE = 0.06
"""What a halogen that leaves at 0.01 bar gains [V]: Nernst, two electrons."""


class HalfReactionRecord(BaseModel):
    """One couple.

    Attributes:
        equation: Oxidised form and electrons to the left.
        potential: Standard, at 25 C [V].
        oxidises: Reduced forms that it reacts with within minutes.
        reduces: Oxidised forms that its reduced form reacts with within minutes.
        lowest_ph: From which it acts.
        highest_ph: Up to which it acts.
        least: Concentrations that it needs [mol/l].
        most: Concentrations below which it acts [mol/l].
        source: Key of the source.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    equation: str
    potential: float
    oxidises: tuple[str, ...] = ()
    reduces: tuple[str, ...] = ()
    lowest_ph: float = -math.inf
    highest_ph: float = math.inf
    least: Mapping[str, float] = {}
    most: Mapping[str, float] = {}
    source: str


class HalfReactionTable(BaseModel):
    """The whole file."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=True)

    sources: Mapping[str, str]
    half_reactions: tuple[HalfReactionRecord, ...]


@dataclass(frozen=True)
class Couple:
    """A half reaction with species as keys.

    Attributes:
        record: As the file says it.
        coefficients: Oxidised side negative, without electrons.
        electrons: How many it takes.
        oxidised: Key of the form that takes them.
        reduced: Key of the form that it becomes.
    """

    record: HalfReactionRecord
    coefficients: Mapping[str, int]
    electrons: int
    oxidised: str
    reduced: str


@cache
def couples() -> tuple[Couple, ...]:
    """Return all couples of the file."""
    text = (files("labutopia_lerobot.chemistry") / "data" / "half_reactions.json").read_text(
        encoding="utf-8"
    )
    return tuple(_couple(one) for one in HalfReactionTable.model_validate_json(text).half_reactions)


def _couple(record: HalfReactionRecord) -> Couple:
    left, right = record.equation.split(" -> ")
    terms = left.split(" + ")
    electrons = next(term for term in terms if term.split()[-1] == "e")
    taken = parse_side(" + ".join(term for term in terms if term is not electrons))
    given = parse_side(right)
    coefficients = {key: -n for key, n in taken.items()}
    for key, n in given.items():
        coefficients[key] = coefficients.get(key, 0) + n
    medium = {PROTON, HYDROXIDE, WATER}
    oxidised = next((key for key in taken if key not in medium), next(iter(taken)))
    reduced = next((key for key in given if key not in medium), next(iter(given)))
    words = electrons.split()
    return Couple(record, coefficients, int(words[0]) if len(words) == 2 else 1, oxidised, reduced)


def _pairs() -> Iterator[tuple[Couple, Couple]]:
    for taker in couples():
        partners = {_key(name) for name in taker.record.oxidises}
        for giver in couples():
            named = {_key(name) for name in giver.record.reduces}
            if giver is not taker and giver.reduced in partners and taker.oxidised in named:
                yield taker, giver


@cache
def _key(name: str) -> str:
    return next(iter(parse_side(name)))


@dataclass(frozen=True)
class _Pair:
    taker: Couple
    giver: Couple
    coefficients: Mapping[str, int]
    cores: frozenset[str]


@cache
def _reactions() -> tuple[_Pair, ...]:
    """Return every pair that the file allows, balanced by its electrons."""
    made = []
    for taker, giver in _pairs():
        common = math.lcm(taker.electrons, giver.electrons)
        numbers: dict[str, float] = {}
        for couple, sign in ((taker, 1), (giver, -1)):
            for key, n in couple.coefficients.items():
                times = sign * common // couple.electrons
                numbers[key] = numbers.get(key, 0) + times * n
        balanced = whole(numbers)
        if balanced is not None:
            cores = {core(taker.oxidised), core(giver.reduced)} - {None, PROTON, WATER}
            made.append(_Pair(taker, giver, balanced, frozenset(c for c in cores if c)))
    return tuple(made)


@lru_cache(maxsize=4096)
def _of_what_is_there(species: frozenset[str]) -> tuple[_Pair, ...]:
    """Return the pairs whose cores some species consist of."""
    made = network().species
    parts = {part for key in species if key in made for part in made[key].components}
    return tuple(pair for pair in _reactions() if pair.cores <= parts)


def products(components: frozenset[str]) -> set[str]:
    """Return every species that couples can make of what consists of some components."""
    pairs = (pair for pair in _reactions() if pair.cores <= components)
    return {key for pair in pairs for key, n in pair.coefficients.items() if n > 0}


def steps(
    state: Mapping[str, float], settled: Mapping[str, float], volume: float, temperature: float
) -> Iterator[ReactionStep]:
    """Yield what can react, the largest voltage first.

    Args:
        state: Amounts as they were poured or made [mol].
        settled: The same at equilibrium, oxidation numbers unchanged.
        volume: Of the solution [m^3].
        temperature: [K].
    """
    ph = ph_of(settled, volume)
    litres = volume * 1000.0
    found: list[tuple[float, _Pair]] = []
    for pair in _of_what_is_there(frozenset(state)):
        if available(state, pair.taker.oxidised) <= 0 or available(state, pair.giver.reduced) <= 0:
            continue
        if not all(_acts(one.record, ph, settled, litres) for one in (pair.taker, pair.giver)):
            continue
        voltage = _potential(pair.taker, ph, settled, temperature)
        voltage -= _potential(pair.giver, ph, settled, temperature)
        voltage += _plenty(pair.giver, settled, litres, temperature)
        if voltage > _LEAST_VOLTAGE:
            found.append((voltage, pair))
    found.sort(key=lambda one: -one[0])
    for voltage, pair in found:
        weakest = min(pair.taker.record.highest_ph, pair.giver.record.highest_ph) + 2.0
        numbers = in_what_is_there(pair.coefficients, state)
        with_acid = with_acid_of(numbers, state, weakest)
        balanced = None if with_acid is None else whole(with_acid)
        if balanced is not None:
            yield ReactionStep(
                balanced,
                "redox",
                f"{_name(pair.giver.reduced)} gives electrons to {_name(pair.taker.oxidised)}: "
                f"the potentials differ by {voltage:.2f} V.",
            )


def _name(key: str) -> str:
    return network().species[key].name if key in network().species else key


def _acts(
    record: HalfReactionRecord, ph: float, settled: Mapping[str, float], litres: float
) -> bool:
    if not record.lowest_ph <= ph < record.highest_ph:
        return False
    if any(settled.get(_key(k), 0.0) / litres < least for k, least in record.least.items()):
        return False
    return all(settled.get(_key(k), 0.0) / litres < most for k, most in record.most.items())


def _potential(
    couple: Couple, ph: float, settled: Mapping[str, float], temperature: float
) -> float:
    """Return the potential at this pH, the rest at equal concentrations of both forms [V]."""
    protons = -couple.coefficients.get(PROTON, 0) + couple.coefficients.get(HYDROXIDE, 0)
    decade = _NERNST * temperature / couple.electrons
    basic = couple.coefficients.get(HYDROXIDE, 0)
    potential = couple.record.potential - decade * (protons * ph - 14.0 * basic)
    potential -= decade * sum(n * _free(key, settled) for key, n in couple.coefficients.items())
    return potential - (_ESCAPE_VOLTAGE if couple.record.least.get("Cl^-") else 0.0)


def _plenty(
    couple: Couple, settled: Mapping[str, float], litres: float, temperature: float
) -> float:
    """Return what more than 1 mol/l of the reduced form adds, in concentrated acids [V]."""
    molar = max(settled.get(couple.reduced, 0.0) / litres, 1.0)
    times = couple.coefficients.get(couple.reduced, 0) / couple.electrons
    return _NERNST * temperature * times * math.log10(molar)


def _free(key: str, settled: Mapping[str, float]) -> float:
    """Return the decimal logarithm of the part of an ion that nothing holds."""
    one = network().species.get(key)
    if one is None or one.phase != "aq" or not one.is_component or one.composition.charge == 0:
        return 0.0
    whole_amount = available(settled, key)
    if key in (PROTON, HYDROXIDE) or whole_amount <= 0:
        return 0.0
    return math.log10(max(settled.get(key, 0.0) / whole_amount, 1e-40))
