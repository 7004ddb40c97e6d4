"""Adversarial cases of `level4/crystallise`: hot and clear, cold, crystals, liquid off."""

import math

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import solid_at
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError
from solution_bench import bring, liquid_of, mix

TASK = "level4/crystallise"
BEAKER, OTHER = "beaker", "large_beaker"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK)


def brought_to(env: LabEnv, celsius: float) -> None:
    """Bring the liquid to a temperature and wait until it has mixed."""
    liquid = liquid_of(env.workcell.simulation)
    for _ in range(4):  # crystals that form or dissolve warm it, or cool it
        liquid.temperatures[:] = celsius + 273.15
        mix(env.workcell.simulation, 40.0)
    liquid.temperatures[:] = celsius + 273.15


def facts(env: LabEnv) -> list[bool]:
    """Take a step; return whether all is dissolved, crystals have formed, liquor is decanted."""
    *_, info = env.step(env.workcell.filter.applied.copy())
    return [
        next(so for name, so in info["facts"].items() if part in name)
        for part in ("all in beaker dissolved", "mmol of KNO3(s) or more", "ml of what was in")
    ]


def test_without_liquid_it_is_refused() -> None:
    with pytest.raises(NeedsLiquidError, match=r"solutions in .*Choose liquid=on"):
        LabEnv(Setting(TASK, obs="state", liquid="off"))


def test_what_comes_back_is_what_no_longer_dissolves() -> None:
    """By hand, van 't Hoff: 383 g/l dissolve at 25 C with 34.9 kJ/mol (CRC Handbook)."""
    dissolves = 383.0 / 101.1 * math.exp(-34900.0 / 2 / 8.314 * (1 / 295.15 - 1 / 298.15))
    total = 3.0 + 1.2 / 101.1 / 0.010
    came_back = solid_at(
        (Solute("potassium nitrate", 3.0),), Crystals("potassium nitrate", 1.2), 10.0, 22.0
    )
    assert came_back == pytest.approx(0.010 * (total - dissolves), rel=0.03)


def test_cold_crystals_with_the_liquor_off_them_are_what_is_asked_for(env: LabEnv) -> None:
    env.reset(seed=0)
    brought_to(env, 40.0)
    assert facts(env) == [True, False, False]
    brought_to(env, 18.0)
    assert facts(env) == [False, True, False]
    bring(env.workcell.simulation, BEAKER, OTHER, 0.0)
    assert facts(env)[1:] == [True, False]


def test_crystals_that_were_never_dissolved_are_not_hot_and_clear(env: LabEnv) -> None:
    env.reset(seed=0)
    brought_to(env, 5.0)
    *_, info = env.step(env.workcell.filter.applied.copy())
    assert facts(env)[:2] == [False, True]
    assert info["substeps"]["dissolved"] == np.inf


def test_what_stays_warm_does_not_crystallise(env: LabEnv) -> None:
    env.reset(seed=0)
    brought_to(env, 40.0)
    brought_to(env, 28.0)
    assert facts(env)[1] is False


def test_who_pours_everything_out_has_no_crystals_left(env: LabEnv) -> None:
    env.reset(seed=0)
    brought_to(env, 40.0)
    brought_to(env, 18.0)
    bring(env.workcell.simulation, BEAKER, OTHER, 10.0)
    assert facts(env)[1:] == [False, True]


@pytest.mark.slow
@pytest.mark.parametrize("left_out", [(1,), (4,)], ids=["not waited until clear", "decanted hot"])
def test_who_leaves_a_step_out_does_not_succeed(env: LabEnv, left_out: tuple[int, ...]) -> None:
    steps = env.workcell.task.steps
    skills = [
        skill for index, step in enumerate(steps) if index not in left_out for skill in step.skills
    ]
    assert play(env, *skills)["outcome"] != "success"


@pytest.mark.slow
def test_the_expert_crystallises() -> None:
    assert play(begun(TASK, particles=1000), seed=1)["outcome"] == "success"
