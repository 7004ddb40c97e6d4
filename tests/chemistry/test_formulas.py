"""Formulas are read as chemists write them, and nothing else is."""

from decimal import Decimal

import numpy as np
import pytest

from labutopia_lerobot.chemistry.atomic_weights import ATOMIC_WEIGHTS
from labutopia_lerobot.chemistry.formula import FormulaError, parse


@pytest.mark.parametrize(
    ("text", "atoms", "charge"),
    [
        ("H2O", {"H": 2, "O": 1}, 0),
        ("CuSO4·5H2O", {"Cu": 1, "S": 1, "O": 9, "H": 10}, 0),
        ("K4[Fe(CN)6]", {"K": 4, "Fe": 1, "C": 6, "N": 6}, 0),
        ("KAl(SO4)2·12H2O", {"K": 1, "Al": 1, "S": 2, "O": 20, "H": 24}, 0),
        ("[Fe(CN)6]^3-", {"Fe": 1, "C": 6, "N": 6}, -3),
        ("Hg2^2+", {"Hg": 2}, 2),
        ("NH4+", {"N": 1, "H": 4}, 1),
        ("SO4--", {"S": 1, "O": 4}, -2),
        ("Co", {"Co": 1}, 0),
        ("CO", {"C": 1, "O": 1}, 0),
    ],
)
def test_atoms_and_charge_are_counted(text, atoms, charge):
    formula = parse(text)
    assert dict(formula.atoms) == atoms
    assert formula.charge == charge


@pytest.mark.parametrize("text", ["CuSO₄·5H₂O", "CuSO4.5H2O", "CuSO4*5H2O", " Cu SO4 • 5 H2O"])
def test_every_way_of_writing_a_hydrate_is_one(text):
    assert parse(text).text == "CuSO4·5H2O"


@pytest.mark.parametrize("text", ["SO₄²⁻", "SO4^2-", "SO4^-2", "SO4^(2-)", "SO4²⁻", "SO4--"])
def test_every_way_of_writing_a_charge_is_one(text):
    assert parse(text).text == "SO4^2-"


@pytest.mark.parametrize("text", ["Cu2+", "SO42-", "O2-", "Fe3+"])
def test_a_digit_that_may_be_count_or_charge_is_refused(text):
    with pytest.raises(FormulaError, match=r"could mean two things.*\^"):
        parse(text)


@pytest.mark.parametrize(
    "text",
    [
        "",
        " ",
        "2",
        "·",
        "CuSO4·",
        "Xx2",
        "nacl",
        "(",
        "Cu)",
        "(SO4",
        "(SO4]",
        "()2",
        "H0",
        "H01",
        "Na Cl!",
        "H2O^",
        "^2+",
        "H99999",
        "Cé",
        "1.5",
        "H2O·2",
    ],
)
def test_what_is_no_formula_is_refused(text):
    with pytest.raises(FormulaError):
        parse(text)


def test_a_written_formula_is_read_back_with_the_same_atoms():
    """500 random formulas with brackets, water and charges."""
    rng = np.random.default_rng(5)
    elements = list(ATOMIC_WEIGHTS)
    for _ in range(500):
        chosen = rng.choice(elements, size=3, replace=False)
        a, b, c, times, water, charge = (int(n) for n in rng.integers(2, 12, size=6))
        formula = parse(f"{chosen[0]}{a}({chosen[1]}{b}{chosen[2]}{c}){times}·{water}H2O^{charge}-")
        counts = dict(zip(chosen, (a, b * times, c * times), strict=True))
        counts["H"] = counts.get("H", 0) + 2 * water
        counts["O"] = counts.get("O", 0) + water
        assert dict(formula.atoms) == counts
        assert formula.charge == -charge
        assert parse(formula.text) == formula


def test_molar_masses_are_sums_of_the_printed_weights():
    assert parse("Al2O3").relative_mass == Decimal("101.9612772")
    assert parse("SiO2").relative_mass == Decimal("60.0843")
    assert parse("H2O").molar_mass == 0.01801528
