"""Formulas: from what a person writes to atoms, charge and molar mass."""

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from functools import lru_cache
from types import MappingProxyType

from labutopia_lerobot.chemistry.atomic_weights import ATOMIC_WEIGHTS
from labutopia_lerobot.chemistry.refusals import ChemistryError

_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-")
_SUPERSCRIPT = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]+$")
_DOTS = str.maketrans("·•∙⋅.*", "······")
_CHARGE = re.compile(r"\^\(?(?:(?P<size>\d*)(?P<sign>[+-])|(?P<first>[+-])(?P<last>\d+))\)?$")
_SIGNS = re.compile(r"(?P<signs>\++|-+)$")
_UNCLEAR = re.compile(r"^[A-Z][a-z]?\d+$|\d{2}$")
_TOKEN = re.compile(r"(?P<element>[A-Z][a-z]?)|(?P<open>[(\[{])|(?P<close>[)\]}])|(?P<count>\d+)")
_CLOSES = {")": "(", "]": "[", "}": "{"}
_MOST = 10_000
"""No formula of a molecule or a salt has a larger number in it: a polymer is not meant here."""


class FormulaError(ChemistryError):
    """A text is no formula; the message says where it goes wrong."""


@dataclass(frozen=True)
class Formula:
    """Atoms and charge of a species.

    Attributes:
        text: In the usual order, plain digits, ``·`` before water of crystallisation and ``^2+``
            for a charge, for example ``CuSO4·5H2O`` and ``[Fe(CN)6]^3-``.
        atoms: How many of each element.
        charge: In elementary charges.
    """

    text: str
    atoms: Mapping[str, int]
    charge: int = 0

    def __hash__(self) -> int:
        return hash(self.text)

    @property
    def relative_mass(self) -> Decimal:
        """Sum of the atomic weights, to every digit that they have; electrons weigh nothing."""
        return sum((ATOMIC_WEIGHTS[e] * n for e, n in self.atoms.items()), Decimal(0))

    @property
    def molar_mass(self) -> float:
        """Mass of a mole [kg/mol]."""
        return float(self.relative_mass / 1000)


@lru_cache(maxsize=4096)  # a few hundred species are asked for again and again
def parse(text: str) -> Formula:
    """Return the atoms and the charge of a formula.

    Brackets nest, ``·``, ``.`` and ``*`` join parts that may have a number before them (hydrates),
    subscripts and superscripts may be Unicode. A charge is ``^2-``, ``²⁻`` or signs at the end;
    where plain digits before a sign could belong to either (``Cu2+``, ``SO42-``) a ``^`` is needed.

    Raises:
        FormulaError: It is no formula, or its charge could mean two things.
    """
    plain = plain_text(text)
    body, charge = _split_charge(plain, text)
    if not body:
        raise FormulaError(f"formula {text!r} is empty. Write one, for example CuSO4·5H2O")
    atoms: Counter[str] = Counter()
    for part in body.split("·"):
        times, rest = _leading_number(part, text)
        for element, count in _atoms(rest, text).items():
            atoms[element] += times * count
    raised = f"^{abs(charge) if abs(charge) > 1 else ''}{'+' if charge > 0 else '-'}"
    return Formula(body + raised * (charge != 0), MappingProxyType(dict(atoms)), charge)


def plain_text(text: str) -> str:
    """Return a formula in plain digits, with one kind of dot and ``^`` before a charge."""
    stripped = "".join(text.split()).replace("−", "-")  # noqa: RUF001 - the sign, typeset
    raised = _SUPERSCRIPT.search(stripped)
    if raised:
        stripped = f"{stripped[: raised.start()]}^{raised.group().translate(_SUPERSCRIPTS)}"
    return stripped.translate(_SUBSCRIPTS).translate(_DOTS)


def _split_charge(plain: str, text: str) -> tuple[str, int]:
    """Return a formula without its charge, and the charge."""
    written = _CHARGE.search(plain)
    if written:
        size = int(written["size"] or written["last"] or 1)
        sign = written["sign"] or written["first"]
        return plain[: written.start()], size if sign == "+" else -size
    signs = _SIGNS.search(plain)
    if not signs:
        return plain, 0
    body, size = plain[: signs.start()], len(signs["signs"])
    if _UNCLEAR.search(body):
        raise FormulaError(
            f"the charge of {text!r} could mean two things. Write ^ before it: Cu^2+, SO4^2-, O2^-"
        )
    return body, size if signs["signs"][0] == "+" else -size


def _leading_number(part: str, text: str) -> tuple[int, str]:
    digits = re.match(r"\d*", part)
    number = digits.group() if digits else ""
    rest = part[len(number) :]
    if not rest:
        raise FormulaError(f"formula {text!r} has nothing on one side of a dot")
    return _count(number, text) if number else 1, rest


def _count(digits: str, text: str) -> int:
    if digits.startswith("0") or len(digits) > len(str(_MOST)) or int(digits) > _MOST:
        raise FormulaError(f"formula {text!r}: {digits} is no number from 1 to {_MOST:,}")
    return int(digits)


def _atoms(part: str, text: str) -> Counter[str]:
    """Return the atoms of a part without dots, by a stack of what the open brackets hold."""
    stack: list[tuple[str, Counter[str]]] = [("", Counter())]
    group: Counter[str] = Counter()  # what a number that comes next multiplies
    place = 0
    for token in _TOKEN.finditer(part):
        if token.start() != place:
            break
        place = token.end()
        match token.lastgroup:
            case "element":
                if token.group() not in ATOMIC_WEIGHTS:
                    raise FormulaError(f"formula {text!r}: there is no element {token.group()!r}")
                group = Counter({token.group(): 1})
                stack[-1][1].update(group)
            case "open":
                stack.append((token.group(), Counter()))
                group = Counter()
            case "close":
                bracket, inside = stack.pop()
                if bracket != _CLOSES[token.group()] or not inside:
                    raise FormulaError(f"formula {text!r}: {token.group()!r} closes nothing")
                group = inside
                stack[-1][1].update(group)
            case _:
                if not group:
                    raise FormulaError(f"formula {text!r}: {token.group()} counts nothing")
                for element, count in group.items():
                    stack[-1][1][element] += count * (_count(token.group(), text) - 1)
                group = Counter()
    if place != len(part):
        raise FormulaError(
            f"formula {text!r}: {part[place]!r} belongs in no formula. Write elements with a "
            "capital (CuSO4), counts behind them, charges as ^2+"
        )
    if len(stack) > 1:
        raise FormulaError(f"formula {text!r}: {stack[-1][0]!r} is not closed")
    return stack[0][1]
