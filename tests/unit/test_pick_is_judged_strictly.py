"""Adversarial cases of `level1/pick`, played in the real simulation: nearly is not enough."""

import numpy as np
import pytest

from adversary import begun, play, turning
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills.pick import Pick


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/pick")


def test_the_unspoilt_expert_succeeds(env):
    assert play(env)["outcome"] == "success"


def test_a_flask_held_at_nineteen_centimetres_is_not_picked(env):
    (flask,) = env.workcell.task.start
    info = play(env, Pick(flask, lift=0.19))
    assert info["outcome"] == "running"
    assert not info["ever_success"]
    assert info["substeps"]["gripped"] > 0


def test_a_flask_dropped_after_one_and_a_half_seconds_is_dropped(env):
    begun: list[float] = []

    def drop(expert, action):
        if expert.label == "pick/hold":
            begun.append(env.workcell.world.time)
            if env.workcell.world.time - begun[0] > 1.5:
                action[-1] = 0.08

    info = play(env, spoil=drop)
    assert info["ever_success"]
    assert not info["is_success"]
    assert info["outcome"] == "dropped"


def test_a_flask_pushed_over_is_knocked_over(env):
    def shut(expert, action):
        action[-1] = 0.0  # a closed gripper runs into the neck

    assert play(env, spoil=shut)["outcome"] == "knocked_over"


def test_a_flask_held_aslant_is_not_picked(env):
    info = play(env, spoil=turning(0.6, "pick/hold"))
    assert info["outcome"] == "running"
    assert not info["facts"]["flask upright within 20 deg"]


def test_a_shaken_flask_is_not_held_steadily(env):
    def shake(expert, action):
        if expert.label == "pick/hold":
            action[0] += 0.12 * np.sin(12.0 * env.workcell.world.time)

    info = play(env, spoil=shake)
    assert info["outcome"] != "success"
    assert np.isfinite(info["substeps"]["lifted"])
