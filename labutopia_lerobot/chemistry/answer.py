"""Checks what a language model answers: form, balance, species, safety.

An answer is refused whole. What it may react are the reactants, their ions, water, what an earlier
reaction made, conjugate acids and bases of these and, in an open vessel, air.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache

from labutopia_lerobot.chemistry.compound import Compound, substances
from labutopia_lerobot.chemistry.equation import Composition, Equation, composition, read_equation
from labutopia_lerobot.chemistry.formula import Formula, parse
from labutopia_lerobot.chemistry.names import resolve
from labutopia_lerobot.chemistry.reaction import Conditions, Product, Reactant, Reaction
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.foreign_files import checked, parse_json

LONGEST = 50_000
"""Characters of an answer; one of the paper's form has about 600 for each reaction."""

_LONGEST_TEXT = 500
_MOST_ENTRIES = 20

_WATER = ("H2O", "H^+", "H3O^+", "OH^-")
_AIR = ("O2", "N2", "CO2")

_CONTROLLED = {
    "sarin": "C4H10FO2P",
    "soman": "C7H16FO2P",
    "tabun": "C5H11N2O2P",
    "VX": "C11H26NO2PS",
    "sulfur mustard": "C4H8Cl2S",
    "lewisite": "C2H2AsCl3",
    "phosgene": "COCl2",
    "cyanogen chloride": "CNCl",
    "hydrogen cyanide": "HCN",
    "chloropicrin": "CCl3NO2",
    "amphetamine": "C9H13N",
    "methamphetamine": "C10H15N",
    "MDMA": "C11H15NO2",
}
"""Source: Chemical Weapons Convention, Annex on Chemicals, schedules 1 to 3, and Convention on
Psychotropic Substances, schedules I and II; the choice of those that few atoms make is ours."""

_DANGEROUS_WORDS = ("detonat", "explosi", "explode", "nerve agent", "chemical weapon")


class AnswerError(ChemistryError):
    """An answer of a language model breaks a rule; the message says which."""


@dataclass(frozen=True)
class _Answer:
    reactions: tuple[Reaction, ...]


def read_answer(
    said: str, portions: Sequence[Reactant], conditions: Conditions
) -> tuple[Reaction, ...]:
    """Return the reactions of an answer in the paper's form.

    Args:
        said: What the model said: JSON, and nothing else.
        portions: What it was asked about.
        conditions: Under which conditions.

    Raises:
        AnswerError: If it breaks a rule.
    """
    if len(said) > LONGEST:
        raise AnswerError(f"it has more than {LONGEST:,} characters")
    answer: _Answer = checked(
        _Answer, parse_json(said, "the answer", AnswerError), "the answer", AnswerError
    )
    require_possible(answer.reactions, portions, conditions)
    return answer.reactions


def require_possible(
    reactions: Sequence[Reaction], portions: Sequence[Reactant], conditions: Conditions
) -> None:
    """Make sure that reactions may be an answer.

    Args:
        reactions: Those of the answer.
        portions: Those that were asked about.
        conditions: Under which conditions.

    Raises:
        AnswerError: If one breaks a rule.
    """
    _require_few("reactions", reactions)
    ids = [reaction.reaction_id for reaction in reactions]
    if len(set(ids)) < len(ids):
        raise AnswerError("two reactions have the same reaction_id")
    there = _there(portions, conditions)
    for reaction in reactions:
        _require_sober(reaction)
        try:
            equation = read_equation(reaction.stoichiometry)
            _require_products(reaction, equation)
        except AnswerError:
            raise
        except ChemistryError as error:
            raise AnswerError(f"{reaction.reaction_id}: {error}") from None
        for term in equation.left:
            if composition(term.formula) not in there:
                raise AnswerError(
                    f"{reaction.reaction_id}: {term.formula.text} is none of the reactants, of "
                    "their ions, or made before"
                )
        there = _with_conjugates(there | {composition(term.formula) for term in equation.right})


def _there(portions: Sequence[Reactant], conditions: Conditions) -> set[Composition]:
    """Return what may react first."""
    words = [portion.compound for portion in portions]
    compounds = [resolve(word) for word in (*words, conditions.solvent, *conditions.catalysts)]
    formulas = {text for compound in compounds for text in _forms(compound)}
    formulas |= {*_WATER, *(_AIR if conditions.open_system else ())}
    return _with_conjugates({composition(parse(text)) for text in formulas})


