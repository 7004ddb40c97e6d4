"""A reaction's equation as text: its species, and whether atoms and charge balance."""

import re
from collections import Counter
from dataclasses import dataclass

from labutopia_lerobot.chemistry.formula import Formula, parse
from labutopia_lerobot.chemistry.refusals import ChemistryError

type Composition = tuple[frozenset[tuple[str, int]], int]
"""Atoms and charge: what is the same of a species however its formula is written."""

_ARROW = re.compile(r"\s*(?:<?[-=]+>|[→⇌⟶=])\s*")
_PLUS = re.compile(r"\s+\+\s+")
_TERM = re.compile(r"(?P<count>\d{0,3})\s*(?P<formula>\S+?)\s*(?:\((?P<phase>aq|s|l|g)\))?")


class EquationError(ChemistryError):
    """A text is no equation, or atoms or charge do not balance; the message says which."""


@dataclass(frozen=True)
class Term:
    """A species in an equation.

    Attributes:
        count: Its stoichiometric number, more than 0.
        formula: Its atoms and charge.
        phase: `aq`, `s`, `l`, `g`, or nothing where it is not written.
    """

    count: int
    formula: Formula
    phase: str


@dataclass(frozen=True)
class Equation:
    """Both sides of an equation that balances."""

    left: tuple[Term, ...]
    right: tuple[Term, ...]


def composition(formula: Formula) -> Composition:
    """Return the atoms and the charge of a formula."""
    return frozenset(formula.atoms.items()), formula.charge


def read_equation(text: str) -> Equation:
    """Return what an equation such as `Ba^2+ + SO4^2- -> BaSO4(s)` says.

    Raises:
        EquationError: If it is none, or does not balance.
        FormulaError: If a species is no formula.
    """
    sides = _ARROW.split(text.strip())
    if len(sides) != 2 or not all(sides):
        raise EquationError(f"equation {text!r} has no two sides with -> between them")
    equation = Equation(_terms(sides[0]), _terms(sides[1]))
    left, right = _totals(equation.left), _totals(equation.right)
    for what in sorted(left.keys() | right.keys()):
        if left[what] != right[what]:
            raise EquationError(
                f"equation {text!r} does not balance: {what} {left[what]} on the left, "
                f"{right[what]} on the right"
            )
    if set(equation.left) == set(equation.right):
        raise EquationError(f"equation {text!r} has the same on both sides")
    return equation


def _terms(side: str) -> tuple[Term, ...]:
    terms = []
    for text in _PLUS.split(side):
        term = _TERM.fullmatch(text.strip())
        if term is None or term["count"].startswith("0"):
            raise EquationError(
                f"{text.strip()!r} is no part of an equation. Write whole numbers, formulas and "
                "phases, with blanks around +: 2 HCl(aq) + Zn(s)"
            )
        terms.append(Term(int(term["count"] or 1), parse(term["formula"]), term["phase"] or ""))
    return tuple(terms)


def _totals(terms: tuple[Term, ...]) -> Counter[str]:
    totals: Counter[str] = Counter()
    for term in terms:
        totals["charge"] += term.count * term.formula.charge
        for element, count in term.formula.atoms.items():
            totals[element] += term.count * count
    return totals
