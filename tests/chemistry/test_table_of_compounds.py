"""What the table of compounds says is consistent in itself and with what others print."""

import csv
import math
from collections import Counter
from pathlib import Path

import chemicals
import numpy as np
import pytest
from chemicals.heat_capacity import CRC_standard_data
from pydantic import ValidationError

from labutopia_lerobot.chemistry.compound import Compound, CompoundTable, Dissociation, table
from labutopia_lerobot.chemistry.formula import parse

TABLE = table()
COMPOUNDS = TABLE.substances
BY_ID = {one.id: one for one in COMPOUNDS}
PRINTED = list(csv.DictReader((Path(__file__).parent / "printed_values.csv").open()))

CRC_OF_PAPER = {"aluminum_oxide", "silicon_dioxide"}
"""The paper prints other melting points of these two."""


def value_of(one: Compound, field: str) -> float | None:
    name, _, phase = field.partition(".")
    value = getattr(one, name)
    if phase:
        return value.get(phase)
    return value[0].pka if name == "acidity" else value


def test_there_are_at_least_250_compounds_of_both_kinds():
    organic = [one for one in COMPOUNDS if {"C", "H"} <= set(one.composition.atoms)]
    assert len(COMPOUNDS) >= 250
    assert len(organic) >= 100
    assert len(COMPOUNDS) - len(organic) >= 150


def test_every_cas_number_has_its_check_digit():
    for one in COMPOUNDS:
        if one.cas:
            *digits, check = (int(c) for c in one.cas if c.isdigit())
            assert sum(n * d for n, d in enumerate(reversed(digits), 1)) % 10 == check, one.id


def test_no_two_compounds_share_a_number():
    for field in ("cas", "pubchem_cid"):
        counts = Counter(getattr(one, field) for one in COMPOUNDS if getattr(one, field))
        assert not [number for number, count in counts.items() if count > 1]


def test_ions_have_the_atoms_of_their_compound():
    """But water: P4O10 and the like have no ions, hydrates count theirs."""
    for one in COMPOUNDS:
        if one.ions:
            atoms = Counter()
            for ion, count in one.ions.items():
                for element, n in parse(ion).atoms.items():
                    atoms[element] += n * count
            assert atoms == Counter(one.composition.atoms), one.id


def test_every_ion_is_described_once():
    steps = {form for one in COMPOUNDS for step in one.acidity for form in (step.acid, step.base)}
    formulas = {one.formula for one in COMPOUNDS}
    named = {ion for one in COMPOUNDS for ion in one.ions}
    assert named <= set(TABLE.ions) | steps | formulas
    assert all(parse(formula).text == formula for formula in TABLE.ions)
    assert len({ion.name for ion in TABLE.ions.values()}) == len(TABLE.ions)


def test_steps_of_one_acid_are_the_same_wherever_they_stand():
    constants = {}
    for one in COMPOUNDS:
        strengths = [step.pka for step in one.acidity]
        assert strengths == sorted(strengths), one.id
        for step in one.acidity:
            assert constants.setdefault((step.acid, step.base), step.pka) == step.pka


def test_molar_masses_agree_with_those_of_another_table():
    """To 3 parts in 10,000: theirs have the atomic weights of another year (Se, Ge, Mo, Zn)."""
    compared = 0
    for one in COMPOUNDS:
        try:
            theirs = chemicals.search_chemical(one.cas or "")
        except ValueError:
            continue
        if one.pubchem_cid == theirs.pubchemid:
            compared += 1
            assert one.molar_mass == pytest.approx(theirs.MW / 1000, rel=3e-4), one.id
    assert compared > 400


def test_values_that_name_the_package_are_the_packages():
    """Enthalpies of the CRC tables exactly as there, to the joule per mole."""
    compared = 0
    for one in COMPOUNDS:
        if one.cas not in CRC_standard_data.index:
            continue
        row = CRC_standard_data.loc[one.cas]
        for phase, key in (("solid", "Hfs"), ("liquid", "Hfl"), ("gas", "Hfg")):
            value = one.formation_enthalpy.get(phase)
            if (
                one.provenance.get(f"formation_enthalpy.{phase}") == "chemicals"
                and row[key] == row[key]
            ):
                compared += 1
                assert value == pytest.approx(row[key], abs=1), one.id
        key = {"solid": "Cps", "liquid": "Cpl", "gas": "Cpg"}.get(one.phase or "")
        if key and one.provenance.get("heat_capacity") == "chemicals":
            compared += 1
            assert one.heat_capacity == pytest.approx(row[key], abs=1e-6), one.id
    assert compared > 400


@pytest.mark.parametrize("row", PRINTED, ids=lambda row: f"{row['id']}-{row['field']}")
def test_a_value_is_what_a_second_source_prints(row):
    value = value_of(BY_ID[row["id"]], row["field"])
    assert value == pytest.approx(float(row["value"]), abs=float(row["tolerance"]))


def test_at_least_60_values_are_compared_with_a_second_source():
    assert len({(row["id"], row["field"]) for row in PRINTED}) == len(PRINTED) >= 60


