"""What a vessel holds is the table's liquids; recorded episodes keep their numbers."""

from dataclasses import replace

import pytest

from labutopia_lerobot.chemistry.compound import substances
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import (
    DYES,
    ETHANOL,
    ETHYLENE_GLYCOL,
    GLYCEROL,
    SUBSTANCES,
    WATER,
    Substance,
    UnknownSubstanceError,
    substance,
)

AS_RECORDED = [
    Substance("water", 997.0, 0.890e-3, 0.0720, (0.20, 0.48, 0.85, 0.55), 4182.0, 373.15),
    Substance("ethanol", 785.0, 1.074e-3, 0.0220, (0.55, 0.82, 0.62, 0.45), 2438.0, 351.4),
    Substance("ethylene glycol", 1110.0, 16.1e-3, 0.0480, (0.86, 0.35, 0.62, 0.55), 2394.0, 470.5),
    Substance("glycerol", 1258.0, 0.934, 0.0625, (0.93, 0.72, 0.30, 0.65), 2377.0, 563.0),
]
"""The liquids of the tasks, as they were before there was a table of compounds."""


def test_the_liquids_of_recorded_episodes_have_not_changed_by_one_bit():
    liquids = [WATER, ETHANOL, ETHYLENE_GLYCOL, GLYCEROL]
    unfrozen = [replace(liquid, melting_point=0.0) for liquid in liquids]  # moves nothing
    assert unfrozen == AS_RECORDED
    assert [substance(one.name) for one in AS_RECORDED] == liquids
    assert list(DYES) == [one.name for one in AS_RECORDED]


def test_every_number_of_a_liquid_is_the_tables():
    compounds = {one.name.lower(): one for one in substances().values()}
    assert len(SUBSTANCES) >= 40
    for name, liquid in SUBSTANCES.items():
        compound = compounds[name]
        flow = (compound.density, compound.viscosity, compound.surface_tension)
        assert (liquid.density, liquid.viscosity, liquid.surface_tension) == flow
        assert liquid.boiling_point == compound.boiling_point
        assert liquid.melting_point == (compound.melting_point or 0.0)
        per_mass = compound.heat_capacity / compound.molar_mass
        assert liquid.specific_heat == pytest.approx(per_mass, abs=0.5)


@pytest.mark.parametrize("text", ["acetone", "Acetone", "67-64-1", "CH3COCH3", "propanone"])
def test_a_vessel_is_filled_by_any_name_of_a_liquid(text):
    assert Filling(10, text).substance is SUBSTANCES["acetone"]


def test_only_liquids_of_a_colour_of_their_own_have_another_than_clear():
    assert SUBSTANCES["bromine"].rgba[:3] != SUBSTANCES["acetone"].rgba[:3]
    assert SUBSTANCES["acetone"].rgba == SUBSTANCES["toluene"].rgba


@pytest.mark.parametrize(
    ("name", "complaint"),
    [
        ("unobtainium", r"unobtainium.*Choose from: water, .*glycerol"),
        ("sodium chloride", r"cannot be poured: Sodium chloride is no liquid"),
        ("argon", r"cannot be poured"),
        ("C3H8O", r"1-Propanol.*2-Propanol"),
    ],
)
def test_what_cannot_be_poured_is_refused_and_the_choices_are_listed(name, complaint):
    with pytest.raises(UnknownSubstanceError, match=complaint):
        substance(name)
