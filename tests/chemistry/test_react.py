"""What one asks of the engine, and what it says."""

import pytest

from labutopia_lerobot.chemistry.colour import word
from labutopia_lerobot.chemistry.engine import react
from labutopia_lerobot.chemistry.reaction import Conditions, Reactant
from labutopia_lerobot.chemistry.refusals import (
    HazardRefusedError,
    ImpossibleConditionsError,
    UnknownCompoundError,
)


def test_copper_sulfate_and_barium_chloride_give_a_white_solid_in_a_blue_solution() -> None:
    outcome = react(["copper(II) sulfate", "barium chloride"])
    (only,) = outcome.reactions
    assert only.reaction_type == "precipitation"
    assert only.expected_products[0].chemical_formula == "BaSO4"
    assert "a white precipitate of barium sulfate" in only.observable_changes
    assert "the solution stays blue" in only.observable_changes
    red, _, blue = outcome.amounts.colour
    assert blue > red
    assert outcome.amounts.turbid


def test_water_may_be_named_by_its_amount() -> None:
    outcome = react([Reactant("water", amount=1.0), Reactant("sodium chloride", 0.01, 0.0)])
    assert outcome.amounts.volume == pytest.approx(18.07e-6, rel=0.02)


def test_strong_acid_and_base_give_the_heat_of_neutralization() -> None:
    portions = [Reactant("hydrochloric acid", 0.1), Reactant("sodium hydroxide", 0.1)]
    outcome = react(portions)
    # 55.8 kJ/mol (CRC Handbook, from the formation enthalpies of water and hydroxide)
    assert outcome.amounts.heat == pytest.approx(5580.0, rel=0.01)
    assert outcome.amounts.temperature == pytest.approx(298.15 + 6.7, abs=0.2)
    assert outcome.amounts.ph == pytest.approx(7.0, abs=0.01)


def test_ammonium_nitrate_cools_water() -> None:
    outcome = react([Reactant("ammonium nitrate", 0.1, 0.0), Reactant("water", volume=1e-4)])
    assert outcome.amounts.temperature < 298.15 - 4.0
    assert outcome.reactions[0].reaction_type == "dissolution"


def test_the_scarcer_reactant_limits() -> None:
    outcome = react([Reactant("silver nitrate", 0.01), Reactant("sodium chloride", 0.003)])
    assert outcome.amounts.after["AgCl(s)"] == pytest.approx(0.003, rel=1e-3)
    assert outcome.amounts.extents["r1"] == pytest.approx(0.003, rel=1e-3)


def test_an_equimolar_buffer_has_the_pka_of_its_acid_as_ph() -> None:
    outcome = react(["acetic acid", "sodium acetate"])
    assert outcome.amounts.ph == pytest.approx(4.756, abs=0.01)


def test_diluting_an_acid_tenfold_raises_its_ph_by_one() -> None:
    acid = Reactant("hydrochloric acid", 0.01, 1e-4)
    strong = react([acid]).amounts.ph
    weak = react([acid, Reactant("water", volume=9e-4)]).amounts.ph
    assert strong is not None
    assert weak == pytest.approx(strong + 1.0, abs=1e-6)


def test_nothing_happens_where_ions_only_mix() -> None:
    assert react(["sodium chloride", "potassium nitrate"]).reactions == ()


def test_a_held_ph_decides_what_precipitates() -> None:
    sour = react(["magnesium chloride", "sodium hydroxide"], Conditions(ph=5.0))
    basic = react(["magnesium chloride", "sodium hydroxide"], Conditions(ph=12.0))
    assert "Mg(OH)2(s)" not in sour.amounts.after
    assert "Mg(OH)2(s)" in basic.amounts.after


def test_carbon_dioxide_stays_in_a_closed_vessel_up_to_one_bar() -> None:
    portions = ["sodium hydrogen carbonate", "hydrochloric acid"]
    closed = react(portions, Conditions(open_system=False)).amounts.after
    assert closed["CO2(aq)"] / 0.2 == pytest.approx(0.0339, rel=0.02)  # Henry, at 1 bar


@pytest.mark.parametrize(
    ("conditions", "named"),
    [
        (Conditions(temperature=200.0), "temperature 200"),
        (Conditions(temperature=5000.0), "temperature 5000"),
        (Conditions(concentration=0.0), "concentration 0"),
        (Conditions(ph=20.0), "ph 20"),
        (Conditions(solvent="ethanol"), "solvent 'ethanol'"),
    ],
)
def test_impossible_conditions_are_named(conditions: Conditions, named: str) -> None:
    with pytest.raises(ImpossibleConditionsError, match=named):
        react(["sodium chloride"], conditions)


def test_a_negative_amount_and_a_pure_portion_without_amount_are_refused() -> None:
    with pytest.raises(ImpossibleConditionsError, match="amount -1"):
        react([Reactant("sodium chloride", -1.0)])
    with pytest.raises(ImpossibleConditionsError, match="needs an amount"):
        react([Reactant("sodium chloride", volume=0.0)])
    with pytest.raises(ImpossibleConditionsError, match="nothing is poured in"):
        react([])


def test_an_unknown_compound_is_named() -> None:
    with pytest.raises(UnknownCompoundError, match="unobtainium"):
        react(["unobtainium"])


def test_dangerous_mixtures_are_refused_by_name() -> None:
    with pytest.raises(HazardRefusedError, match="chlorine"):
        react(["sodium hypochlorite", "hydrochloric acid"])
    with pytest.raises(HazardRefusedError, match="azide"):
        react(["silver nitrate", "sodium azide"])


@pytest.mark.parametrize(
    ("dye", "colours"),
    [
        ("thymol blue", {0.3: "pink", 5.0: "yellow", 11.0: "blue"}),
        ("bromocresol green", {3.0: "yellow", 7.0: "blue"}),
        ("bromothymol blue", {5.0: "yellow", 9.5: "blue"}),
        ("phenol red", {5.0: "yellow", 10.0: "purple"}),
        ("methylene blue", {7.0: "blue"}),
    ],
)
def test_twenty_micromoles_of_a_dye_in_a_litre_are_seen_in_its_colours(
    dye: str, colours: dict[float, str]
) -> None:
    for ph, name in colours.items():
        amounts = react([Reactant(dye, amount=2e-6)], Conditions(ph=ph)).amounts
        assert word(amounts.colour) == name, (dye, ph, amounts.colour)