def test_melting_comes_before_boiling_and_says_the_phase():
    for one in COMPOUNDS:
        melts, boils = one.melting_point, one.boiling_point
        assert melts is None or boils is None or melts < boils, one.id
        if boils is not None and boils < 298.15:
            assert one.phase == "gas", one.id
        if melts is not None and melts > 300 and one.phase is not None:
            assert one.phase == "solid", one.id


def test_densities_are_those_of_their_phase():
    """Ranges: hydrogen to sulfur hexafluoride, lithium to osmium (CRC Handbook)."""
    bounds = {"gas": (0.05, 7.0), "liquid": (500.0, 14e3), "solid": (500.0, 23e3)}
    for one in COMPOUNDS:
        if one.density is not None and one.phase is not None:
            low, high = bounds[one.phase]
            assert low < one.density < high, one.id


def test_elements_as_they_are_have_no_enthalpy_of_formation():
    for one in COMPOUNDS:
        alone = len(one.composition.atoms) == 1 and one.id != "ozone"
        if alone and one.phase is not None and one.phase in one.formation_enthalpy:
            assert one.formation_enthalpy[one.phase] == 0.0, one.id


def test_solubility_product_and_solubility_tell_the_same():
    """Salts of ions that hardly hydrolyse, to a factor of 2.6: activity is left out."""
    quiet = {"Cl^-", "Br^-", "SO4^2-", "F^-", "SCN^-", "ClO4^-"}
    compared = 0
    for one in COMPOUNDS:
        if one.log_ksp is None or not quiet & set(one.ions) or "H2O" in one.ions:
            continue
        if isinstance(one.solubility, float) and one.solubility > 0 and "Hg2^2+" not in one.ions:
            compared += 1
            powers = math.prod(count**count for count in one.ions.values())
            molar = (10**one.log_ksp / powers) ** (1 / sum(one.ions.values()))
            ratio = one.solubility / (molar * 1000 * one.molar_mass)
            assert 1 / 2.6 < ratio < 2.6, one.id
    assert compared >= 10


def test_a_coloured_ion_colours_the_solution_of_its_compounds():
    for one in COMPOUNDS:
        coloured = [ion for ion in one.ions if ion in TABLE.ions and TABLE.ions[ion].colour]
        if coloured and one.solubility not in (0.0, None) and one.log_ksp is None:
            assert one.solution_colour is not None, (one.id, coloured)


def test_every_compound_is_described_by_structure_or_ions():
    missing = [one.id for one in COMPOUNDS if not one.ions and one.smiles is None]
    simple = {"metal", "nonmetal", "acidic oxide", "basic oxide", "amphoteric oxide"}
    assert [one for one in missing if not simple & set(BY_ID[one].reactivity)] == [
        one for one in missing if one in UNSTRUCTURED
    ]


UNSTRUCTURED = {
    "ammonium_heptamolybdate_tetrahydrate",
    "calcium_carbide",
    "mercury_ii_chloride",
    "phosphorus_pentachloride",
    "sodium_borohydride",
    "sodium_peroxide",
    "starch",
    "sulfurous_acid",
}
"""What no SMILES of the package describes, and what does not fall into ions in water."""


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"density": -1.0}, "density"),
        ({"melting_point": float("nan")}, "melting_point"),
        ({"formula": "NaCl2^+"}, "write its formula"),
        ({"formula": "NaCl·"}, "formula"),
        ({"ions": {"Na^+": 2, "Cl^-": 1}}, "do not cancel"),
        ({"cas": "7647"}, "cas"),
        ({"colour": "white"}, "colour"),
        ({"ghs": ["dangerous"]}, "ghs"),
        ({"reactivity": ["evil"]}, "reactivity"),
        ({"taste": "salty"}, "taste"),
    ],
)
def test_a_wrong_entry_is_refused(change, complaint):
    salt = BY_ID["sodium_chloride"].model_dump()
    with pytest.raises(ValidationError, match=complaint):
        Compound.model_validate(salt | change)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"units": {}}, "units"),
        ({"sources": {}}, "sources"),
        ({"substances": [COMPOUNDS[0].model_dump()] * 2}, "several substances"),
        ({"substances": [COMPOUNDS[0].model_dump() | {"provenance": {}}]}, "without source"),
    ],
)
def test_a_wrong_table_is_refused(change, complaint):
    with pytest.raises(ValidationError, match=complaint):
        CompoundTable.model_validate(TABLE.model_dump() | change)


@pytest.mark.parametrize(
    ("acid", "base"), [("HCl", "Cl"), ("H2SO4", "SO4^2-"), ("NaOH", "OH^-"), ("Cl^-", "HCl")]
)
def test_a_step_that_is_not_the_loss_of_one_proton_is_refused(acid, base):
    with pytest.raises(ValidationError, match="one proton"):
        Dissociation(acid=acid, base=base, pka=1.0)


def test_pka_and_pkb_make_the_ion_product_of_water():
    (step,) = BY_ID["ammonia"].acidity
    assert step.pka + step.pkb == pytest.approx(14.0)
    assert np.isclose(step.pkb, 4.75)
