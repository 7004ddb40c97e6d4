"""From what a person writes to the one compound that is meant.

Taken, in this order: an id, a CAS number, a formula, a name or synonym in any case, spacing,
hyphenation and spelling (sulphate, aluminium), then the same with slips. A slip is one letter too
many, missing, wrong, or swapped with its neighbour: one in each word of five letters or more, not
its first. Numerals and shorter words have none. A word that is a chemical's (`name_words`) is
never a slip, and a slip that could be mended in two ways is not mended: one compound never turns
into another.
"""

import difflib
import itertools
import re
import string
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache

from labutopia_lerobot.chemistry.compound import Compound, substances
from labutopia_lerobot.chemistry.formula import Formula, FormulaError, parse
from labutopia_lerobot.chemistry.name_words import KIN, is_chemical
from labutopia_lerobot.chemistry.refusals import AmbiguousCompoundError, UnknownCompoundError

type _Words = tuple[str, ...]

SHORTEST_WITH_SLIPS = 5
"""Letters of the shortest word in which a slip is mended; an estimate of ours."""

_LONGEST_TEXT = 200
_NUMERALS = ("i", "ii", "iii", "iv", "v", "vi", "vii", "viii")
_SPELLINGS = (("sulph", "sulf"), ("aluminium", "aluminum"), ("caesium", "cesium"))
_GREEK = {"α": "alpha", "β": "beta", "γ": "gamma"}  # noqa: RUF001 - as names have them
_CAS = re.compile(r"\d{2,7}-\d\d-\d")
_SIGN = re.compile(r"\(([+\-±./]+)\)")
_TURNS = {"+": "dextro", "-": "levo"}
_WORD = re.compile(r"[a-z]+|\d+")


@dataclass(frozen=True)
class _Index:
    """Ids of the compounds that each way of writing stands for, and how names are written."""

    names: Mapping[str, frozenset[str]]
    unnumbered: Mapping[str, frozenset[str]]
    cas: Mapping[str, str]
    formulas: Mapping[str, frozenset[str]]
    atoms: Mapping[frozenset[tuple[str, int]], frozenset[str]]
    words: frozenset[str]
    written: Mapping[str, str]


def resolve(text: str) -> Compound:
    """Return the compound that a text names.

    Args:
        text: An id, name, synonym, CAS number or formula; a molecular formula, in which every
            element stands once, stands for all compounds of these atoms.

    Raises:
        UnknownCompoundError: There is none; the message has near names.
        AmbiguousCompoundError: It could be several; the message lists them.
    """
    wanted = unicodedata.normalize("NFC", text).strip()
    if not wanted or len(wanted) > _LONGEST_TEXT:
        raise UnknownCompoundError(
            f"a compound's name has 1 to {_LONGEST_TEXT} letters, this one {len(wanted)}. "
            "Name one, for example 'sodium chloride'"
        )
    ids = _by_number(wanted) or _by_formula(wanted) or _by_name(wanted)
    if not ids:
        raise UnknownCompoundError(f"compound {wanted!r} is unknown.{_near(wanted)}")
    if len(ids) > 1:
        raise _ambiguous(wanted, ids)
    return substances()[next(iter(ids))]


def _ambiguous(wanted: str, ids: Iterable[str], why: str = "") -> AmbiguousCompoundError:
    named = sorted(f"{substances()[one].name} ({one})" for one in ids)
    return AmbiguousCompoundError(
        f"compound {wanted!r} could be several{why}: {', '.join(named)}. Write the name in full, "
        "or the id that stands in brackets"
    )


def _near(wanted: str) -> str:
    """Return a sentence with near names, or with where all are listed."""
    written = _index().written
    near = difflib.get_close_matches(_key(words(wanted)), written, n=4, cutoff=0.6)
    if near:
        return f" Near names: {', '.join(written[key] for key in near)}"
    return " docs/substances.md lists all compounds"


def _by_number(wanted: str) -> frozenset[str]:
    if wanted.lower() in substances():
        return frozenset({wanted.lower()})
    numbered = _CAS.fullmatch(wanted) and _index().cas.get(wanted)
    return frozenset({numbered} if numbered else ())


def _by_formula(wanted: str) -> frozenset[str]:
    try:
        formula = parse(wanted)
    except FormulaError:
        return frozenset()
    if formula.charge:
        raise UnknownCompoundError(
            f"{wanted!r} is an ion, no compound is made of it alone. Name a compound that has it"
        )
    same = _index().formulas.get(formula.text, frozenset())
    if same or not _molecular(formula):
        return same
    return _index().atoms.get(_composition(formula), same)


