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
    conversion: float = 1.0
    source: str


class KnownReactionTable(BaseModel):
    """The whole file."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    sources: Mapping[str, str]
    reactions: tuple[KnownReaction, ...]


@dataclass(frozen=True)
class _Parsed:
    record: KnownReaction
    coefficients: Mapping[str, int]


@cache
def known() -> tuple[_Parsed, ...]:
    """Return the reactions whose every species the tables know."""
    text = (files("labutopia_lerobot.chemistry") / "data" / "known_reactions.json").read_text(
        encoding="utf-8"
    )
    records = KnownReactionTable.model_validate_json(text).reactions
    parsed = (_Parsed(one, parse_equation(one.equation)) for one in records)
    return tuple(
        one
        for one in parsed
        if all(key in network().species for key in one.coefficients)
        and is_balanced(one.coefficients)
    )


def products(species: frozenset[str]) -> set[str]:
    """Return every species that some species can make in water, slow reactions left out."""
    fast = (one for one in known() if not one.record.dry and not one.record.slow)
    return {
        key
        for one in fast
        if all(used in species for used, n in one.coefficients.items() if n < 0)
        for key, n in one.coefficients.items()
        if n > 0
    }


def any_slow(species: frozenset[str]) -> bool:
    """Return whether a slow reaction of some species in water is known."""
    return any(one.record.slow and not one.record.dry for one in _of_what_is_there(species))


@lru_cache(maxsize=4096)
def _of_what_is_there(species: frozenset[str]) -> tuple[_Parsed, ...]:
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
                conversion=record.conversion,
            )
