"""A text is one compound, or an error that says why not; it is never another compound."""

import itertools

import numpy as np
import pytest

from labutopia_lerobot.chemistry.compound import Compound, substances
from labutopia_lerobot.chemistry.name_words import KIN, made_of_parts
from labutopia_lerobot.chemistry.names import SHORTEST_WITH_SLIPS, one_slip_away, resolve, words
from labutopia_lerobot.chemistry.refusals import AmbiguousCompoundError, UnknownCompoundError

TABLE = list(substances().values())
REFUSALS = (AmbiguousCompoundError, UnknownCompoundError)


def resolved(text: str) -> Compound | None:
    try:
        return resolve(text)
    except REFUSALS:
        return None


@pytest.mark.parametrize("one", TABLE, ids=lambda one: one.id)
def test_everything_that_names_a_compound_resolves_to_it(one):
    for text in (one.id, one.name, *one.synonyms, *([one.cas] if one.cas else [])):
        assert resolve(text) is one
        assert resolve(f"  {text} ") is one
    for text in (one.name.upper(), one.name.replace(" ", "-"), one.name.replace(" ", "  ")):
        assert resolve(text) is one


def test_a_formula_is_its_compound_or_lists_its_isomers():
    for one in TABLE:
        isomers = [other for other in TABLE if other.formula == one.formula]
        subscripts = one.formula.translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))
        for text in (one.formula, subscripts, one.formula.replace("·", ".")):
            if len(isomers) == 1:
                assert resolve(text) is one
            else:
                with pytest.raises(AmbiguousCompoundError) as error:
                    resolve(text)
                assert all(isomer.id in str(error.value) for isomer in isomers)


@pytest.mark.slow
def test_a_slip_never_turns_one_compound_into_another():
    """Two random slips in every word of every third compound's names."""
    rng = np.random.default_rng(11)
    tried = mended = 0
    for one in TABLE[::3]:
        for name in (one.name, *one.synonyms[:1]):
            written = list(words(name))
            for at, word in enumerate(written):
                slips = sorted(set(one_slip_away(word)) - {word, ""})
                for slip in rng.choice(slips, size=2):
                    text = " ".join([*written[:at], str(slip), *written[at + 1 :]])
                    other = resolved(text)
                    exact = other is not None and words(text) in {
                        words(known) for known in (other.name, other.id, *other.synonyms)
                    }
                    assert other in (None, one) or exact or resolves_as_formula(text), text
                    if len(word) >= SHORTEST_WITH_SLIPS + 1:
                        tried, mended = tried + 1, mended + (other is one)
    assert mended / tried > 0.7


def resolves_as_formula(text: str) -> bool:
    return text in {one.formula for one in TABLE}


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("sodum chlorde", "sodium_chloride"),
        ("Hydrocloric acid", "hydrochloric_acid"),
        ("potasium permangante", "potassium_permanganate"),
        ("etanol", "ethanol"),
        ("sulphuric  ACID", "sulfuric_acid"),
        ("aluminium oxide", "aluminum_oxide"),
        ("copper sulfate", "copper_ii_sulfate"),
        ("iron(3+) chloride", "iron_iii_chloride"),
        ("iron III chloride", "iron_iii_chloride"),
        ("SO4Cu", "copper_ii_sulfate"),
        ("CuSO4.5H2O", "copper_ii_sulfate_pentahydrate"),
        ("C2H4O2", "acetic_acid"),
    ],
)
def test_what_people_write_is_understood(text, meant):
    assert resolve(text).id == meant


@pytest.mark.parametrize(
    ("text", "candidates"),
    [
        ("C2H6O", ["ethanol", "dimethyl_ether"]),
        ("C3H8O", ["1_propanol", "2_propanol"]),
        ("C12H22O11", ["sucrose", "lactose"]),
        ("iron chloride", ["iron_ii_chloride", "iron_iii_chloride"]),
        ("mercury sulfate", ["mercury_i_sulfate"]),
        ("sodium sulfte", ["sodium_sulfite", "sodium_sulfate"]),
        ("sodium chlorte", ["sodium_chlorite", "sodium_chlorate"]),
        ("potassium nitrte", ["potassium_nitrite", "potassium_nitrate"]),
    ],
)
def test_what_could_be_several_is_not_guessed(text, candidates):
    with pytest.raises(AmbiguousCompoundError) as error:
        resolve(text)
    assert all(f"({candidate})" in str(error.value) for candidate in candidates)


@pytest.mark.parametrize(
    "text",
    [
        "barium sulfite",
        "calcium chlorite",
        "silver nitrite",
        "copper(I) sulfate",
        "butylamine",
        "iron(IV) chloride",
        "propanal",
        "2-pentanol",
        "potassium selenate",
        "zinc phosphide",
        "CH3OCH2CH3",
        "NaClO5",
        "COS",
        "HgCl",
        "6-propanol",
        "3-butanone",
        "D-lactic acid",
        "prenol",
        "menthane",
        "(-)-tartaric acid",
    ],
)
def test_a_real_or_possible_compound_that_is_not_here_is_unknown(text):
    with pytest.raises(UnknownCompoundError):
        resolve(text)


@pytest.mark.parametrize("text", ["", "   ", "x" * 201, "Cu^2+", "SO4²⁻", "💧", "\0", "12-34-5"])
def test_what_names_no_compound_is_refused(text):
    with pytest.raises(UnknownCompoundError):
        resolve(text)


def test_an_unknown_name_comes_back_with_near_names():
    with pytest.raises(UnknownCompoundError, match=r"'barium sulfite'.*Barium sulfate"):
        resolve("barium sulfite")


def test_no_two_compounds_share_a_name():
    owners = {}
    for one in TABLE:
        for name in {one.name, *one.synonyms}:
            assert owners.setdefault("".join(words(name)), one) is one, name


def test_every_pair_of_names_one_slip_apart_is_kept_apart():
    pairs = 0
    by_words = {words(name): one for one in TABLE for name in (one.name, *one.synonyms[:1])}
    for written, one in by_words.items():
        for at, word in enumerate(written):
            for slip in set(one_slip_away(word)):
                other = by_words.get((*written[:at], slip, *written[at + 1 :]), one)
                if other is not one:
                    pairs += 1
                    assert resolved(" ".join(written)) in (None, one)
    assert pairs >= 10


def test_random_text_gives_a_compound_or_a_refusal():
    rng = np.random.default_rng(3)
    letters = list("aeiou nsrtl()-,0123HNaClO·^+²₂é")
    for size in itertools.chain(range(1, 40), range(1, 40)):
        text = "".join(rng.choice(letters, size=size))
        assert resolved(text) is None or text.strip() in {
            name for one in TABLE for name in (one.formula, *one.synonyms)
        }


def test_words_of_chemistry_are_known_and_slips_are_none():
    assert all(made_of_parts(word) for word in ("methylamine", "dichlorobenzene", "phosphite"))
    assert not any(made_of_parts(word) for word in ("sodum", "chlorde", "sulfte", "hydrocloric"))
    assert {"sulfite", "sulfate", "propanal", "propanol", "chlorite"} <= KIN
