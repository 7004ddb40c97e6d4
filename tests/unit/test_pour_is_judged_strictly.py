"""Adversarial cases of pouring, played in the real simulation: nearly is not enough."""

import math
from dataclasses import replace

import numpy as np
import pytest

from adversary import begun, play, turning
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.shake import Shake

CYLINDER = 100000
"""A seed with which level 3 draws the graduated cylinder."""


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/pour")


@pytest.fixture(scope="module")
def empty() -> LabEnv:
    return begun("level1/pour", liquid="off")


@pytest.fixture(scope="module")
def whole() -> LabEnv:
    return begun("level2/pour_liquid", liquid="off")


@pytest.fixture
def cylinder() -> LabEnv:
    env = begun("level3/pour_liquid", liquid="off")
    env.reset(seed=CYLINDER)
    assert env.task.startswith("Lift the graduated cylinder")
    return env


def test_the_unspoilt_skill_pours_everything_and_spills_next_to_nothing(env):
    info = play(env, *env.workcell.task.skills)
    assert info["outcome"] == "success"
    assert info["ml_poured"] >= 95
    assert info["ml_spilled"] <= 1
    assert info["ml_poured"] + info["ml_spilled"] + info["ml_retained"] == pytest.approx(100)


def test_a_beaker_half_poured_out_has_not_been_poured_out(env):
    (pour,) = env.workcell.task.skills
    info = play(env, replace(pour, angle=math.radians(72)))
    assert info["outcome"] == "running"
    assert 10 < info["ml_poured"] < 80
    assert info["substeps"]["poured"] == np.inf


def test_a_beaker_emptied_beside_the_other_spills(env):
    beaker, _ = env.workcell.task.start
    away = OverBench("away", ahead=0.65, left=0.1, height=0.25)
    info = play(env, Shake(beaker, at=away, angle=math.radians(90), cycles=1))
    assert info["outcome"] == "interrupted"  # before it has spilled: the lip is not over the target


def test_pouring_past_the_mouth_spills(env):
    (pour,) = env.workcell.task.skills
    info = play(env, replace(pour, short=-0.05, turn_speed=1.2))
    assert info["outcome"] == "spilled"


def test_without_liquid_a_beaker_tilted_to_the_level_has_not_been_poured_out(empty):
    (pour,) = empty.workcell.task.skills
    info = play(empty, replace(pour, angle=math.radians(90)))
    assert info["outcome"] == "running"
    assert info["substeps"]["poured"] == np.inf
    assert "ml_poured" not in info


def test_without_liquid_a_beaker_tilted_beside_the_other_spills(empty):
    beaker, _ = empty.workcell.task.start
    away = OverBench("away", ahead=0.65, left=0.1, height=0.25)
    info = play(empty, Shake(beaker, at=away, angle=math.radians(60), cycles=1))
    assert info["outcome"] == "spilled"


def test_without_liquid_the_unspoilt_skill_succeeds_too(empty):
    assert play(empty, *empty.workcell.task.skills)["outcome"] == "success"


def test_without_liquid_a_tall_cylinder_may_lean_before_its_lip_is_low_enough(cylinder):
    info = play(cylinder, *cylinder.workcell.task.skills, seed=CYLINDER)
    assert info["outcome"] == "success"


def test_without_liquid_a_tall_cylinder_tilted_beside_the_other_spills(cylinder):
    pick, *_ = cylinder.workcell.task.skills
    away = OverBench("away", ahead=0.55, left=0.2, height=0.25)
    tilt = Shake(pick.thing, at=away, angle=math.radians(70), cycles=1)
    assert play(cylinder, pick, tilt, seed=CYLINDER)["outcome"] == "spilled"


def test_a_beaker_left_tilted_is_not_upright_again(empty):
    (pour,) = empty.workcell.task.skills
    info = play(empty, replace(pour, pause_s=60.0))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["poured"])
    assert info["substeps"]["righted"] == np.inf


def test_a_beaker_held_aslant_afterwards_is_not_upright(empty):
    (pour,) = empty.workcell.task.skills
    # High enough to clear the other.
    info = play(empty, replace(pour, drop=0.2), spoil=turning(0.26, "pour/stabilise"))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["poured"])
    assert not info["facts"]["beaker upright within 10 deg"]


def test_a_beaker_let_go_afterwards_is_dropped(empty):
    def let_go(expert, action):
        if expert.label == "pour/tilt_back" and empty.workcell.world.pose(beaker).tilt < 0.3:
            action[-1] = PANDA.max_opening

    beaker, _ = empty.workcell.task.start
    assert play(empty, *empty.workcell.task.skills, spoil=let_go)["outcome"] in {
        "dropped",
        "struck",
    }


def test_a_target_that_is_run_into_has_been_struck(empty):
    def lean_on(expert, action):
        if expert.label == "pour/ready":
            action[1] += 0.3

    info = play(empty, *empty.workcell.task.skills, spoil=lean_on)
    assert info["outcome"] == "struck"


def test_a_beaker_lifted_nineteen_centimetres_is_not_picked(whole):
    pick, pour, place = whole.workcell.task.skills
    info = play(whole, Pick(pick.thing, lift=0.19), pour, replace(place, hover=0.10))
    assert info["outcome"] == "running"
    assert info["substeps"]["gripped"] > 0
    assert info["substeps"]["lifted"] == np.inf


def test_a_beaker_that_stays_in_the_hand_has_not_been_set_down(whole):
    pick, _, place = whole.workcell.task.skills

    def keep_shut(expert, action):
        if expert.label.startswith("place"):
            action[-1] = pick.thing.grip_width - pick.squeeze

    info = play(
        whole, *whole.workcell.task.skills[:2], replace(place, retreat=0.0), spoil=keep_shut
    )
    assert info["outcome"] == "running"
    assert info["facts"]["beaker standing on where beaker stood"]
    assert info["substeps"]["released"] == np.inf
