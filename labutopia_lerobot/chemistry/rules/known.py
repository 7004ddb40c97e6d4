"""Reactions that are known one by one: heating, catalysis and slow organic reactions.

`data/known_reactions.json` lists each with its conditions and source.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from typing import Literal

from pydantic import BaseModel, ConfigDict

from labutopia_lerobot.chemistry.change import is_balanced, parse_equation
from labutopia_lerobot.chemistry.network import network
from labutopia_lerobot.chemistry.rules.reaction_step import ReactionStep


class RateLaw(BaseModel):
    """How fast a reaction in water runs by one path.

    Attributes:
        constant: At 25 C, in mol, litres and seconds.
        activation: Energy in Arrhenius' law [J/mol].
        orders: Key of a species -> the power of its concentration.
        source: Key of the source.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    constant: float
    activation: float
    orders: Mapping[str, float]
    source: str


class KnownReaction(BaseModel):
    """One line of the file.

    Attributes:
        equation: Balanced.
        kind: ``reaction_type``.
        dry: Whether it runs without water.
        lowest_temperature: From which it runs [K].
        lowest_ph: From which it runs.
        highest_ph: Up to which it runs.
        catalysts: Any one of which it needs; none needed if empty.
        slow: Whether it takes minutes or more.
        rates: Of the paths by which a slow one runs; none if that is not known. They add up.
        conversion: Part of the scarcest reactant that is used up at the end.
        source: Key of the source.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    equation: str
    kind: Literal[
        "decomposition",
        "redox",
        "esterification",
        "acetylation",
        "saponification",
        "hydrolysis",
    ]
    dry: bool = False
    lowest_temperature: float = 0.0
    lowest_ph: float = -math.inf
    highest_ph: float = math.inf
    catalysts: tuple[str, ...] = ()
    slow: bool = False
    rates: tuple[RateLaw, ...] = ()
    conversion: float = 1.0
    source: str


class KnownReactionTable(BaseModel):
    """The whole file."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    sources: Mapping[str, str]
    reactions: tuple[KnownReaction, ...]


@dataclass(frozen=True)
class ParsedReaction:
    """A line of the file, and what it uses up and makes.

    Attributes:
        record: The line.
        coefficients: Whole numbers by key, negative for what is used up.
    """

    record: KnownReaction
    coefficients: Mapping[str, int]

    @property
    def untimed(self) -> bool:
        """Whether it is slow, and nothing is known of how slow."""
        return self.record.slow and not self.record.rates


@cache
def known() -> tuple[ParsedReaction, ...]:
    """Return the reactions whose every species the tables know."""
    text = (files("labutopia_lerobot.chemistry") / "data" / "known_reactions.json").read_text(
        encoding="utf-8"
    )
    records = KnownReactionTable.model_validate_json(text).reactions
    parsed = (ParsedReaction(one, parse_equation(one.equation)) for one in records)
    return tuple(
        one
        for one in parsed
        if all(key in network().species for key in one.coefficients)
        and is_balanced(one.coefficients)
    )


def products(species: frozenset[str]) -> set[str]:
    """Return every species that some species can make in water, at a speed that is known."""
    seen = (one for one in known() if not one.record.dry and not one.untimed)
    return {
        key
        for one in seen
        if all(used in species for used, n in one.coefficients.items() if n < 0)
        for key, n in one.coefficients.items()
        if n > 0
    }


def any_slow(species: frozenset[str]) -> bool:
    """Return whether some species react in water slowly, and nothing is known of how slowly."""
    return any(one.untimed and not one.record.dry for one in _of_what_is_there(species))


def with_rates(species: frozenset[str]) -> tuple[ParsedReaction, ...]:
    """Return the slow reactions of some species in water of which the rate is known."""
    return tuple(one for one in _of_what_is_there(species) if one.record.rates)


@lru_cache(maxsize=4096)
def _of_what_is_there(species: frozenset[str]) -> tuple[ParsedReaction, ...]:
    """Return the reactions that use up none but some species."""
    return tuple(
        one
        for one in known()
        if all(used in species for used, n in one.coefficients.items() if n < 0)
    )


def steps(
    state: Mapping[str, float], *, temperature: float, ph: float | None, catalysts: frozenset[str]
) -> Iterator[ReactionStep]:
    """Yield what runs under these conditions.

    Args:
        state: Amounts [mol].
        temperature: [K].
        ph: None without water.
        catalysts: Species and formulas that are present.
    """
    for one in _of_what_is_there(frozenset(state)):
        record = one.record
        if record.dry != (ph is None) or temperature < record.lowest_temperature:
            continue
        if ph is not None and not record.lowest_ph <= ph <= record.highest_ph:
            continue
        if record.catalysts and not catalysts.intersection(record.catalysts):
            continue
        if all(state.get(key, 0.0) > 0 for key, n in one.coefficients.items() if n < 0):
            why = f"A known {record.kind}"
            if record.lowest_temperature:
                why += f" above {record.lowest_temperature:.0f} K"
            why += "; it takes minutes to hours." if record.slow else "."
            yield ReactionStep(
                one.coefficients,
                record.kind,
                why,
                confidence=0.8 if record.slow else 0.9,
                slow=record.slow,
                timed=bool(record.rates),
                conversion=record.conversion,
            )
