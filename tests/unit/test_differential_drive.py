"""The Fetch on its two driven wheels: it turns to where it drives, and never goes sideways."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import FETCH, FETCH_DIFFERENTIAL
from labutopia_lerobot.setting import Setting

SIDEWAYS = FETCH_DIFFERENTIAL.names.index("base_velocity_y")
ROBOT = "fetch_differential"


def test_it_is_the_fetch_but_for_its_way_sideways():
    assert FETCH_DIFFERENTIAL.names == FETCH.names
    differing = [
        name
        for name, lower, other in zip(
            FETCH.names, FETCH.lower, FETCH_DIFFERENTIAL.lower, strict=True
        )
        if lower != other
    ]
    assert differing == ["base_velocity_y"]
    assert FETCH_DIFFERENTIAL.base is not None
    assert not FETCH_DIFFERENTIAL.base.limits.sideways
    assert FETCH.base is not None
    assert FETCH.base.limits.sideways


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(Setting("level5/navigate", obs="state", room="organic_7", robot=ROBOT))


def test_a_command_to_go_sideways_is_refused_and_counted(env):
    env.reset(seed=1)
    before = env.workcell.simulation.base_pose.copy()
    action = env.workcell.simulation.command.astype(np.float32)
    action[SIDEWAYS] = 0.5
    for _ in range(30):
        *_, info = env.step(action)
    assert info["applied_action"][SIDEWAYS] == 0.0
    assert info["clipped_actions"] == 30
    assert np.abs(env.workcell.simulation.base_pose - before).max() < 1e-3


@pytest.mark.slow
def test_the_expert_drives_docks_and_picks_with_it():
    setting = Setting(
        "level5/navigation_and_manipulation", obs="state", room="organic_7", robot=ROBOT
    )
    with LabEnv(setting) as env:
        env.reset(seed=100100)
        expert, over, fastest = env.expert(), False, 0.0
        expert.start()
        while not over:
            *_, terminated, truncated, info = env.step(expert.act())
            over = terminated or truncated
            fastest = max(fastest, abs(env.workcell.world.base_velocity[1]))
    assert info["outcome"] == "success"
    assert not expert.unexpected
    assert info["clipped_actions"] == 0
    assert fastest < 0.02
