"""The axes that every task has: what they change, what they leave alone, and that it is undone."""

import math
from collections.abc import Iterable

import numpy as np
import pytest

from adversary import begun, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import catalogue
from labutopia_lerobot.layout import Workspace, sample_layout
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.scenario.distractors import held_out_sets, place_distractors, training_sets
from labutopia_lerobot.scenario.variation import AXES
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import Setting, UnknownOptionError

PICK = "level1/pick"
SEEDS = range(40)


def drawn(split: str, axis: str) -> list:
    setting = Setting(PICK, obs="state", split=split, axes=(axis,))
    return [draw_scenario(setting, seed).drawn[axis] for seed in SEEDS]


def test_nothing_varies_by_default():
    env = begun(PICK)
    _, info = env.reset(seed=1)
    assert info["drawn"] == {}


@pytest.mark.parametrize("axis", AXES)
def test_no_test_value_can_be_drawn_in_training_or_id(axis):
    def seen(split):
        values = drawn(split, axis)
        if axis in ("camera", "robot_start"):  # distinguished by their lengths
            return {round(float(np.linalg.norm(value)), 3) for value in values}
        return set(values)

    trained, same, other = (seen(split) for split in ("train", "id", "ood"))
    assert not (trained | same) & other
    if axis in ("camera", "robot_start"):
        assert max(trained | same) < min(other)


def test_the_layout_of_a_seed_is_the_same_whatever_else_varies():
    plain, varied = begun(PICK), begun(PICK, axes=("material", "light", "camera", "layout"))
    for seed in range(3):
        first, _ = plain.reset(seed=seed)
        second, info = varied.reset(seed=seed)
        assert second["environment_state"] == pytest.approx(first["environment_state"], abs=1e-5)
        assert info["drawn"].keys() == {"material", "light", "camera", "layout"}


def test_variation_changes_the_picture_and_the_next_episode_has_its_own():
    setting = Setting(PICK, cameras=("front",), width=64, height=64, axes=("material", "light"))
    env = LabEnv(setting)
    pictures = {}
    for seed in (0, 1, 2, 0):
        observation, _ = env.reset(seed=seed)
        picture = observation["pixels"]["front"]
        if seed in pictures:
            assert np.array_equal(picture, pictures[seed])
        pictures[seed] = picture
    assert not np.array_equal(pictures[0], pictures[1])
    env.close()


def test_the_instruction_is_the_one_that_was_drawn():
    env = begun(PICK, axes=("instruction",), split="ood")
    task = canonical_task(Setting(PICK))
    assert env.task == env.task_description == task.paraphrases[-1]


def test_the_robot_starts_where_it_was_drawn():
    env = begun(PICK, axes=("robot_start",))
    observation, info = env.reset(seed=0)
    home, _ = begun(PICK).reset(seed=0)
    away = observation["agent_pos"][:-1] - home["agent_pos"][:-1]
    assert away == pytest.approx(info["drawn"]["robot_start"], abs=0.01)


def test_distractors_stand_out_of_the_way_and_the_state_does_not_hold_them():
    env = begun(PICK, axes=("layout",))
    widths, seen = set(), set()
    for seed in range(12):
        observation, info = env.reset(seed=seed)
        widths.add(observation["environment_state"].size)
        pieces = env.workcell.simulation.scene.pieces
        seen.add(info["drawn"]["layout"])
        places = {p.name: env.workcell.world.pose(p).position_w for p in pieces}
        for name, place in places.items():
            if name.startswith("distractor"):
                assert np.linalg.norm(place - places["flask"]) > 0.15
    assert widths == {9 + 4}  # pose and sizes of the flask
    assert len(seen) > 6
    assert seen <= training_sets().keys()


def test_no_kind_that_stands_around_in_tests_only_does_in_training():
    def kinds(names: Iterable[str]) -> set[str]:
        return {name.split()[0] for name in names if name.split()[0] in catalogue()}

    train, test = kinds(training_sets()), kinds(held_out_sets())
    assert not train & test
    assert len(train) > 30
    assert len(test) > 10


def test_what_stands_around_stands_by_itself_and_fits_beside_the_hand():
    for pieces in (*training_sets().values(), *held_out_sets().values()):
        for piece in pieces:
            assert getattr(piece, "stands", True)
            assert piece.footprint_radius < 0.15


