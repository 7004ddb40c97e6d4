"""Driving to what one reaches into: where such instruments stand, and in which rooms."""

import math
from collections.abc import Iterator

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.layout import OnDeepBench, OnSomeBench, sample_layout
from labutopia_lerobot.predicates import at_hand, below_hand
from labutopia_lerobot.robots.fetch_base import FETCH_BASE
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.scenes import NowhereToDriveError, load_room, rooms_to_drive_in
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.scenes.room_map import frame_around
from labutopia_lerobot.scenes.rooms_to_drive_in import rooms_with_deep_benches, rooms_with_sinks
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.way import base_at, dock_for
from labutopia_lerobot.tasks.driving import AT_HAND

OVEN, SINK = "level5/transport_to_oven", "level5/clear_bench"


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


@pytest.mark.parametrize("robot", ["ridgeback_panda", "fetch"])
@pytest.mark.parametrize(("task", "index"), [(OVEN, 1), (SINK, 0), (SINK, 3)])
def test_what_is_reached_into_or_from_above_is_at_hand_from_its_dock_and_not_farther_off(
    task: str, index: int, robot: str
):
    env = LabEnv(Setting(task, obs="state", liquid="off", room="organic_7", robot=robot))
    env.reset(seed=0)
    world, simulation = env.workcell.world, env.workcell.simulation
    thing = list(env.workcell.task.start)[index]
    above = index < len(env.workcell.task.start) - 1
    dock = dock_for(world, thing, from_above=above)
    is_there = below_hand(thing) if above else at_hand(thing, share=AT_HAND)
    inwards = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])

    def holds(place: np.ndarray) -> bool:
        for axis, joint in enumerate(("base_x", "base_y")):
            simulation.data.joint(joint).qpos += place[axis] - base_at(world)[0][axis]
        mujoco.mj_forward(simulation.scene.model, simulation.data)
        return is_there.holds(world)

    assert holds(dock.position)
    assert holds(dock.position - 0.03 * inwards)  # as near as a base comes that only rolls
    assert not holds(dock.position - 0.4 * inwards)
    if task == OVEN:  # into a mouth an arm reaches from one place only
        assert math.dist(dock.position, dock.before) < 0.4
        assert not holds(dock.before)
    env.close()


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


@pytest.fixture(scope="module")
def at_the_sink() -> Iterator[LabEnv]:
    env = LabEnv(Setting(SINK, obs="state", room="organic_7"))
    yield env
    env.close()


def test_the_sink_of_the_room_is_that_of_the_task(at_the_sink: LabEnv):
    at_the_sink.reset(seed=0)
    plan, workcell = load_plan("organic_7"), at_the_sink.workcell
    (placed,) = (piece for piece in plan.pieces if piece.kind == "laboratory_sink")
    turn, moved = frame_around(plan.work_places[0])
    sink = next(piece for piece in workcell.task.start if piece.name == "sink")
    pose, model = workcell.world.pose(sink), workcell.simulation.scene.model
    assert pose.position_w == pytest.approx([*(turn @ (placed.x, placed.y) + moved), 0.0])
    c, s = (round(f(math.radians(placed.heading))) for f in (math.cos, math.sin))
    assert -pose.x_axis[:2] == pytest.approx(turn @ (c, s))  # its front
    bodies = {model.body(body).name for body in range(model.nbody)}
    assert f"room_{placed.name}" not in bodies
    others = {f"room_{piece.name}" for piece in plan.pieces if piece.kind == "wall_bench"}
    assert others <= bodies
    dock = dock_for(workcell.world, sink)
    ahead = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
    assert ahead @ -pose.x_axis[:2] == pytest.approx(-1.0)
    assert math.dist(dock.position, pose.position_w[:2]) < 1.1


def test_the_beakers_to_clear_away_stand_on_one_bench_apart(at_the_sink: LabEnv):
    for seed in range(3):
        at_the_sink.reset(seed=seed)
        world, (*beakers, _) = at_the_sink.workcell.world, at_the_sink.workcell.task.start
        assert len({dock_for(world, beaker).bench for beaker in beakers}) == 1
        points = [world.pose(beaker).position_w[:2] for beaker in beakers]
        pairs = [(a, b) for n, a in enumerate(points) for b in points[:n]]
        assert min(math.dist(a, b) for a, b in pairs) >= 0.249


def test_a_room_without_a_sink_that_a_robot_gets_to_is_refused_by_name():
    with pytest.raises(
        NowhereToDriveError, match=r"'physics_0' has no laboratory_sink .* organic_7"
    ):
        canonical_task(Setting(SINK, room="physics_0"))
    with pytest.raises(NowhereToDriveError, match=r"'organic_5' has 0 of the 1 .* for 3 things"):
        canonical_task(Setting(SINK, room="organic_5"))


def test_benches_are_cleared_in_forty_rooms_those_for_tests_of_another_family():
    train, test = rooms_with_sinks()
    assert len(train) + len(test) >= 40
    assert len(test) >= 5
    families = [{name.rpartition("_")[0] for name in names} for names in (train, test)]
    assert not families[0] & families[1]


@pytest.mark.slow
def test_rooms_for_clearing_are_those_with_a_sink_and_a_bench_for_three_things():
    fit = []
    for name in plan_names():
        plan = load_plan(name)
        if plan.work_places and any(piece.kind == "laboratory_sink" for piece in plan.pieces):
            grounds = [load_room(name).ground(base) for base in (RIDGEBACK, FETCH_BASE)]
            if all(
                "laboratory_sink" in g.fixtures and g.benches_for(3, 0.25, from_above=True)
                for g in grounds
            ):
                fit.append(name)
    assert sorted(fit) == sorted(name for names in rooms_with_sinks() for name in names)
