"""Level 3: what varies, that train and test values never meet, what is shifted, what is judged."""

import itertools
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.labware.instruments.button_post import ButtonPost
from labutopia_lerobot.registry import tasks_of_levels
from labutopia_lerobot.scenario import AxisError, Draw, Scenario, canonical_task, draw_scenario
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.scenario.task_function import task_function
from labutopia_lerobot.scenario.variation import (
    AXES,
    draw_ambient,
    draw_instruction,
    draw_variation,
)
from labutopia_lerobot.setting import ALL, Setting
from labutopia_lerobot.skills import Press
from labutopia_lerobot.tasks.level3.press import TRAIN

TASKS = tasks_of_levels([3])
OWN = {
    "level3/heat_beaker": {"color", "position", "liquid", "ambient"},
    "level3/open_door": {"object"},
    "level3/pick": {"object"},
    "level3/pick_sizes": {"size"},
    "level3/pour_liquid": {"object", "position", "liquid"},
    "level3/pour_sizes": {"size"},
    "level3/press": {"color", "position"},
    "level3/transport_beaker": {"color", "position", "liquid"},
}
OF_ONE_TASK = {axis: task for task in reversed(TASKS) for axis in (*OWN[task], *AXES)}
"""Axis -> the first task that has it: `make test` draws its values there."""
PAIRS = [
    pytest.param(task, axis, marks=[] if OF_ONE_TASK[axis] == task else [pytest.mark.slow])
    for task in TASKS
    for axis in sorted({*OWN[task], *AXES})
]
SEEDS = range(30)


