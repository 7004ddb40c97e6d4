"""Solutions that cannot be are refused before anything is compiled, with a cure."""

import pytest

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.burette_stand import BuretteStand
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.substances.filling import Filling, ImpossibleFillingError, require_fillable
from labutopia_lerobot.substances.possible_solutions import require_possible_solutions
from solution_bench import ACID, BASE, GIVER, SODA, TAKER

CHEMICAL = [
    task_id
    for task_id in task_files()
    if any(held.reacts for held in canonical_task(Setting(task_id)).contents.values())
]


def solution(compound: str, molar: float) -> Filling:
    return Filling(50.0, dissolved=(Solute(compound, molar),))


@pytest.mark.parametrize(
    ("giver", "taker", "said"),
    [
        (solution("barium hydroxide", 3.0), BASE, "giver: 3 mol/l of barium hydroxide do not diss"),
        (solution("silver chloride", 0.1), BASE, "giver: 0.1 mol/l of silver chloride do not"),
        (solution("copper", 0.1), BASE, "giver: .* no solution"),
        (solution("unobtainium", 0.1), BASE, "giver: .*unobtainium"),
        (solution("sodium chloride", 0.0), BASE, "giver: 0 mol/l .* choose more than 0"),
        (Filling(50.0, of="ethanol"), BASE, "giver cannot hold ethanol: .*only solvent"),
        (ACID, solution("sodium hypochlorite", 0.1), "giver and taker: .*chlorine"),
        (solution("sodium cyanide", 0.1), ACID, "giver and taker: .*hydrogen cyanide"),
        (
            solution("sodium hydroxide", 15.0),
            solution("sulfuric acid", 15.0),
            "giver and taker would boil over",
        ),
    ],
)
def test_the_error_names_task_vessel_and_cure(giver: Filling, taker: Filling, said: str) -> None:
    with pytest.raises(ImpossibleFillingError, match=said) as raised:
        require_possible_solutions("level2/mine", {GIVER: giver, TAKER: taker})
    message = str(raised.value)
    assert message.startswith("level2/mine")
    assert any(cure in message for cure in ("Dissolve less", "Take one of them", "Fill it with"))


def test_what_is_dangerous_only_when_three_vessels_meet_is_refused() -> None:
    contents = {
        GIVER: solution("acetone", 1.0),
        TAKER: solution("hydrogen peroxide", 3.0),
        glassware("beaker", "250 ml", "third"): solution("sulfuric acid", 1.0),
    }
    with pytest.raises(ImpossibleFillingError, match=r"all of its vessels .*peroxides of acetone"):
        require_possible_solutions("level2/mine", contents)


def test_a_solution_that_falls_out_as_cold_as_it_is_is_refused() -> None:
    """Of potassium nitrate 2.2 mol/l dissolve at 10 degrees C, 3.1 at 20 (CRC Handbook)."""
    nitre = (Solute("potassium nitrate", 3.0),)
    require_possible_solutions("level2/mine", {GIVER: Filling(50.0, dissolved=nitre)})
    cold = {GIVER: Filling(50.0, celsius=8.0, dissolved=nitre)}
    with pytest.raises(ImpossibleFillingError, match=r"giver does not stay dissolved at 8 degrees"):
        require_possible_solutions("level2/mine", cold)


def test_a_part_of_one_vessel_that_boils_over_with_another_is_refused() -> None:
    """All of both do not: 600 ml of base take up what 20 ml of acid give off."""
    acid = Filling(20.0, dissolved=(Solute("hydrochloric acid", 13.0),))
    base = Filling(600.0, dissolved=(Solute("sodium hydroxide", 13.0),))
    with pytest.raises(ImpossibleFillingError, match="giver and taker would boil over"):
        require_possible_solutions("level2/mine", {GIVER: acid, TAKER: base})


@pytest.mark.parametrize("salt", ["copper(II) sulfate pentahydrate", "nickel(II) chloride"])
def test_crystals_in_plain_water_are_let_through(salt: str) -> None:
    """They make the water acid enough that no more than a trace of hydroxide falls out."""
    heap = Filling(60.0, crystals=(Crystals(salt, 2.0),))
    require_possible_solutions("level2/mine", {GIVER: heap})


def test_crystals_are_refused_where_none_can_lie_and_where_they_are_not_covered() -> None:
    salt = Filling(20.0, crystals=(Crystals("sodium chloride", 5.0),))
    burette = BuretteStand("stand").burette
    with pytest.raises(ImpossibleFillingError, match=f"{burette.name} cannot hold crystals.*flask"):
        require_possible_solutions("level2/mine", {burette: salt})
    much = Filling(60.0, crystals=(Crystals("sodium chloride", 500.0),))
    with pytest.raises(ImpossibleFillingError, match=r"giver make a heap of 384 ml.*60 ml"):
        require_possible_solutions("level2/mine", {GIVER: much})


@pytest.mark.parametrize(("of", "celsius"), [("water", -5.0), ("ethanol", -130.0)])
def test_what_is_frozen_is_no_filling(of: str, celsius: float) -> None:
    frozen = {GIVER: Filling(50.0, of, celsius=celsius)}
    with pytest.raises(ImpossibleFillingError, match="liquid from"):
        require_fillable(frozen, [GIVER])


def test_what_can_be_is_let_through() -> None:
    require_possible_solutions("level2/mine", {GIVER: ACID, TAKER: BASE})
    require_possible_solutions("level2/mine", {GIVER: ACID, TAKER: SODA})
    require_possible_solutions("level2/mine", {GIVER: Filling(50.0), TAKER: BASE})
    require_possible_solutions("level2/mine", {GIVER: Filling(50.0, of="ethanol")})


@pytest.mark.parametrize("split", ["id", "ood"])
@pytest.mark.parametrize("task_id", CHEMICAL)
def test_what_any_episode_of_a_task_may_hold_can_be(task_id: str, split: str) -> None:
    """So that no value of an axis, such as one held back for tests, is refused when it is drawn."""
    setting = Setting(task_id, split=split)
    for seed in range(16):
        require_possible_solutions(task_id, draw_scenario(setting, seed).task.contents)
