"""The paper's call returns the paper's records."""

import json

import pytest

from labutopia_lerobot.chemistry.chem_db import PAPER_FIELDS, LookupQueryError, lookup
from labutopia_lerobot.chemistry.compound import substances
from labutopia_lerobot.chemistry.refusals import UnknownCompoundError

PRINTED = """\
  {
    "compound_name": "Aluminum oxide",
    "chemical_formula": "Al2O3",
    "molar_mass": "101.9612772 g/mol",
    "density": "3.9870 g/cm³",
    "melting_point": "2,072.00 °C",
    "boiling_point": "2,977.00 °C",
    "solubility": "insoluble",
    "sublimation_point": null,
    "appearance": "white solid"
  },
  {
    "compound_name": "Silicon dioxide",
    "chemical_formula": "SiO2",
    "molar_mass": "60.0843 g/mol",
    "density": "2.6480 g/cm³",
    "melting_point": "1,713.00 °C",
    "boiling_point": "2,950.00 °C",
    "solubility": null,
    "sublimation_point": null,
    "appearance": "Transparent or white"
  }"""
"""LabUtopia, appendix, "Example JSON entries from the structured chemical knowledge base"."""

NINE = (
    "compound_name chemical_formula molar_mass density melting_point boiling_point solubility "
    "sublimation_point appearance"
)


def test_the_two_records_that_the_paper_prints_come_out_character_by_character():
    records = lookup({"compounds": ["Aluminum oxide", "Silicon dioxide"]})
    assert json.dumps(records, indent=2, ensure_ascii=False) == f"[\n{PRINTED}\n]"


def test_the_papers_call_has_the_papers_fields_in_its_order():
    fields = NINE.split()
    assert list(PAPER_FIELDS) == fields
    acid, base = lookup({"compounds": ["Hydrochloric acid", "Sodium hydroxide"], "fields": fields})
    assert list(acid) == list(base) == fields
    assert (acid["chemical_formula"], base["chemical_formula"]) == ("HCl", "NaOH")


def test_fields_come_in_the_order_of_the_query():
    (record,) = lookup({"compounds": ["water"], "fields": ["density", "id", "compound_name"]})
    assert list(record.items()) == [
        ("density", "0.9970 g/cm³"),
        ("id", "water"),
        ("compound_name", "Water"),
    ]


def test_ids_names_formulas_and_numbers_give_the_same_record():
    records = lookup({"compounds": ["sodium_chloride", "table salt", "NaCl", "7647-14-5"]})
    assert all(record == records[0] for record in records)


def test_every_compound_has_a_record_of_texts():
    for record in lookup({"compounds": list(substances())}):
        assert all(value is None or (isinstance(value, str) and value) for value in record.values())
        assert "nan" not in str(record["density"]) + str(record["boiling_point"])


def test_a_gas_keeps_four_digits_and_zero_no_sign():
    argon, water = lookup({"compounds": ["argon", "water"]})
    assert argon["density"] == "0.001633 g/cm³"
    assert water["melting_point"] == "0.00 °C"


@pytest.mark.parametrize(
    "query",
    [
        {},
        {"fields": ["density"]},
        {"compounds": "water"},
        {"compounds": ["water"], "fields": "density"},
        {"compounds": [1]},
        {"compounds": ["water"], "sort": ["density"]},
        ["water"],
    ],
)
def test_a_query_of_another_form_is_refused_and_the_form_said(query):
    with pytest.raises(LookupQueryError, match="compounds"):
        lookup(query)


def test_an_unknown_field_is_refused_and_the_known_ones_are_listed():
    with pytest.raises(LookupQueryError, match=r"densty.*Did you mean 'density'\?.*appearance"):
        lookup({"compounds": ["water"], "fields": ["densty"]})


def test_one_unknown_compound_fails_the_whole_query():
    with pytest.raises(UnknownCompoundError, match="unobtainium"):
        lookup({"compounds": ["water", "unobtainium"]})
