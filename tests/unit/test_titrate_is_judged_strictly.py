"""Adversarial cases of `level4/titrate`: the end point of the acid counts, however it looks."""

import re
from typing import Any

import pytest

from adversary import begun
from labutopia_lerobot.chemistry.poured_together import ph_together
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario import draw_scenario
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring, liquid_of

TASK = "level4/titrate"
BURETTE, BEAKER = "stand_burette", "beaker"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK, particles=1000)


def needed(env: LabEnv) -> float:
    """Return the equivalence volume of the episode [ml], by hand: 0.1 mol/l of base."""
    held = {vessel.name: filling for vessel, filling in env.workcell.task.contents.items()}
    return held[BEAKER].ml * held[BEAKER].dissolved[0].molar / 0.1


def after(env: LabEnv, more_ml: float, *, of_water: bool = False) -> dict[str, Any]:
    """Begin, bring the equivalence volume and some more into the beaker, and take a step."""
    env.reset(seed=0)
    simulation = env.workcell.simulation
    liquid = liquid_of(simulation)
    if of_water:
        assert liquid.solutions is not None
        water = liquid.solutions.inventory.filled((), liquid.volume)
        liquid.kept.portion.contents[:] = water
    bring(simulation, BURETTE, BEAKER, needed(env) + more_ml)
    *_, info = env.step(env.workcell.filter.applied.copy())
    return info


def reached(info: dict[str, Any]) -> list[bool]:
    """Return what is said of the pH, and of the volume, in the beaker."""
    (ph,) = (so for name, so in info["facts"].items() if name.startswith("pH of beaker between"))
    (ml,) = (
        so
        for name, so in info["facts"].items()
        if " ml of what was in" in name and "to" in name.split(" ml")[0]
    )
    return [ph, ml]


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in .*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


@pytest.mark.parametrize("more_ml", [-0.05, 0.0, 0.05])
def test_the_equivalence_volume_is_the_end_point(env: LabEnv, more_ml: float) -> None:
    info = after(env, more_ml)
    assert reached(info) == [True, True]
    assert info["outcome"] == "running"


def test_two_drops_less_are_not(env: LabEnv) -> None:
    assert reached(after(env, -0.2)) == [False, False]


def test_four_drops_more_are_too_many(env: LabEnv) -> None:
    info = after(env, 0.3)
    assert reached(info) == [False, False]
    assert info["outcome"] in {"overshot", "overrun"}


def test_water_is_no_base_however_much_of_it_runs(env: LabEnv) -> None:
    assert reached(after(env, 0.0, of_water=True)) == [False, True]


def test_an_acid_that_was_partly_spilled_is_neutral_too_soon(env: LabEnv) -> None:
    env.reset(seed=0)
    simulation = env.workcell.simulation
    bring(simulation, BEAKER, None, 20.0)
    bring(simulation, BURETTE, BEAKER, needed(env) * 25.0 / 45.0)
    *_, info = env.step(env.workcell.filter.applied.copy())
    assert reached(info)[1] is False


@pytest.mark.parametrize("seed", range(4))
def test_what_began_warm_or_cold_is_no_overshoot_within_a_tenth_of_a_millilitre(seed: int) -> None:
    """It comes to the room's temperature meanwhile, at which the same base has another pH."""
    setting = Setting(TASK, split="ood", axes=("start_temperature",))
    task = draw_scenario(setting, seed).task
    held = {vessel.name: filling for vessel, filling in task.contents.items()}
    acid, base = held[BEAKER], held[BURETTE]
    (limit,) = re.findall(r"above ([\d.]+)", task.never["overshot"].name)
    ml = acid.ml * acid.dissolved[0].molar / 0.1 + 0.095
    for celsius in (acid.celsius, 20.0):
        parts = ((acid.dissolved, acid.ml), (base.dissolved, ml))
        assert ph_together(parts, celsius) < float(limit)
