"""The paper's prompt, word for word, filled with reactants, conditions and records.

Source: the paper's appendix, "Process Reasoning Pipeline", "LLM prompt template for reaction
inference". It has four conditions; catalysts, pH and amounts follow where they are given. Only
names of the database are filled in: no text of a user reaches the model.
"""

import json
from collections.abc import Sequence

from labutopia_lerobot.chemistry import chem_db, names
from labutopia_lerobot.chemistry.reaction import Conditions, Reactant

FIELDS = (
    "compound_name",
    "chemical_formula",
    "molar_mass",
    "density",
    "melting_point",
    "boiling_point",
    "solubility",
    "sublimation_point",
    "appearance",
)
"""Fields retrieved of each reactant: the fields of the paper's example of a query."""

SYSTEM = """\
You are a chemical process reasoning assistant. Use only the provided compound attributes to infer \
plausible qualitative reactions.
Follow safety rules:\x20
(1) do not propose energetic detonation sequences,\x20
(2) avoid suggesting synthesis of controlled or hazardous compounds,
(3) prefer qualitative descriptions that are experimentally interpretable.
Return results as JSON conforming exactly to the requested schema."""
"""What the model is, and its three rules; `\\x20` is a blank at the end of a line."""

_USER = """\
Context:
- Reactants: {reactants}
- Experimental conditions: {conditions}
- Retrieved compound records: {records}

Task:
1. Infer plausible reaction(s) between the reactants under the given conditions.
2. For each inferred reaction, provide:
   - reaction_id
   - reaction_type (e.g., neutralization, precipitation, redox, hydrolysis)
   - stoichiometry (if obvious qualitatively)
   - expected_products (list of product objects with names and basic attributes)
   - observable_changes (color change, gas evolution, precipitation, temperature change)
   - confidence_score (0.0 - 1.0)
3. Provide a short rationale (1-2 sentences).

Return ONLY JSON following this schema:
{{
  "reactions": [
    {{
      "reaction_id": "r1",
      "reaction_type": "...",
      "stoichiometry": "...",
      "expected_products": [
         {{"compound_name":"...", "chemical_formula":"...", "phase":"aq/solid/gas", \
"qualitative_yield":"high/medium/low or null"}}
      ],
      "observable_changes": ["..."],
      "confidence_score": 0.0,
      "rationale":"..."
    }}
  ]
}}"""


def prompt(portions: Sequence[Reactant], conditions: Conditions) -> list[dict[str, str]]:
    """Return the two messages for a model.

    Raises:
        UnknownCompoundError: If a compound, the solvent or a catalyst is none of the database.
        AmbiguousCompoundError: If one of them may be several.
    """
    reactants = [names.resolve(portion.compound).name for portion in portions]
    records = chem_db.lookup({"compounds": reactants, "fields": list(FIELDS)})
    said = filled(
        json.dumps(reactants, ensure_ascii=False),
        _conditions(reactants, portions, conditions),
        json.dumps(records, ensure_ascii=False),
    )
    return [{"role": "system", "content": SYSTEM}, {"role": "user", "content": said}]


def filled(reactants: str, conditions: str, records: str) -> str:
    """Return the paper's user instruction with three texts, each JSON, in their places."""
    return _USER.format(reactants=reactants, conditions=conditions, records=records)


def _conditions(
    reactants: Sequence[str], portions: Sequence[Reactant], conditions: Conditions
) -> str:
    """Return conditions as the paper writes them."""
    said: dict[str, object] = {
        "solvent": names.resolve(conditions.solvent).name.lower(),
        "temperature": f"{conditions.temperature - 273.15:.6g} C",
        "concentration": f"{conditions.concentration / 1000:.6g} M",
        "open_system": conditions.open_system,
    }
    if conditions.catalysts:
        said["catalysts"] = [names.resolve(name).name for name in conditions.catalysts]
    if conditions.ph is not None:
        said["pH"] = conditions.ph
    amounts = {
        name: f"{portion.amount:.6g} mol"
        for name, portion in zip(reactants, portions, strict=True)
        if portion.amount is not None
    }
    if amounts:
        said["amounts"] = amounts
    return json.dumps(said, ensure_ascii=False)