class Declared(Draw):
    """A draw that keeps what the axes are declared with."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.declared: dict[str, dict[str, Any]] = {}

    def _values_of(self, axis, train, test, shifted):
        self.declared[axis] = {"train": train, "test": test}
        return super()._values_of(axis, train, test, shifted)


@cache
def declared(task: str) -> dict[str, dict[str, Any]]:
    draw = Declared("id", (ALL,), (0, 1))
    value = task_function(task)(draw)
    draw_variation(draw, 7)
    draw_ambient(draw, value)
    draw_instruction(draw, value)
    return draw.declared


def is_among(value: Any, values: Any) -> bool:
    """Return whether a drawn value is one of some values, or in a range, or as long as one."""
    number = float(np.linalg.norm(value)) if isinstance(value, list) else value
    return any(
        low_high[0] <= number <= low_high[1] if isinstance(low_high, tuple) else number == low_high
        for low_high in values
    )


def scenarios(task: str, split: str, *axes: str) -> list[Scenario]:
    setting = Setting(task, obs="state", split=split, axes=axes)
    return [draw_scenario(setting, seed) for seed in SEEDS]


def test_level_3_is_the_paper_s():
    assert set(TASKS) == set(OWN)


@pytest.mark.parametrize("task", TASKS)
def test_a_task_has_its_own_axes_and_those_of_every_task(task):
    assert set(declared(task)) == OWN[task] | set(AXES)


@pytest.mark.parametrize(("task", "axis"), PAIRS)
def test_no_test_value_can_be_drawn_in_training_or_id(task, axis):
    train, test = declared(task)[axis]["train"], declared(task)[axis]["test"]
    if axis == "instruction":  # which words there are depends on the other axes
        said = [[s.drawn[axis] for s in scenarios(task, x, axis)] for x in ("train", "id", "ood")]
        assert not (set(said[0]) | set(said[1])) & set(said[2])
        return
    assert len(test) > 0
    for split in ("train", "id"):
        for scenario in (*scenarios(task, split), *scenarios(task, split, axis)):
            if axis in scenario.drawn:
                assert is_among(scenario.drawn[axis], train)
                assert not is_among(scenario.drawn[axis], test)
    for scenario in scenarios(task, "ood", axis):
        assert is_among(scenario.drawn[axis], test)


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("axis", ["object", "size", "color", "position", "liquid"])
def test_a_shifted_scene_holds_what_no_training_scene_holds(task, axis):
    if axis not in OWN[task]:
        return

    def shown(scenario: Scenario) -> set[Any]:
        start, contents = scenario.task.start.items(), scenario.task.contents.items()
        return {
            "position": {(piece.name, region) for piece, region in start},
            "liquid": {filling for _, filling in contents},
        }.get(axis, {piece for piece, _ in start})

    axes = (axis,) if axis == "liquid" else ()
    trained = {x for s in ("train", "id") for c in scenarios(task, s, *axes) for x in shown(c)}
    for scenario in scenarios(task, "ood", axis):
        assert shown(scenario) - trained


@pytest.mark.parametrize("task", [task for task in TASKS if task.endswith("_sizes")])
def test_sizes_of_the_size_test_are_really_different_and_one_shape_is_held_out(task):
    vessels = {
        scenario.drawn["size"]: next(iter(scenario.task.start))
        for split in ("id", "ood")
        for scenario in scenarios(task, split)
    }
    trained = {scenario.drawn["size"] for scenario in scenarios(task, "id")}
    kinds = {name: name.partition("ml ")[2] for name in vessels}
    assert {kinds[name] for name in trained} < set(kinds.values())
    alike = [vessels[name] for name in vessels if kinds[name] == kinds[min(trained)]]
    capacities = sorted(vessel.capacity for vessel in alike)
    assert len(capacities) >= 4
    for small, large in itertools.pairwise(capacities):
        assert large > 1.4 * small
    assert capacities[-1] > 6 * capacities[0]


@pytest.mark.parametrize("task", [task for task in TASKS if "position" in OWN[task]])
def test_places_for_tests_do_not_overlap_those_for_training(task):
    trained = scenarios(task, "id")[0].task.start
    for piece, region in scenarios(task, "ood", "position")[0].task.start.items():
        usual = next(region for other, region in trained.items() if other.name == piece.name)
        if usual != region:
            spans = [(getattr(usual, name), getattr(region, name)) for name in ("x", "y", "height")]
            assert any(a[1] < b[0] or b[1] < a[0] for a, b in spans)


@pytest.mark.parametrize("task", TASKS)
def test_ood_by_itself_shifts_what_the_paper_shifted(task):
    shifted = "size" if task.endswith("_sizes") else "material"
    for scenario in scenarios(task, "ood"):
        for axis, value in scenario.drawn.items():
            reported = declared(task)[axis]
            assert is_among(value, reported["test" if axis == shifted else "train"])
        assert shifted in scenario.drawn


@pytest.mark.parametrize("task", TASKS)
def test_axes_all_shifts_every_axis_at_once(task):
    for scenario in scenarios(task, "ood", ALL):
        assert set(scenario.drawn) == OWN[task] | set(AXES)
        for axis in scenario.drawn.keys() - {"instruction"}:
            assert is_among(scenario.drawn[axis], declared(task)[axis]["test"])
        assert scenario.task.instruction == scenario.drawn["instruction"]


@pytest.mark.parametrize("task", TASKS)
def test_state_limits_and_sub_steps_are_the_same_for_every_draw(task):
    canonical = canonical_task(Setting(task))
    substeps = [substep.name for substep in canonical.substeps]
    for scenario in (*scenarios(task, "id"), *scenarios(task, "ood", ALL)):
        drawn = scenario.task
        assert environment_state_names(drawn) == environment_state_names(canonical)
        assert drawn.max_steps == canonical.max_steps
        assert [substep.name for substep in drawn.substeps] == substeps


def test_the_state_says_how_large_the_vessel_is_that_was_drawn():
    env, heights = begun("level3/pick"), set()
    for seed in range(8):
        observation, _ = env.reset(seed=seed)
        (vessel,) = env.workcell.task.start
        names = environment_state_names(env.workcell.task)
        for size in ("height", "footprint_radius", "grip_height", "grip_width"):
            said = observation["environment_state"][names.index(f"{vessel.name}.{size}")]
            assert said == pytest.approx(getattr(vessel, size))
        heights.add(vessel.height)
    assert len(heights) == 3  # of three flasks


def test_the_state_says_where_the_handle_of_the_oven_is_that_was_drawn():
    env, places = begun("level3/open_door"), {}
    for seed in range(8):
        observation, info = env.reset(seed=seed)
        names = environment_state_names(env.workcell.task)
        at = [names.index(f"oven_handle.{axis}") for axis in "xyz"]
        world = env.workcell.world
        handle_b = world.robot_base.inverse() @ world.frame("oven_handle")
        assert observation["environment_state"][at] == pytest.approx(handle_b.position_w, abs=1e-6)
        (oven,) = env.workcell.task.start
        frame_o = world.pose(oven).inverse() @ world.frame("oven_handle")
        places[info["drawn"]["object"]] = frame_o.position_w
    drying, vacuum = (places[kind] for kind in ("drying oven", "vacuum oven"))
    assert np.linalg.norm(drying - vacuum) > 0.02  # what the oven's pose does not tell
    hidden = environment_state_names(env.workcell.task, ["handles"])
    assert [name for name in names if name not in hidden] == [names[index] for index in at]


def test_a_step_alone_has_the_state_of_its_task_whether_it_takes_the_handle_or_not():
    whole = canonical_task(Setting("level4/drying_beakers"))
    names = environment_state_names(whole)
    assert "oven_handle.x" in names
    for step in whole.steps:
        alone = canonical_task(Setting("level4/drying_beakers", step=step.name))
        assert environment_state_names(alone) == names


def test_starts_are_no_narrower_than_level_1_s():
    twins = {"pick": "level1/pick", "pick_sizes": "level1/pick", "pour_sizes": "level1/pour"}
    twins |= {name: f"level2/{name}" for name in ("heat_beaker", "pour_liquid", "transport_beaker")}
    twins["open_door"] = "level1/open_door"
    for name, twin in twins.items():
        usual = canonical_task(Setting(twin)).start.values()
        for scenario in scenarios(f"level3/{name}", "id"):
            for region, wanted in zip(scenario.task.start.values(), usual, strict=True):
                for span in ("x", "y", "yaw"):
                    wide = [np.ptp(getattr(r, span)) for r in (region, wanted)]
                    assert wide[0] >= wide[1] - 1e-9


def test_the_instruction_names_the_colour_and_the_target_has_it():
    for scenario in (*scenarios("level3/press", "id"), *scenarios("level3/press", "ood", "color")):
        color = scenario.drawn["color"]
        target, *others = scenario.task.start
        assert f" {color} " in scenario.task.instruction
        assert isinstance(target, ButtonPost)
        assert target.color == color
        assert {other.color for other in others} <= set(TRAIN) - {color}


@pytest.mark.parametrize("split", ["id", "ood"])
def test_pressing_another_colour_is_the_wrong_button(split):
    env = begun("level3/press", split=split, **({"axes": ("color",)} if split == "ood" else {}))
    env.reset(seed=5)
    _, other, _ = env.workcell.task.start
    assert play(env, Press(other.button, hold=2.5))["outcome"] == "wrong_button"


def test_what_was_drawn_is_reported():
    env = begun("level3/pick", split="ood")
    _, info = env.reset(seed=3)
    assert info["drawn"] == draw_scenario(env.setting, 3).drawn
    assert info["drawn"]["object"] in env.task


def test_a_test_value_among_the_training_values_is_refused():
    draw = Draw("id", (), (0, 1))
    with pytest.raises(AxisError, match="part them"):
        draw.choice("color", train=("red", "green"), test=("green",))


def test_the_same_seed_draws_the_same_whatever_else_is_shifted():
    plain = Setting("level3/transport_beaker", obs="state", split="ood", axes=("color",))
    both = replace(plain, axes=("color", "position"))
    for seed in SEEDS:
        first, second = draw_scenario(plain, seed).drawn, draw_scenario(both, seed).drawn
        assert first["color"] == second["color"]
