"""Adversarial cases of shaking, played in the real simulation: nearly is not enough."""

import math
from dataclasses import replace

import numpy as np
import pytest

from adversary import begun, play, turning
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.skills.pick import Pick
from labutopia_lerobot.skills.shake import Shake


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/shake", liquid="off")


def shake(env: LabEnv) -> Shake:
    return env.workcell.task.skills[-1]


def test_the_unspoilt_skill_succeeds(env):
    assert play(env, shake(env))["outcome"] == "success"


def test_two_cycles_are_not_three(env):
    info = play(env, replace(shake(env), cycles=2))
    assert info["outcome"] == "running"
    assert info["substeps"]["shaken"] == np.inf


def test_tilts_of_twelve_degrees_do_not_count(env):
    info = play(env, replace(shake(env), angle=math.radians(12)))
    assert info["outcome"] == "running"
    assert info["substeps"]["shaken"] == np.inf


def test_a_tilt_of_eighty_degrees_spills(env):
    assert play(env, replace(shake(env), angle=math.radians(80)))["outcome"] == "spilled"


def test_a_beaker_let_go_between_two_tilts_is_no_shake(env):
    def let_go(expert, action):
        if expert.label == "shake/right":
            action[-1] = PANDA.max_opening

    assert play(env, shake(env), spoil=let_go)["outcome"] in {"interrupted", "dropped"}


def test_a_beaker_let_go_after_one_and_a_half_seconds_is_dropped(env):
    begun: list[float] = []

    def let_go(expert, action):
        if expert.label == "shake/stabilise":
            begun.append(env.workcell.world.time)
            if env.workcell.world.time - begun[0] > 1.5:
                action[-1] = PANDA.max_opening

    info = play(env, shake(env), spoil=let_go)
    assert info["ever_success"]
    assert info["outcome"] == "dropped"


def test_a_beaker_brought_elsewhere_is_not_back_at_the_start(env):
    honest = shake(env)
    elsewhere = replace(honest.at, left=0.25)
    info = play(env, honest, replace(honest, at=elsewhere, cycles=0))
    assert info["outcome"] == "running"
    assert np.isfinite(info["substeps"]["returned"])
    assert info["facts"]["beaker gripped"]


def test_a_beaker_held_aslant_at_the_end_is_not_back_at_the_start(env):
    info = play(env, shake(env), spoil=turning(0.15, "shake/stabilise"))
    assert info["outcome"] == "running"
    assert not info["facts"]["beaker upright within 5 deg"]


def test_a_beaker_lifted_nineteen_centimetres_is_not_picked():
    env = begun("level2/shake_beaker", liquid="off")
    honest = shake(env)
    low = replace(honest, at=replace(honest.at, height=0.19))
    info = play(env, Pick(honest.thing, lift=0.19), low)
    assert info["outcome"] == "running"
    assert info["substeps"]["lifted"] == np.inf
