"""An outcome as JSON: the paper's form, and beside it the numbers that it has no place for."""

from dataclasses import asdict
from typing import Any, get_args

from labutopia_lerobot.chemistry.reaction import Outcome, Phase, Reaction, Yield


def paper_form(outcome: Outcome) -> dict[str, Any]:
    """Return the reactions with the paper's keys in the paper's order.

    Source: the paper's appendix, "Process Reasoning Pipeline", the listing of the prompt.
    """
    return {"reactions": [_reaction(reaction) for reaction in outcome.reactions]}


def _reaction(reaction: Reaction) -> dict[str, Any]:
    return asdict(reaction) | {
        "expected_products": [asdict(product) for product in reaction.expected_products],
        "observable_changes": list(reaction.observable_changes),
    }


def amounts_form(outcome: Outcome) -> dict[str, Any]:
    """Return the numbers of an outcome; keys end with their SI unit.

    Returns:
        `before_mol`, `after_mol` (by species), `extents_mol` (by `reaction_id`), `heat_J` (given
        off), `temperature_K`, `volume_m3`, `ph` or None, `colour_srgb` of 1 cm before white,
        `turbid`, and `note`.
    """
    amounts = outcome.amounts
    return {
        "before_mol": amounts.before,
        "after_mol": amounts.after,
        "extents_mol": amounts.extents,
        "heat_J": amounts.heat,
        "temperature_K": amounts.temperature,
        "volume_m3": amounts.volume,
        "ph": amounts.ph,
        "colour_srgb": list(amounts.colour),
        "turbid": amounts.turbid,
        "note": outcome.note,
    }


def _object(**properties: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of an object that has all of these keys and no others."""
    return {
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


def _list(items: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items}


_TEXT = {"type": "string"}

_EQUATION = _TEXT | {
    "description": (
        "One balanced equation, such as 'HCl(aq) + NaOH(aq) -> NaCl(aq) + H2O(l)' or "
        "'Ba^2+(aq) + SO4^2-(aq) -> BaSO4(s)'"
    )
}

_PRODUCT = _object(
    compound_name=_TEXT,
    chemical_formula=_TEXT,
    phase={"type": "string", "enum": list(get_args(Phase))},
    qualitative_yield={"type": ["string", "null"], "enum": [*get_args(Yield), None]},
)

_REACTION = _object(
    reaction_id=_TEXT,
    reaction_type=_TEXT,
    stoichiometry=_EQUATION,
    expected_products=_list(_PRODUCT),
    observable_changes=_list(_TEXT),
    confidence_score={"type": "number", "minimum": 0.0, "maximum": 1.0},
    rationale=_TEXT,
)

PAPER_SCHEMA = _object(reactions=_list(_REACTION))
"""JSON Schema of the paper's form: every key is there, no other is."""
