"""Liquids in which nothing is dissolved have a chemical state too."""

import math

import pytest

from adversary import begun, play
from labutopia_lerobot.predicates import concentration, ph_between
from labutopia_lerobot.substances.filling import Filling
from solution_bench import GIVER, TAKER, bench, liquid_of, pour, world


def test_water_is_neutral_whatever_its_temperature() -> None:
    """pKw is 14.17 at 20 degrees C, 13.26 at 50 (CRC Handbook, "Ion product of water")."""
    simulation = bench(Filling(50.0), Filling(50.0, celsius=50.0))
    cold, warm = (world(simulation).solution(vessel) for vessel in (GIVER, TAKER))
    assert cold is not None
    assert warm is not None
    assert cold.ph == pytest.approx(14.17 / 2, abs=0.02)
    assert warm.ph == pytest.approx(13.26 / 2, abs=0.03)
    assert warm.temperature == pytest.approx(323.15, abs=0.5)
    assert ph_between(GIVER, low=7.0, high=7.2).holds(world(simulation))


def test_a_mixture_has_the_molecules_of_its_parts_and_no_ph() -> None:
    """789 kg/m^3 of ethanol at 46.07 g/mol (CRC Handbook)."""
    simulation = bench(Filling(50.0, "ethanol"), Filling(50.0))
    alone = world(simulation).solution(GIVER)
    assert alone is not None
    assert alone.mixed == 1.0
    assert math.isnan(alone.ph)
    water = world(simulation).solution(TAKER)
    assert water is not None
    assert water.ph == pytest.approx(14.17 / 2, abs=0.02)
    ethanol = "C2H5OH(l)"
    assert alone.concentrations == {ethanol: pytest.approx(789.0 / 0.04607, rel=0.01)}
    pour(simulation, 0.5, 40)
    simulation.account = liquid_of(simulation).take_account()
    mixture = world(simulation).solution(TAKER)
    assert mixture is not None
    share = 1.0 - 50e-6 / mixture.volume
    assert 0.2 < share < 0.4
    molar = 1e-3 * share * 789.0 / 0.04607
    assert concentration(TAKER, species=ethanol, low=0.98 * molar, high=1.02 * molar).holds(
        world(simulation)
    ) == (mixture.mixed >= 0.95)
    assert mixture.mixed < 1.0


@pytest.mark.parametrize(
    "task", ["level2/heat_beaker", pytest.param("level4/liquid_fusion", marks=pytest.mark.slow)]
)
def test_the_tasks_of_the_paper_that_heat_and_mix_say_in_the_end_what_is_in_their_vessels(
    task: str,
) -> None:
    env = begun(task, particles=200)
    *_, first = env.step(env.workcell.filter.applied.copy())
    assert "solutions" not in first
    info = play(env)
    held = {vessel.name: filling.ml for vessel, filling in env.workcell.task.contents.items()}
    said = {name: numbers for name, numbers in info["solutions"].items() if numbers["ml"]}
    assert sum(numbers["ml"] for numbers in said.values()) == pytest.approx(
        sum(held.values()), rel=0.05
    )
    if task == "level2/heat_beaker":
        (water,) = said.values()
        wall = env.workcell.world.reading("beaker_temperature").value
        assert water["celsius"] == pytest.approx(wall, abs=0.1)
        assert water["ph"] == pytest.approx(14.17 / 2, abs=0.02)
    else:
        contents = env.workcell.task.contents
        watery = {vessel.name for vessel, filling in contents.items() if filling.of == "water"}
        assert {name for name, n in said.items() if not math.isnan(n["ph"])} <= watery