def _molecular(formula: Formula) -> bool:
    """Whether a formula says only which atoms there are: every element stands in it once."""
    elements = re.findall("[A-Z][a-z]?", formula.text)
    return len(elements) == len(set(elements)) and not set("()[]{}·") & set(formula.text)


def _composition(formula: Formula) -> frozenset[tuple[str, int]]:
    return frozenset(formula.atoms.items())


def _by_name(wanted: str) -> frozenset[str]:
    written = words(wanted)
    exact = _of_words(wanted, written)
    if exact:
        return exact
    choices = [_mended(word) for word in written]
    readings = list(itertools.islice(itertools.product(*choices), 65))
    if len(readings) > 64 or readings == [written]:
        return frozenset()
    ids = frozenset[str]().union(*(_of_words(wanted, reading) for reading in readings))
    if ids and len(readings) > 1:
        either = " or ".join(map(" ".join, readings))
        raise _ambiguous(wanted, ids, f", it is misspelt ({either})")
    return ids


def _of_words(wanted: str, written: _Words) -> frozenset[str]:
    """Return what has this name.

    Raises:
        AmbiguousCompoundError: It lacks the numeral: there may be others.
    """
    key = _key(written)
    exact = _index().names.get(key, frozenset())
    if not exact and key in _index().unnumbered:
        raise _ambiguous(wanted, _index().unnumbered[key], ", by the oxidation state")
    return exact


def _mended(word: str) -> list[str]:
    """Return what a word may be: itself, if it is a word or too short; else words one slip away."""
    known = _index().words
    if len(word) < SHORTEST_WITH_SLIPS or word in known or is_chemical(word):
        return [word]
    near = {
        other
        for other in one_slip_away(word)
        if other[:1] == word[0] and (other in known or other in KIN)
    }
    return sorted(near) or [word]


def one_slip_away(word: str) -> Iterator[str]:
    """Yield every text that one slip makes of a word."""
    for place in range(len(word) + 1):
        head, tail = word[:place], word[place:]
        yield from (head + letter + tail for letter in string.ascii_lowercase)
        if tail:
            yield head + tail[1:]
            yield from (head + letter + tail[1:] for letter in string.ascii_lowercase)
        if len(tail) > 1:
            yield head + tail[1] + tail[0] + tail[2:]


def words(name: str) -> _Words:
    """Return the words of a name in one spelling, numbers as words of their own."""
    plain = unicodedata.normalize("NFKC", name).casefold()
    for letter, latin in _GREEK.items():
        plain = plain.replace(letter, latin)
    for ours, other in ((numeral, f"({n}+)") for n, numeral in enumerate(_NUMERALS, 1)):
        plain = plain.replace(other, f"({ours})")
    plain = _SIGN.sub(lambda sign: f" {_TURNS.get(sign[1], 'racemic')} ", plain)
    for british, american in _SPELLINGS:
        plain = plain.replace(british, american)
    return tuple(_WORD.findall(plain.replace("'", "")))


def _key(written: _Words) -> str:
    """Return a name without its gaps; numerals stay apart, so that no letter can join them."""
    return "".join(f"<{word}>" if word in _NUMERALS else word for word in written)


def _names(one: Compound) -> Iterator[str]:
    yield one.name
    yield from (name for name in one.synonyms if not _is_formula(name))


def _is_formula(text: str) -> bool:
    try:
        parse(text)
    except FormulaError:
        return False
    return True


@cache
def _index() -> _Index:
    names: dict[str, set[str]] = defaultdict(set)
    unnumbered: dict[str, set[str]] = defaultdict(set)
    formulas: dict[str, set[str]] = defaultdict(set)
    atoms: dict[frozenset[tuple[str, int]], set[str]] = defaultdict(set)
    vocabulary: set[str] = set()
    shown: dict[str, str] = {}
    for one in substances().values():
        for name in _names(one):
            written = words(name)
            shown.setdefault(_key(written), name)
            vocabulary.update(written)
            names[_key(written)].add(one.id)
            bare = tuple(word for word in written if word not in _NUMERALS)
            if bare != written:
                unnumbered[_key(bare)].add(one.id)
        formulas[one.formula].add(one.id)
        for name in filter(_is_formula, one.synonyms):
            formulas[parse(name).text].add(one.id)
        atoms[_composition(one.composition)].add(one.id)
    cas = {one.cas: one.id for one in substances().values() if one.cas}
    vocabulary = {word for word in vocabulary if not word.isdigit()}
    return _Index(
        _frozen(names),
        _frozen(unnumbered),
        cas,
        _frozen(formulas),
        _frozen(atoms),
        frozenset(vocabulary),
        shown,
    )


def _frozen[Key](sets: Mapping[Key, set[str]]) -> dict[Key, frozenset[str]]:
    return {key: frozenset(ids) for key, ids in sets.items()}
