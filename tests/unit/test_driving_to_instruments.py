"""Driving to what one reaches into: where such instruments stand, and in which rooms."""

import math
from collections.abc import Iterator

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.layout import OnDeepBench, OnSomeBench, sample_layout
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.scenes import NowhereToDriveError, load_room, rooms_to_drive_in
from labutopia_lerobot.scenes.rooms_to_drive_in import rooms_with_deep_benches
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.way import dock_for

OVEN = "level5/transport_to_oven"


@pytest.fixture(scope="module")
def to_the_oven() -> Iterator[LabEnv]:
    env = LabEnv(Setting(OVEN, obs="state", liquid="off", room="organic_7"))
    yield env
    env.close()


def test_an_oven_is_where_level_4_has_it_from_the_dock_that_is_driven_to(to_the_oven: LabEnv):
    docks = set()
    for seed in range(3):
        to_the_oven.reset(seed=seed)
        world, (_, oven) = to_the_oven.workcell.world, to_the_oven.workcell.task.start
        dock = dock_for(world, oven)
        ahead = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
        away = world.pose(oven).position_w[:2] - dock.position - RIDGEBACK.arm[0] * ahead
        assert 0.97 <= away @ ahead <= 1.00  # level 4: x of 0.57 to 0.60, the arm at -0.40
        assert -0.045 <= away @ (-ahead[1], ahead[0]) <= -0.005
        turned = math.atan2(*world.pose(oven).x_axis[1::-1]) - dock.yaw
        assert abs(math.remainder(turned, math.tau)) <= math.radians(3.0) + 1e-9
        assert world.joint(oven.door.joint) == pytest.approx(math.radians(110.0), abs=0.01)
        docks.add(tuple(dock.position))
    assert len(docks) > 1


def test_a_room_without_a_bench_for_an_oven_is_refused_by_name():
    with pytest.raises(NowhereToDriveError, match=r"'analytical_0' has 0 of the 1 .* an oven"):
        canonical_task(Setting(OVEN, room="analytical_0"))


def test_episodes_with_an_oven_are_in_forty_rooms_that_have_a_bench_for_it():
    train, test = rooms_with_deep_benches()
    every, held_out = rooms_to_drive_in()
    assert set(train) < set(every)
    assert test == held_out
    assert len(train) + len(test) >= 40
    for split, names in (("id", train), ("ood", test)):
        rooms = {draw_scenario(Setting(OVEN, split=split), n).variation.room for n in range(30)}
        assert rooms <= set(names)
        assert len(rooms) > 5


@pytest.mark.slow
def test_rooms_for_ovens_are_those_with_a_deep_bench_and_another():
    every = [name for names in rooms_to_drive_in() for name in names]
    fit = [name for name in every if load_room(name).ground(RIDGEBACK).deep_benches]
    assert sorted(fit) == sorted(name for names in rooms_with_deep_benches() for name in names)


def test_nothing_else_stands_on_the_bench_of_an_oven():
    ground = load_room("organic_7").ground(RIDGEBACK)
    oven, other = DryingOven("oven"), DryingOven("other")
    deep = OnDeepBench(ahead=(0.97, 1.0), left=(0.0, 0.0), yaw=(0.0, 0.0))
    for seed in range(5):
        start = {other: OnSomeBench(), oven: deep}
        layout = sample_layout(start, np.random.default_rng(seed), ground)
        assert layout[oven].bench in ground.deep_benches
        assert layout[other].bench != layout[oven].bench
    with pytest.raises(NowhereToDriveError, match="deep enough for an oven"):
        sample_layout({oven: deep, other: deep}, np.random.default_rng(0), ground)