@pytest.mark.slow
def test_distractors_find_a_place_beside_an_open_door():
    """The first of them may leave no room for the last: then all begin anew."""
    setting = Setting("level1/close_door", obs="state", split="ood", axes=("layout",))
    workspace = Workspace.of(load_room(setting.room), load_robot(setting.robot))
    pieces = held_out_sets()["three flasks"]
    for seed in SEEDS:
        rng, scenario = np.random.default_rng(seed), draw_scenario(setting, seed)
        layout = sample_layout(scenario.task.start, rng)
        assert len(place_distractors(pieces, layout, workspace, 0.0, rng)) == 3


def test_distractors_leave_free_where_the_task_sets_something_down():
    setting = Setting("level4/titrate_by_volume", obs="state", split="ood", axes=("layout",))
    workspace = Workspace.of(load_room(setting.room), load_robot(setting.robot))
    spot = np.add(workspace.robot, (0.55, 0.25))
    for seed in range(20):
        rng, scenario = np.random.default_rng(seed), draw_scenario(setting, seed)
        layout = sample_layout(scenario.task.start, rng)
        pieces = held_out_sets()["three flasks"]
        around = place_distractors(pieces, layout, workspace, 0.0, rng, [spot])
        for piece, at in around.items():
            away = math.dist((at.x, at.y), spot) - piece.footprint_radius
            assert away > 0.13 + 0.08  # an open hand, and what it sets down


@pytest.mark.parametrize(
    ("split", "axes"),
    [
        ("ood", ("all",)),
        *(
            pytest.param(*case, marks=pytest.mark.slow)
            for case in [("id", ("all",)), ("id", ("robot_start",)), ("ood", ("robot_start",))]
        ),
    ],
)
def test_the_expert_copes(split, axes):
    env = begun(PICK, split=split, axes=axes)
    outcomes = [play(env, seed=seed)["outcome"] for seed in range(3)]
    assert outcomes == ["success"] * 3


def test_an_axis_that_does_not_exist_is_refused_before_anything_is_compiled():
    every = "material, wall, light, camera, robot_start, layout, room, instruction"
    reported = rf"axes=colour is no axis of level1/pick. It has: {every} \(or all\). split=ood can"
    with pytest.raises(UnknownOptionError, match=reported):
        LabEnv(Setting(PICK, axes=("colour",)))
    with pytest.raises(UnknownOptionError, match="split=ood shifts nothing in level1/pick"):
        LabEnv(Setting(PICK, split="ood"))


def test_each_axis_that_a_message_lists_works():
    with pytest.raises(UnknownOptionError) as reported:
        LabEnv(Setting("level3/pick", axes=("colour",), split="ood"))
    listed, _, shifted = str(reported.value).partition("It has: ")[2].partition(" (or all). ")
    assert listed.startswith("object, material, ")
    fixed = shifted.partition(" but ")[2].split(", ")
    for axis in listed.split(", "):
        LabEnv(Setting("level3/pick", axes=(axis,)))
        if axis not in fixed:
            LabEnv(Setting("level3/pick", axes=(axis,), split="ood"))


def test_a_room_is_as_warm_as_was_drawn_and_so_is_what_is_in_it():
    plain, warm = begun("level2/heat_beaker"), begun("level2/heat_beaker", axes=("ambient",))
    for seed in range(2):
        first, info = plain.reset(seed=seed)
        assert "ambient" not in info["drawn"]
        assert plain.workcell.world.reading("heater_surface").value == pytest.approx(20.0)
        second, info = warm.reset(seed=seed)
        assert np.array_equal(first["environment_state"], second["environment_state"])
        for name in ("heater_surface", "beaker_temperature"):
            now = warm.workcell.world.reading(name).value
            assert now == pytest.approx(info["drawn"]["ambient"])


def test_the_room_is_colder_or_hotter_in_a_test_than_it_ever_is_in_training():
    def degrees(split):
        setting = Setting("level2/heat_beaker", obs="state", split=split, axes=("ambient",))
        return [draw_scenario(setting, seed).drawn["ambient"] for seed in SEEDS]

    trained, shifted = degrees("id"), degrees("ood")
    assert not any(min(trained) <= value <= max(trained) for value in shifted)
    assert min(shifted) < min(trained) < max(trained) < max(shifted)


def test_where_nothing_heats_the_temperature_of_the_room_is_no_axis():
    with pytest.raises(UnknownOptionError, match="axes=ambient is no axis of level1/pick"):
        begun(PICK, axes=("ambient",))