def _forms(compound: Compound) -> Iterator[str]:
    yield compound.formula
    yield compound.formula.partition("·")[0]  # without its water of crystallisation
    yield from compound.ions


def _with_conjugates(there: set[Composition]) -> set[Composition]:
    """Return species, and what each becomes by gaining or losing protons."""
    missing = [pair for pair in _conjugates() if len(pair & there) == 1]
    return _with_conjugates(there.union(*missing)) if missing else there


@cache
def _conjugates() -> frozenset[frozenset[Composition]]:
    """Return every acid of the table with its base."""
    steps = (step for one in substances().values() for step in one.acidity)
    return frozenset(
        frozenset({composition(parse(step.acid)), composition(parse(step.base))}) for step in steps
    )


def _require_few(what: str, entries: Sequence[object]) -> None:
    if len(entries) > _MOST_ENTRIES:
        raise AnswerError(f"it has more than {_MOST_ENTRIES} {what}")


def _require_sober(reaction: Reaction) -> None:
    """Raise for texts that are empty, long, no text, or about explosions, and odd numbers."""
    name = reaction.reaction_id
    products = [(one.compound_name, one.chemical_formula) for one in reaction.expected_products]
    needed = [name, reaction.reaction_type, reaction.stoichiometry, *sum(products, ())]
    _require_few("expected_products", reaction.expected_products)
    _require_few("observable_changes", reaction.observable_changes)
    for text in (*needed, *reaction.observable_changes, reaction.rationale):
        if len(text) > _LONGEST_TEXT:
            raise AnswerError(f"a text has more than {_LONGEST_TEXT} characters")
        if not text.isprintable():
            raise AnswerError("a text has characters that cannot be printed")
        word = next((word for word in _DANGEROUS_WORDS if word in text.casefold()), None)
        if word is not None:
            raise AnswerError(f"{name}: '{word}...' breaks the safety rules")
    if not all(text.strip() for text in needed):
        raise AnswerError(f"{name}: a text is empty")
    score = reaction.confidence_score
    if not (math.isfinite(score) and 0.0 <= score <= 1.0):
        raise AnswerError(f"{name}: confidence_score={score:g} is not from 0.0 to 1.0")


def _require_products(reaction: Reaction, equation: Equation) -> None:
    """Raise unless what is made is safe, and listed products are what the equation makes."""
    made = {composition(term.formula) for term in equation.right}
    for term in equation.right:
        _require_safe(reaction, term.formula)
    if not reaction.expected_products:
        raise AnswerError(f"{reaction.reaction_id}: expected_products is empty")
    for product in reaction.expected_products:
        formula = parse(product.chemical_formula)
        if composition(formula) not in made:
            raise AnswerError(
                f"{reaction.reaction_id}: product {product.chemical_formula} is not made by "
                f"{reaction.stoichiometry}"
            )
        _require_named(reaction, product, formula)


def _require_named(reaction: Reaction, product: Product, formula: Formula) -> None:
    """Raise if a product has the name of another compound."""
    try:
        named = resolve(product.compound_name)
    except ChemistryError:
        return  # not in the table: a well-formed formula is enough
    forms = _with_conjugates({composition(parse(text)) for text in _forms(named)})
    names_it = composition(formula) in forms
    is_same_element = len(formula.atoms) == 1 and set(formula.atoms) == set(named.composition.atoms)
    # Sulfur is S8 in the table and S in most books; ions have names of elements.
    if formula.charge == 0 and not names_it and not is_same_element:
        raise AnswerError(
            f"{reaction.reaction_id}: {product.compound_name} is {named.formula}, "
            f"not {product.chemical_formula}"
        )


def _require_safe(reaction: Reaction, formula: Formula) -> None:
    dangerous = _dangerous().get(composition(formula))
    if dangerous is not None:
        raise AnswerError(f"{reaction.reaction_id}: making {dangerous} breaks the safety rules")


@cache
def _dangerous() -> dict[Composition, str]:
    """Return the names of explosives and of controlled compounds by composition."""
    explosives = {
        composition(one.composition): one.name
        for one in substances().values()
        if "explosive" in one.reactivity
    }
    return explosives | {composition(parse(text)): name for name, text in _CONTROLLED.items()}
