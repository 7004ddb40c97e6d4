"""The privileged state says what a lamp shows a camera: whether a button has been pressed."""

import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import LAMPS, Setting

HEATING = "level2/heat_beaker"


def test_it_is_lit_from_when_the_button_clicks_in_and_not_before():
    env = LabEnv(Setting(HEATING, obs="state", liquid="off"))
    lit = environment_state_names(canonical_task(env.setting)).index("heater_switch.lit")
    state, _ = env.reset(seed=1)
    expert, seen = env.expert(), [state["environment_state"][lit]]
    expert.start()
    over = False
    while not over:
        state, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
        seen.append(state["environment_state"][lit])
        assert seen[-1] == info["facts"]["heater_switch on"]
    assert info["is_success"]
    assert sorted(seen) == seen  # off, then on
    assert set(seen) == {0.0, 1.0}


def test_it_is_left_out_where_lamps_are_hidden_and_where_no_step_presses_the_button():
    names = environment_state_names(canonical_task(Setting(HEATING)))
    hidden = environment_state_names(canonical_task(Setting(HEATING)), [LAMPS])
    assert [name for name in names if name not in hidden] == ["heater_switch.lit"]
    door = environment_state_names(canonical_task(Setting("level1/open_door")))
    assert not any(name.endswith(".lit") for name in door)  # though the oven has a lamp


@pytest.mark.parametrize("task", ["level4/device_operation", "level4/liquid_fusion"])
def test_a_step_alone_has_it_whether_it_presses_the_button_or_not(task):
    whole = canonical_task(Setting(task))
    names = environment_state_names(whole)
    assert any(name.endswith(".lit") for name in names)
    for step in whole.steps:
        assert environment_state_names(canonical_task(Setting(task, step=step.name))) == names
