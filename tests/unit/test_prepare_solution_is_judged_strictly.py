"""Adversarial cases of `level4/prepare_solution`: the concentration counts, and how much of it."""

import re
from typing import Any

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring, liquid_of, put, swirl

TASK = "level4/prepare_solution"
STOCK, WATER, INTO = "stock_beaker", "water_beaker", "large"
TOTAL_ML = 120.0


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK, particles=500)


def after(env: LabEnv, stock_ml: float, water_ml: float) -> dict[str, Any]:
    """Dissolve the stock, bring it and water to the balance, mix them, and take a step."""
    swirl(env.workcell.simulation)
    bring(env.workcell.simulation, STOCK, INTO, stock_ml)
    bring(env.workcell.simulation, WATER, INTO, water_ml)
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def molar(env: LabEnv) -> float:
    """Return the concentration that the instruction asks for [mol/l]."""
    return float(env.workcell.task.instruction.split(" of ")[1].split(" mol/l")[0])


def made(info: dict[str, Any]) -> bool:
    """Return whether the concentration is what is asked for."""
    (so,) = (so for name, so in info["facts"].items() if " mol/l of " in name)
    return bool(so)


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in .*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


@pytest.mark.parametrize("split", ["id", pytest.param("ood", marks=pytest.mark.slow)])
def test_in_every_draw_the_weighed_share_makes_it_up(split: str) -> None:
    env = begun(TASK, split=split, particles=500)
    drawn = set()
    for seed in range(5):
        env.reset(seed=seed)
        drawn.add(env.workcell.task.instruction.split(" mol/l ")[1].split(":")[0])
        share = molar(env) / 0.5
        assert made(after(env, share * TOTAL_ML, (1.0 - share) * TOTAL_ML))
    assert len(drawn) == 2


@pytest.mark.parametrize("off", [-0.035, 0.035])
def test_three_and_a_half_per_cent_off_is_not_it(env: LabEnv, off: float) -> None:
    env.reset(seed=0)
    share = (1.0 + off) * molar(env) / 0.5
    assert not made(after(env, share * TOTAL_ML, (1.0 - share) * TOTAL_ML))


def test_the_stock_itself_is_not_it_nor_is_water(env: LabEnv) -> None:
    for stock, water in ((60.0, 0.0), (0.0, 60.0)):
        env.reset(seed=0)
        assert not made(after(env, stock, water))


@pytest.mark.parametrize("sludge", [False, True])
def test_what_is_weighed_before_the_crystals_have_dissolved_is_not_it(
    env: LabEnv, sludge: bool
) -> None:
    """Poured off them it holds too little, and from the bottom, with them, too much."""
    env.reset(seed=0)
    share, simulation = molar(env) / 0.5, env.workcell.simulation
    liquid = liquid_of(simulation)
    stock = np.flatnonzero(liquid.origins == liquid.names.index(STOCK))
    from_above = stock[np.argsort(-liquid.positions[stock, 2])]
    taken = round(1e-6 * share * TOTAL_ML / liquid.volume)
    portion = liquid.take(from_above[-taken:] if sludge else from_above[:taken])
    bring(simulation, WATER, INTO, (1.0 - share) * TOTAL_ML)
    put(simulation, portion, INTO)
    swirl(simulation)
    *_, info = env.step(env.workcell.filter.applied.copy())
    assert not made(info)


def test_who_swirls_stops_when_the_crystals_have_gone(env: LabEnv) -> None:
    """At every tilt to the left it is asked whether they have: here they go before the third."""
    env.reset(seed=0)
    swirled = next(step for step in env.workcell.task.steps if step.name == "swirl")
    phases = iter(swirled.skills[0].phases(env.workcell.world))
    names = [next(phases).name for _ in range(6)]
    swirl(env.workcell.simulation)
    env.step(env.workcell.filter.applied.copy())
    assert names + [phase.name for phase in phases] == [
        *("start", "pause", "left", "right", "left", "right"),
        *("return", "stabilise"),
    ]


def test_who_has_weighed_too_much_fills_up_further(env: LabEnv) -> None:
    env.reset(seed=0)
    share = molar(env) / 0.5
    info = after(env, 1.02 * share * TOTAL_ML, (1.02 - 1.02 * share) * TOTAL_ML)
    assert made(info)


def test_the_weighing_itself_lets_through_what_can_still_be_made_up(env: LabEnv) -> None:
    """2 g too much of the stock, with as much more water, is within every threshold at the end."""
    env.reset(seed=0)
    weigh = next(step for step in env.workcell.task.steps if step.name == "weigh")
    (mass,) = (fact.name for fact in weigh.substeps[0].when if " reads " in fact.name)
    low, high = re.findall(r"\d+\.?\d*", mass)
    assert float(high) - float(low) == pytest.approx(8.0, abs=0.1)


def test_a_little_of_the_right_concentration_is_too_little(env: LabEnv) -> None:
    env.reset(seed=0)
    share = molar(env) / 0.5
    info = after(env, share * 60.0, (1.0 - share) * 60.0)
    for _ in range(60):
        *_, info = env.step(env.workcell.filter.applied.copy())
        if info["outcome"] != "running":
            break
    assert made(info)
    assert not any(so for name, so in info["facts"].items() if "balance reads" in name)
    assert not info["is_success"]
