"""A language model's kept answers decide which solids, gases and redox products form."""

import json
from pathlib import Path

import pytest

from labutopia_lerobot.chemistry import kept_answers
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.kept_answers import (
    KeptAnswer,
    KeptAnswers,
    KeptAnswersError,
    load_answers,
    questions,
    read,
    reasoner_label,
    write,
)
from labutopia_lerobot.chemistry.reaction import Phase, Product, Reaction
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import Solution
from solution_bench import ACID, BARIUM, BASE, COPPER, GIVER, SODA, TAKER, bench, bring, world

IODIDE = Filling(50.0, dissolved=(Solute("potassium iodide", 0.2),))
SULFATE = "CuSO4(aq) + BaCl2(aq) -> BaSO4(s) + CuCl2(aq)"


def said(stoichiometry: str, formula: str, name: str, phase: Phase = "solid") -> Reaction:
    """Return a reaction as a model infers it."""
    product = Product(name, formula, phase, "high")
    return Reaction("r1", "a kind", stoichiometry, (product,), ("one sees it",), 0.9, "It is so.")


def of(giver: Filling, taker: Filling, *reactions: Reaction, failed: str = "") -> KeptAnswers:
    """Return what a model has said of two fillings."""
    both = tuple(sorted({*giver.compounds, *taker.compounds}))
    return KeptAnswers("stand-in", (KeptAnswer(both, reactions, failed),))


def together(
    giver: Filling, taker: Filling, answers: KeptAnswers | None
) -> tuple[Solution, tuple[str, ...]]:
    """Return what two fillings become in one vessel, and what is said of it."""
    simulation = bench(giver, taker, answers=answers)
    bring(simulation, GIVER.name, TAKER.name, giver.ml)
    assert simulation.liquid is not None
    assert simulation.liquid.solutions is not None
    return world(simulation).solution(TAKER), simulation.liquid.solutions.unreacted


def test_what_a_model_names_forms_as_by_the_rules():
    answers = of(BARIUM, COPPER, said(SULFATE, "BaSO4", "Barium sulfate"))
    by_model, notes = together(BARIUM, COPPER, answers)
    by_rules, _ = together(BARIUM, COPPER, None)
    assert by_model.solids == {"BaSO4(s)": pytest.approx(by_rules.solids["BaSO4(s)"])}
    assert notes == ()


def test_what_it_leaves_out_stays_dissolved():
    solution, notes = together(BARIUM, COPPER, of(BARIUM, COPPER))
    assert solution.solids == {}
    barium = sum(m for key, m in solution.concentrations.items() if "Ba" in key)
    assert barium == pytest.approx(1e3 * 0.1 * 40 / 100, rel=1e-3)
    assert notes == ()


def test_gas_leaves_only_where_it_says_so():
    named = said("Na2CO3 + 2 HCl -> 2 NaCl + CO2(g) + H2O", "CO2", "Carbon dioxide", "gas")
    with_gas, _ = together(ACID, SODA, of(ACID, SODA, named))
    by_rules, _ = together(ACID, SODA, None)
    assert with_gas.gas == pytest.approx(by_rules.gas)
    assert together(ACID, SODA, of(ACID, SODA))[0].gas == {}


def test_electrons_go_only_where_it_says_so():
    named = said(
        "2 CuSO4 + 4 KI -> 2 CuI(s) + I2(aq) + 2 K2SO4", "CuI", "Copper(I) iodide", "solid"
    )
    by_model, by_rules, left = (
        together(IODIDE, COPPER, answers)[0].concentrations
        for answers in (of(IODIDE, COPPER, named), None, of(IODIDE, COPPER))
    )
    assert by_rules["I2(aq)"] > 1.0
    assert by_model["I2(aq)"] > 1.0
    assert not {"Cu^+(aq)", "I2(aq)"} & left.keys()


def test_acids_and_bases_react_whatever_it_says():
    solution, _ = together(ACID, BASE, of(ACID, BASE))
    assert solution.ph == pytest.approx(7.0, abs=0.2)


def test_a_product_that_the_rules_do_not_know_does_not_form_and_is_named_once():
    lie = said("CuSO4 + BaCl2 -> BaCuSO4Cl2(s)", "BaCuSO4Cl2", "Nonsensium")
    solution, notes = together(BARIUM, COPPER, of(BARIUM, COPPER, lie))
    assert solution.solids == {}
    assert notes == ("stand-in has BaCuSO4Cl2 form, of which the rules know nothing",)


@pytest.mark.parametrize("why", ["it was slow", "it was not asked"])
def test_where_it_has_no_good_answer_the_rules_count_and_it_is_said(why):
    answers = of(BARIUM, COPPER, failed=why)
    if why == "it was not asked":
        answers = KeptAnswers("stand-in")
    solution, notes = together(BARIUM, COPPER, answers)
    assert solution.solids["BaSO4(s)"] == pytest.approx(4e-3, rel=1e-3)
    pair = "Barium chloride and Copper(II) sulfate"
    assert notes == (f"By the rules, as stand-in failed on {pair}: {why}",)


def test_vessels_meet_two_at_a_time_and_one_compound_is_no_question():
    held = [("salt",), ("acid", "dye"), (), ("salt",)]
    assert questions(held) == [("acid", "dye"), ("acid", "dye", "salt")]


def test_a_file_comes_back_as_it_was_and_is_called_by_its_model_and_hash(tmp_path: Path):
    answers = of(BARIUM, COPPER, said(SULFATE, "BaSO4", "Barium sulfate"))
    one, other = tmp_path / "one.json", tmp_path / "other.json"
    write(answers, one)
    write(KeptAnswers("stand-in"), other)
    assert read(one) == answers
    assert load_answers(str(one)) == answers == load_answers(reasoner_label(str(one)))
    assert reasoner_label(str(one)).startswith("stand-in@")
    assert reasoner_label(str(one)) != reasoner_label(str(other))
    assert reasoner_label("rules") == "rules"
    assert load_answers("rules") is None


def test_a_label_of_a_file_that_was_not_read_says_so(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(kept_answers, "_read", {})
    with pytest.raises(KeptAnswersError, match=r"--reasoner FILE\.json"):
        load_answers("stand-in@01234567")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("not JSON", "it is no JSON"),
        ('{"answers": []}', "'model' is missing"),
        ('{"model": "m", "answers": [{"compounds": ["nonsense", "HCl"]}]}', "nonsense"),
        (
            json.dumps(
                {
                    "model": "m",
                    "answers": [
                        {
                            "compounds": ["HCl", "NaOH"],
                            "reactions": [
                                {
                                    "reaction_id": "r1",
                                    "reaction_type": "fusion",
                                    "stoichiometry": "HCl -> Au",
                                    "expected_products": [],
                                    "observable_changes": [],
                                    "confidence_score": 1.0,
                                    "rationale": "",
                                }
                            ],
                        }
                    ],
                }
            ),
            "does not balance",
        ),
    ],
)
def test_what_holds_no_answers_is_refused(tmp_path: Path, text: str, why: str):
    file = tmp_path / "answers.json"
    file.write_text(text)
    with pytest.raises(KeptAnswersError, match=r"answers\.json holds no answers") as raised:
        load_answers(str(file))
    assert why in str(raised.value)
