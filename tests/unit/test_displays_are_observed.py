"""The privileged state says what displays show: a picture shows it as well."""

import math

import numpy as np

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import DISPLAYS, Setting
from labutopia_lerobot.world import Reading

WEIGHING = "level2/weigh_beaker"
SHOWN = ["balance_reading", "balance_reading.settled"]


def names_of(task, hidden=()):
    return environment_state_names(canonical_task(Setting(task)), hidden)


def test_a_balance_is_read_in_every_step_until_a_beaker_stands_on_it():
    env = LabEnv(Setting(WEIGHING, obs="state", liquid="off"))
    shown, settled = (names_of(WEIGHING).index(name) for name in SHOWN)
    state, _ = env.reset(seed=1)
    assert state["environment_state"][shown] < -10.0  # tared with something on it
    expert, seen = env.expert(), set()
    expert.start()
    over = False
    while not over:
        state, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
        assert env.observation_space.contains(state)
        numbers = state["environment_state"]
        assert numbers[shown] == np.float32(info["readings"]["balance_reading"])
        seen.add(float(numbers[settled]))
    assert info["is_success"]
    assert numbers[shown] > 10.0  # grams of a beaker
    assert seen == {0.0, 1.0}  # not while the beaker comes to rest


def test_it_is_left_out_where_displays_are_hidden_and_where_there_are_none():
    hidden = names_of(WEIGHING, [DISPLAYS])
    assert [name for name in names_of(WEIGHING) if name not in hidden] == SHOWN
    assert names_of("level1/pick") == names_of("level1/pick", [DISPLAYS])
    unread = LabEnv(Setting(WEIGHING, obs="state", hidden=(DISPLAYS,)))
    assert np.isfinite(unread.observation_space["environment_state"].high).all()


def test_dashes_and_errors_are_zero_and_not_settled():
    assert Reading(math.nan, "g").observed == (0.0, 0.0)
    assert Reading(math.inf, "g").observed == (0.0, 0.0)
    assert Reading(12.34, "g", 0.1, settled=False).observed == (12.3, 0.0)
    assert Reading(12.34, "g", 0.1).observed == (12.3, 1.0)
