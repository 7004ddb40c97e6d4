"""Axes of tasks with solutions: substance, concentration, start temperature."""

from typing import Any

import pytest

from adversary import begun, play
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import ph_together
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.setting import Setting, UnknownOptionError

AXES = {
    "level2/dissolve": ("substance", "mass", "start_temperature"),
    "level2/neutralise": ("substance", "concentration", "start_temperature"),
    "level3/identify_unknown": ("content", "concentration", "start_temperature"),
    "level3/precipitate": ("product", "concentration", "start_temperature"),
    "level4/crystallise": ("mass",),
    "level4/prepare_solution": ("substance", "concentration", "start_temperature"),
    "level4/titrate": ("substance", "concentration", "start_temperature"),
}
"""Task -> its axes: what is dissolved, how much of it, how warm it begins."""
PAIRS = [(task, axis) for task, axes in AXES.items() for axis in axes]


def drawn(task: str, axis: str, split: str) -> set[Any]:
    """Return what 20 episodes draw on an axis that the user names."""
    setting = Setting(task, obs="state", split=split, axes=(axis,))
    return {draw_scenario(setting, seed).drawn[axis] for seed in range(20)}


@pytest.mark.slow  # it makes every task
def test_these_are_all_tasks_in_which_something_is_dissolved() -> None:
    chemical = [
        task
        for task in task_files()
        if any(
            filling.reacts
            for filling in canonical_task(Setting(task, obs="state")).contents.values()
        )
    ]
    assert sorted(chemical) == sorted(AXES)


@pytest.mark.parametrize(("task", "axis"), PAIRS)
def test_every_axis_draws_and_its_test_values_are_held_back(task: str, axis: str) -> None:
    trained, shifted = (drawn(task, axis, split) for split in ("id", "ood"))
    assert len(trained) > 1
    assert not trained & shifted
    if axis == "start_temperature":
        assert 18.0 <= min(trained) <= max(trained) <= 25.0
        assert min(shifted) < 15.0
        assert max(shifted) > 30.0
        assert not [celsius for celsius in shifted if 15.0 < celsius < 30.0]


def test_nothing_of_this_varies_unless_it_is_asked_for() -> None:
    for task in AXES:
        for seed in range(3):
            scenario = draw_scenario(Setting(task, obs="state"), seed)
            assert "start_temperature" not in scenario.drawn
            fillings = scenario.task.contents.values()
            assert all(filling.celsius is None for filling in fillings)


def test_a_message_lists_them_for_the_tasks_that_have_them() -> None:
    with pytest.raises(UnknownOptionError, match=r"has: .*concentration, .*start_temperature"):
        canonical_task(Setting("level2/neutralise", obs="state", axes=("colour",)))
    with pytest.raises(UnknownOptionError, match="axes=start_temperature is no axis of level1/po"):
        canonical_task(Setting("level1/pour", obs="state", axes=("start_temperature",)))


def test_liquids_and_glass_begin_as_warm_as_was_drawn_and_the_room_does_not() -> None:
    env = begun("level3/precipitate", split="ood", axes=("start_temperature",))
    _, info = env.reset(seed=1)
    celsius = info["drawn"]["start_temperature"]
    for vessel in ("tall_beaker", "low_beaker", "large_beaker"):
        assert info["solutions"][vessel]["celsius"] == pytest.approx(celsius, abs=0.1)
        glass = env.workcell.simulation.apparatus.processes[f"{vessel}_temperature"]
        (kelvin, *_) = env.workcell.simulation.apparatus.memory(glass)
        assert kelvin - 273.15 == pytest.approx(celsius, abs=0.2)
    assert env.workcell.simulation.apparatus.ambient == 293.15


def test_episodes_that_begin_otherwise_warm_share_what_is_compiled() -> None:
    env = begun("level3/identify_unknown", axes=("start_temperature",))
    compiled, celsius = set(), set()
    for seed in (1, 3):  # both draw the same contents at the same places
        _, info = env.reset(seed=seed)
        compiled.add(env.workcell)
        warm = info["drawn"]["start_temperature"]
        for held in info["solutions"].values():
            assert held["celsius"] == pytest.approx(warm, abs=0.1)
        celsius.add(warm)
    assert len(compiled) == 1
    assert len(celsius) == 2


def test_the_end_point_of_a_titration_is_that_of_its_temperature() -> None:
    """Water of 40 degrees C has a pKw of 13.53, of 20 one of 14.17 (CRC Handbook)."""
    parts = ((Solute("hydrochloric acid", 0.1),), 10.0), ((Solute("sodium hydroxide", 0.1),), 10.0)
    assert ph_together(parts) == pytest.approx(14.17 / 2, abs=0.02)
    assert ph_together(parts, 40.0) == pytest.approx(13.53 / 2, abs=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("split", ["id", "ood"])
@pytest.mark.parametrize("task", [task for task, axes in AXES.items() if len(axes) == 3])
def test_the_expert_plays_it_with_all_three(task: str, split: str) -> None:
    env = begun(task, split=split, axes=AXES[task], particles=1000)
    assert play(env, seed=1)["outcome"] == "success"
