"""Near misses of liquid_fusion that a person would call failures, and odd plays that are right."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest

from adversary import Beside, begun, begun_with, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Pick, Place, Pour, Press
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.tasks.level4.liquid_fusion import liquid_fusion
from labutopia_lerobot.world import World

TASK = "level4/liquid_fusion"


@dataclass(frozen=True)
class PourPart(Pour):
    """Pour slowly, and stop when a share has arrived: a quarter is then on its way."""

    share: float = 0.47

    def phases(self, world: World) -> Iterator[Phase]:
        def enough(world: World, target, elapsed) -> bool:
            liquid, name = world.liquid, self.thing.name
            arrived = liquid.from_in(name, self.into.name)
            return arrived >= self.share * liquid.originated_in(name)

        for phase in super().phases(world):
            if phase.name == "tilt":
                yield replace(phase, done=enough, turn_speed=0.25, timeout_s=15.0)
            elif phase.name != "pause":
                yield phase


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun(TASK, liquid="off")


def shortened(monkeypatch, time_limit_s: float, **options) -> LabEnv:
    task = replace(liquid_fusion(), time_limit_s=time_limit_s)
    return begun_with(TASK, task, monkeypatch, **options)


def skills_of(env: LabEnv, kind: type) -> list:
    return [skill for skill in env.workcell.task.skills if isinstance(skill, kind)]


@pytest.mark.slow
def test_a_beaker_put_back_five_centimetres_off_is_not_back(monkeypatch):
    env = shortened(monkeypatch, 30.0, liquid="off")
    pick, pour, place = env.workcell.task.skills[:3]
    info = play(env, pick, pour, replace(place, on=Beside(place.thing, ahead=0.05)))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["2_pour/righted"])
    assert not np.isfinite(info["substeps"]["3_place/placed"])


@pytest.mark.slow
def test_less_than_four_fifths_of_a_liquid_is_not_poured(monkeypatch):
    env = shortened(monkeypatch, 30.0, particles=300)
    pick, pour, place = env.workcell.task.skills[:3]
    info = play(env, pick, PourPart(pour.thing, pour.into), place)
    assert info["outcome"] == "running"
    liquid = env.workcell.world.liquid
    share = liquid.from_in("blue_beaker", "large_beaker") / liquid.originated_in("blue_beaker")
    assert 0.65 <= share < 0.80
    assert not np.isfinite(info["substeps"]["2_pour/poured"])


POURED = "80 % of what was in {0} poured out of {0} into large_beaker"


@pytest.mark.slow
def test_one_liquid_does_not_count_for_another(monkeypatch):
    env = shortened(monkeypatch, 50.0, particles=150)
    skills = env.workcell.task.skills[:6]
    info = play(env, *(skill for skill in skills if skill is not skills[4]))
    assert info["outcome"] == "running"
    assert info["facts"][POURED.format("blue_beaker")]
    assert not info["facts"][POURED.format("green_beaker")]
    assert np.isfinite(info["substeps"]["4_pick/lifted"])
    assert not np.isfinite(info["substeps"]["5_pour/poured"])


def test_another_liquid_first_is_out_of_order(env):
    _, green, _ = skills_of(env, Pick)
    assert play(env, green)["outcome"] == "struck"


@pytest.mark.slow
def test_the_same_beaker_twice_is_the_wrong_one(env):
    blue = env.workcell.task.skills[:3]
    info = play(env, *blue, *blue)
    assert info["outcome"] == "struck"
    assert np.isfinite(info["substeps"]["3_place/released"])
    assert not np.isfinite(info["substeps"]["4_pick/gripped"])


@pytest.mark.slow
def test_a_hot_plate_that_is_not_switched_on_heats_nothing(env):
    info = play(env, *env.workcell.task.skills[:-1])
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["9_place/released"])
    assert not np.isfinite(info["substeps"]["10_press/pressed"])


@pytest.mark.slow
def test_a_hot_plate_that_is_switched_off_again_heats_nothing(env):
    (press,) = skills_of(env, Press)
    info = play(env, *env.workcell.task.skills, press)
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["10_press/pressed"])
    assert not info["facts"]["heater_switch on"]


@pytest.mark.slow
def test_beakers_put_back_three_centimetres_off_are_back(env):
    skills = [
        replace(skill, on=Beside(skill.thing, ahead=0.03)) if isinstance(skill, Place) else skill
        for skill in env.workcell.task.skills
    ]
    assert play(env, *skills)["outcome"] == "success"


@pytest.mark.slow
def test_a_liquid_may_be_poured_in_two_goes(env):
    pick, pour, *rest = env.workcell.task.skills
    info = play(env, pick, replace(pour, angle=math.radians(72)), pour, *rest)
    assert info["outcome"] == "success"
