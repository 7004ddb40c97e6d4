"""`labutopia-chem`: what a user types, what it answers."""

import json

import pytest

from labutopia_lerobot.chemistry.chem_db import PAPER_FIELDS
from labutopia_lerobot.chemistry.refusals import ChemistryError
from labutopia_lerobot.cli import quantities
from labutopia_lerobot.cli.chem import main
from loopback_model import LoopbackModel, sends
from typed_commands import typed

ACID_AND_BASE = ("hydrochloric acid", "sodium hydroxide")


@pytest.fixture
def chem(monkeypatch, capsys, tmp_path):
    """Type a command; returns its exit status, output and errors."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    for name in ("LABUTOPIA_MODEL", "LABUTOPIA_MODEL_URL", "LABUTOPIA_MODEL_KEY"):
        monkeypatch.delenv(name, raising=False)
    return typed("labutopia-chem", main, monkeypatch, capsys)


def test_the_summary_says_equation_products_what_one_sees_ph_and_temperature(chem):
    status, out, _ = chem(*ACID_AND_BASE, "--concentration", "0.1M")
    assert status == 0
    assert "neutralization: " in out
    assert " -> " in out
    assert "Water (H2O" in out
    assert "One sees: " in out
    assert "pH 7.0" in out
    assert "200 ml of liquid" in out
    assert "It holds: Cl^- 10 mmol, Na^+ 10 mmol\n" in out


def test_json_is_the_papers_form_and_amounts_come_only_when_asked(chem):
    _, out, _ = chem(*ACID_AND_BASE, "--json")
    alone = json.loads(out)
    assert list(alone) == ["reactions"]
    _, out, _ = chem(*ACID_AND_BASE, "json=true", "amounts=true")
    both = json.loads(out)
    assert both["reactions"] == alone["reactions"]
    assert list(both) == ["reactions", "amounts"]
    assert both["amounts"]["before_mol"]["Na^+(aq)"] == pytest.approx(0.01)


def test_options_are_written_as_in_every_program(chem):
    words = ("temperature=40 C", "volume=10ml", "open_system=false")
    flags = ("--temperature", "40 C", "--volume", "10ml", "--open-system", "false")
    assert chem(*ACID_AND_BASE, *words) == chem(*ACID_AND_BASE, *flags)


def test_each_portion_can_have_its_own_quantity(chem):
    _, out, _ = chem("hydrochloric acid: 0.2M 50ml", "zinc: 0.65382 g", "--json", "--amounts")
    before = json.loads(out)["amounts"]["before_mol"]
    assert before["H^+(aq)"] == pytest.approx(0.01)
    assert before["Zn(s)"] == pytest.approx(0.01, rel=1e-3)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["sodium chlorid acidd"], "is unknown"),
        (["nitroglycerin"], "Nitroglycerin"),
        (["H2O", "temperature=-300C"], "below absolute zero"),
        (["H2O", "temperature=9999K"], "temperature"),
        (["H2O", "temperature=25"], "write a number with its unit"),
        (["H2O", "concentration=nanM"], "concentration=nanM"),
        (["HCl", "concentration=1e9M"], "concentration"),
        (["H2O", "volume=-1ml"], "less than nothing"),
        (["HCl: 1M 1mol"], "says twice"),
        (["HCl: 1M 2M"], "two of its kind"),
        (["HCl: plenty"], "is no quantity"),
        (["H2O", "open_system=maybe"], "neither true nor false"),
        (["H2O", "ph=acid"], "ph=acid is no number"),
        (["H2O", "ph=99"], "ph"),
        (["H2O", "reasoner=magic"], "rules, llm"),
        (["H2O", "reasoner=llm"], "Name the model"),
        (
            [
                "H2O",
                "reasoner=llm",
                "model=m",
                "cached_only=false",
                "timeout=0",
                "base_url=http://127.0.0.1:9/v1",
            ],
            "timeout=0",
        ),
        (["show", "nothing such"], "is unknown"),
    ],
)
def test_what_cannot_be_is_one_line_and_status_2(chem, words, why):
    status, out, err = chem(*words)
    assert status == 2
    assert out == ""
    assert why in " ".join(err.split())
    assert "Traceback" not in err


def test_a_model_that_fails_leaves_the_rules_answer_and_a_note_without_codes(chem, monkeypatch):
    monkeypatch.setattr("huggingface_hub.constants.HF_HUB_OFFLINE", False)
    _, by_rules, _ = chem(*ACID_AND_BASE)
    with LoopbackModel(sends(500, b"broken \x1b[31mred")) as server:
        words = ("reasoner=llm", "model=m", f"base_url={server.address}")
        status, out, _ = chem(*ACID_AND_BASE, *words)
        assert len(server.requests) == 1
        _, form, err = chem(*ACID_AND_BASE, *words, "--json")
    assert status == 0
    assert out.startswith(by_rules)
    assert "Note: By the rules, as m failed: " in out
    assert "500: broken" in out
    assert "\x1b" not in out + err
    assert list(json.loads(form)) == ["reactions"]
    assert "Note: " in err


def test_list_and_show_are_about_compounds(chem):
    _, out, _ = chem("list", "azide")
    assert out.startswith("Sodium azide, NaN3\n1 of ")
    _, out, _ = chem("list", "azide", "--json")
    assert list(json.loads(out)[0]) == list(PAPER_FIELDS)
    _, out, _ = chem("show", "Al2O3")
    assert "3.9870 g/cm³" in out
    _, out, _ = chem("show", "Al2O3", "--json")
    assert json.loads(out)["molar_mass"] == "101.9612772 g/mol"


@pytest.mark.parametrize(
    ("read", "text", "si"),
    [
        (quantities.volume, "50ml", 5e-5),
        (quantities.volume, "50 mL", 5e-5),
        (quantities.volume, "10 µL", 1e-8),
        (quantities.volume, "2 cm³", 2e-6),
        (quantities.concentration, "0.1M", 100.0),
        (quantities.concentration, "5 mM", 5.0),
        (quantities.concentration, "1 mol/L", 1000.0),
        (quantities.temperature, "25C", 298.15),
        (quantities.temperature, "298 K", 298.0),
        (quantities.temperature, "-5 °C", 268.15),
    ],
)
def test_quantities_are_read_in_their_units(read, text, si):
    assert read(text) == pytest.approx(si)


@pytest.mark.parametrize("text", ["", "M", "1", "1 m", "one ml", "inf ml", "1e999 ml", "1 ml ml"])
def test_a_text_that_is_no_volume_is_refused(text):
    with pytest.raises(ChemistryError):
        quantities.volume(text)
