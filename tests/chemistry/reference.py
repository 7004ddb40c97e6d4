"""The reference list, and whether an outcome agrees with one entry of it."""

import hashlib
import json
from collections import Counter
from pathlib import Path
from typing import Any

from labutopia_lerobot.chemistry import colour
from labutopia_lerobot.chemistry.engine import react
from labutopia_lerobot.chemistry.formula import parse
from labutopia_lerobot.chemistry.reaction import Conditions, Outcome, Reactant
from labutopia_lerobot.chemistry.refusals import ChemistryError, HazardRefusedError

_FILE = Path(__file__).with_name("reference_reactions.json")

_SIMILAR = {"red": ("red", "pink", "orange", "pale red", "pale orange")}
_SIMILAR["pink"] = ("pink", "red", "purple", "pale purple", "pale red")

__all__ = ["ChemistryError", "atoms", "disagreement", "entries", "is_held_out", "sides"]

type Side = Counter[tuple[frozenset[tuple[str, int]], int, str]]


def entries(*, held_out: bool) -> list[dict[str, Any]]:
    listed: list[dict[str, Any]] = json.loads(_FILE.read_text(encoding="utf-8"))["reactions"]
    return [one for one in listed if is_held_out(one["id"]) == held_out]


def is_held_out(name: str) -> bool:
    return int(hashlib.sha256(name.encode()).hexdigest(), 16) % 2 == 1


def sides(equation: str) -> tuple[Side, Side]:
    left, right = equation.split(" -> ")
    return _side(left), _side(right)


def _side(text: str) -> Side:
    counted: Side = Counter()
    for term in text.split(" + "):
        words = term.split()
        number, name = (int(words[0]), words[1]) if len(words) == 2 else (1, words[0])
        phase = "aq"
        if name.endswith(("(s)", "(l)", "(g)")):
            name, phase = name[:-3], name[-2]
        composition = parse(name)
        phase = "aq" if phase == "l" else phase
        counted[frozenset(composition.atoms.items()), composition.charge, phase] += number
    return counted


def atoms(side: Side) -> Counter[str]:
    counted: Counter[str] = Counter()
    for (composition, charge, _), number in side.items():
        counted["charge"] += charge * number
        for element, n in composition:
            counted[element] += n * number
    return Counter({name: n for name, n in counted.items() if n})


def disagreement(entry: dict[str, Any]) -> str | None:
    """Return how the engine's answer differs from the book's, or None."""
    portions = [Reactant(**one) for one in entry["reactants"]]
    asked = dict(entry["conditions"])
    if "catalysts" in asked:
        asked["catalysts"] = tuple(asked["catalysts"])
    try:
        outcome = react(portions, Conditions(**asked))
    except HazardRefusedError:
        return None if entry["type"] == "hazard" else "refused as a hazard"
    if entry["type"] == "hazard":
        return "not refused"
    return _difference(entry, outcome)


def _difference(entry: dict[str, Any], outcome: Outcome) -> str | None:
    if entry["type"] == "none":
        if not outcome.reactions:
            return None
        return f"expected nothing, got {outcome.reactions[0].stoichiometry}"
    if entry["type"] == "indicator":
        is_called = colour.word(outcome.amounts.colour)
        wanted = entry["colour"]
        if is_called.removeprefix("pale ") in _SIMILAR.get(wanted, (wanted,)):
            return None
        return f"expected {wanted}, got {is_called}"
    if not outcome.reactions:
        return f"expected {entry['equations'][0]}, got nothing"
    first = outcome.reactions[0]
    if first.reaction_type != entry["type"]:
        return f"expected {entry['type']}, got {first.reaction_type}: {first.stoichiometry}"
    if any(sides(first.stoichiometry) == sides(one) for one in entry["equations"]):
        return None
    return f"expected {entry['equations'][0]}, got {first.stoichiometry}"
