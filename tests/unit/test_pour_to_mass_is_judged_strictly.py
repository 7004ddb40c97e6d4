"""Adversarial cases of `level2/pour_to_mass`, played in the real simulation."""

from dataclasses import replace

import pytest

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.task import NeedsLiquidError


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level2/pour_to_mass")


def test_without_liquid_it_is_refused():
    with pytest.raises(NeedsLiquidError, match="Choose liquid=on"):
        LabEnv(Setting("level2/pour_to_mass", obs="state", liquid="off"))


@pytest.mark.slow
def test_three_grams_too_much_are_overshot(env):
    tare, pick, pour, _ = env.workcell.task.skills
    info = play(env, tare, pick, replace(pour, amount=pour.amount + 4.0))
    assert info["outcome"] == "overshot"


@pytest.mark.slow
def test_two_grams_too_little_are_not_enough(env):
    tare, pick, pour, place = env.workcell.task.skills
    info = play(env, tare, pick, replace(pour, amount=pour.amount - 2.5), place)
    assert info["outcome"] != "success"


@pytest.mark.slow
def test_a_balance_that_was_not_tared_reads_too_much(env):
    _, pick, pour, place = env.workcell.task.skills
    info = play(env, pick, replace(pour, amount=pour.amount + 98.9), place)
    assert info["outcome"] != "success"
