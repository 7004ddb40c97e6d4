"""The privileged state says where a thing stood that its task wants back there."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import HOMES, Setting

POURED = "level2/pour_liquid"


def test_it_is_where_the_thing_stood_however_far_it_has_been_carried_since():
    env = LabEnv(Setting(POURED, obs="state", liquid="off"))
    names = environment_state_names(canonical_task(env.setting))
    now, home = ([names.index(f"beaker.{of}{axis}") for axis in "xyz"] for of in ("", "home."))
    homes = []
    for seed in (3, 4):
        first = env.reset(seed=seed)[0]["environment_state"]
        assert first[home] == pytest.approx(first[now], abs=1e-3)
        expert, state = env.expert(), first
        expert.start()
        while np.linalg.norm(state[now] - first[now]) < 0.2:
            state = env.step(expert.act())[0]["environment_state"]
        assert np.array_equal(state[home], first[home])
        homes.append(first[home])
    assert np.linalg.norm(homes[0] - homes[1]) > 0.01


def test_it_is_left_out_where_homes_are_hidden_and_of_what_is_not_put_back():
    task = canonical_task(Setting(POURED, obs="state"))
    names = environment_state_names(task)
    homes = [name for name in names if ".home." in name]
    assert homes == ["beaker.home.x", "beaker.home.y", "beaker.home.z"]  # not of the target
    hidden = environment_state_names(task, [HOMES])
    assert hidden == tuple(name for name in names if name not in homes)


def test_a_step_alone_has_it_whether_it_puts_anything_back_or_not():
    whole = canonical_task(Setting("level4/clean_beaker"))
    names = environment_state_names(whole)
    assert {"full_beaker.home.x", "dirty_beaker.home.x"} < set(names)
    for step in whole.steps:
        alone = canonical_task(Setting("level4/clean_beaker", step=step.name))
        assert environment_state_names(alone) == names
