"""Tasks in which one drives: what an episode draws, and what is refused before one begins."""

import math
from collections.abc import Iterator
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.evaluation.journey import Journey
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.target_plate import TargetPlate
from labutopia_lerobot.labware.instruments.weighing.precision_balance import PrecisionBalance
from labutopia_lerobot.layout import OnBench, OnSomeBench, sample_base, sample_layout
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.navigation.path_planner import BlockedPlaceError, PathPlanner
from labutopia_lerobot.predicates import at_hand, beside
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.robots.fetch_base import FETCH_BASE
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.scenario import ArmsAloneError, NeedsBaseError, canonical_task, draw_scenario
from labutopia_lerobot.scenes import NowhereToDriveError, load_room, rooms_to_drive_in
from labutopia_lerobot.scenes.ground import Ground
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.skills.way import Way, base_at, dock_for
from labutopia_lerobot.task import TaskError
from labutopia_lerobot.tasks.driving import AT_HAND, NEAR
from labutopia_lerobot.world import BENCH, CONTROL_HZ, World
from tests.adversary import begun_with

PICK, TRANSPORT = "level5/navigation_and_manipulation", "level5/transport_between_areas"
DRIVING = [task for task in task_files() if canonical_task(Setting(task)).drives]


@pytest.fixture(scope="module")
def ground() -> Ground:
    return load_room("organic_7").ground(RIDGEBACK)


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(Setting(PICK, obs="state", room="organic_7"))


def test_the_tasks_of_level_5_drive_with_the_robot_of_the_paper():
    assert set(DRIVING) >= {PICK, TRANSPORT}
    for task in task_files():
        drives = task in DRIVING
        assert Setting(task).robot == ("ridgeback_panda" if drives else "panda")
    assert Setting("level1/pick", robot="ridgeback_panda").robot == "ridgeback_panda"


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
def test_an_arm_on_a_stand_is_refused_where_one_drives(robot):
    with pytest.raises(NeedsBaseError, match=f"robot={robot} .* Choose from: ridgeback_panda"):
        canonical_task(Setting(PICK, robot=robot))


@pytest.mark.parametrize("task", ["level3/pick", "level4/clean_beaker"])
@pytest.mark.parametrize("robot", ["ridgeback_panda", "fetch_differential"])
def test_a_base_is_refused_where_arms_alone_play(robot, task):
    with pytest.raises(ArmsAloneError, match=f"{robot} has a base, and {task} .* panda, iiwa$"):
        canonical_task(Setting(task, robot=robot))


def test_a_room_without_enough_benches_is_refused_by_name():
    with pytest.raises(NowhereToDriveError, match="'biology_9' has 0 of the 1 benches"):
        canonical_task(Setting(PICK, room="biology_9"))
    with pytest.raises(NowhereToDriveError, match=r"'biology_5' has 1 of the 2 .* organic_7"):
        canonical_task(Setting(TRANSPORT, room="biology_5"))
    assert canonical_task(Setting(PICK, room="biology_5")).drives


def test_a_task_that_drives_says_so():
    task = canonical_task(Setting(PICK))
    with pytest.raises(TaskError, match="`beaker` starts OnSomeBench: say `drives=True`"):
        replace(task, drives=False)
    beaker = next(iter(task.start))
    on_a_stand = {"start": {beaker: OnBench(x=(0.3, 0.4), y=(0.0, 0.1))}, "drives": False}
    with pytest.raises(TaskError, match="its expert plays DriveTo: say `drives=True`"):
        replace(task, **on_a_stand)
    _, pick = task.steps[2].skills
    only_picks = replace(task, **on_a_stand, steps=(replace(task.steps[2], skills=(pick,)),))
    assert not only_picks.drives


def test_more_benches_than_every_room_has_are_refused_unless_a_room_is_chosen(monkeypatch):
    three = {glassware("beaker", "250 ml", name): OnSomeBench() for name in ("a", "b", "c")}
    with pytest.raises(NowhereToDriveError, match=r"starts on 3 benches .* choose a room="):
        begun_with(PICK, replace(canonical_task(Setting(PICK)), start=three), monkeypatch)
    assert canonical_task(Setting(PICK, room="analytical_0")).start.keys() == three.keys()


def test_the_shortest_way_from_a_bench_is_that_of_the_papers_disc_behind_it(env: LabEnv):
    env.reset(seed=0)
    world, (beaker,) = env.workcell.world, env.workcell.task.start
    dock, simulation, way = dock_for(world, beaker), env.workcell.simulation, Way.of(world)
    docks = (each for each in world.floor.docks if each.bench != dock.bench)
    start = max(docks, key=lambda each: math.dist(each.position, dock.position))
    (x, y), yaw = base_at(world)
    moved = (*(start.position - (x, y)), start.yaw - yaw)
    for joint, by in zip(("base_x", "base_y", "base_yaw"), moved, strict=True):
        simulation.data.joint(joint).qpos += by
    mujoco.mj_forward(simulation.scene.model, simulation.data)
    straight = sum(math.dist(each.position, each.before) for each in (start, dock))
    between = way.shortest(start.before, dock.before).length
    shortest = Journey(env.workcell.steps, world).columns(success=True)["m_shortest"]
    assert shortest == pytest.approx(straight + between, abs=0.01)


def test_a_single_step_is_measured_by_what_it_does(env: LabEnv):
    env.reset(seed=0)
    world, task = env.workcell.world, env.workcell.task
    dock = dock_for(world, next(iter(task.start)))
    navigate, face, pick = (Journey([step], world).columns(success=True) for step in task.steps)
    both = Journey(task.steps, world).columns(success=True)
    straight = math.dist(dock.before, dock.position)
    assert both["m_shortest"] == pytest.approx(navigate["m_shortest"] + straight, abs=2e-3)
    assert [one["m_off_dock"] is None for one in (navigate, face, pick, both)] == [
        True,
        *[False] * 3,
    ]
    assert face["m_shortest"] is pick["m_shortest"] is None


@pytest.mark.parametrize("nth", [0, 1])
def test_an_expert_whose_way_is_blocked_gives_up_and_stops_nothing(env: LabEnv, nth: int):
    class Blocked:
        def phases(self, world: World) -> Iterator[Phase]:
            here = world.gripper
            for _ in range(nth):
                yield Phase("rest", lambda world: here, 0.0, lambda *now: True)
            raise BlockedPlaceError("The place (1.00, 2.00) m is blocked")

    env.reset(seed=0)
    expert = env.workcell.expert([Blocked()])
    expert.start()
    for _ in range(5):
        env.step(expert.act())
    assert expert.failure == "The place (1.00, 2.00) m is blocked"
    assert not expert.finished
    assert env.workcell.progress.outcome == "running"


def test_every_episode_draws_a_room_and_tests_are_in_families_of_their_own():
    train, test = rooms_to_drive_in()
    assert len(train) + len(test) >= 40
    families = [{name.rpartition("_")[0] for name in names} for names in (train, test)]
    assert not families[0] & families[1]
    for split, names in (("train", train), ("id", train), ("ood", test)):
        setting = Setting(PICK, split=split)
        rooms = {draw_scenario(setting, seed).variation.room for seed in range(30)}
        assert rooms <= set(names)
        assert len(rooms) > 5
    assert draw_scenario(Setting(PICK, room="organic_7"), 0).variation.room is None


@pytest.mark.slow
def test_the_rooms_to_drive_in_are_those_with_two_benches():
    fit = [
        name
        for name in plan_names()
        if load_plan(name).work_places and len(load_room(name).ground(RIDGEBACK).benches) >= 2
    ]
    assert sorted(fit) == sorted((*rooms_to_drive_in()[0], *rooms_to_drive_in()[1]))


def test_what_is_behind_a_wall_is_neither_near_nor_at_hand():
    env = LabEnv(Setting("level5/navigate", obs="state", room="corridor_2"))
    env.reset(seed=0)
    world, (beaker,) = env.workcell.world, env.workcell.task.start
    simulation, (x, y) = env.workcell.simulation, world.pose(beaker).position_w[:2]
    for south, is_there in ((1.0, True), (-1.0, False)):  # half a metre to the north is a wall
        simulation.data.joint("base_x").qpos += x - base_at(world)[0][0]
        simulation.data.joint("base_y").qpos += y - south - base_at(world)[0][1]
        mujoco.mj_forward(simulation.scene.model, simulation.data)
        assert at_hand(beaker, share=AT_HAND).holds(world) == is_there
        assert beside(beaker, within=NEAR).holds(world) == is_there
    env.close()


@pytest.mark.slow
def test_no_wall_is_between_a_dock_and_what_is_reached_from_there():
    for name in rooms_to_drive_in()[1]:
        ground = load_room(name).ground(RIDGEBACK)
        for spot in ground.spots:
            for at in (spot.dock.position, spot.dock.before):
                assert not ground.floor.wall_between(at, spot.position[:2]), name


def test_things_stand_on_benches_of_their_own_and_the_base_where_it_gets_to_all(ground):
    one, other = glassware("beaker", "250 ml", "one"), glassware("beaker", "250 ml", "other")
    floor = ground.floor
    occupancy = Occupancy(floor.cells, floor.origin, floor.resolution)
    planner = PathPlanner.of(occupancy, RIDGEBACK.limits)
    for seed in range(5):
        rng = np.random.default_rng(seed)
        layout = sample_layout({one: OnSomeBench(), other: OnSomeBench()}, rng, ground)
        assert len({placement.bench for placement in layout.values()}) == 2
        assert all((placement.height == 0.0) == (placement.bench == BENCH)
                   for placement in layout.values())  # fmt: skip
        start = sample_base(ground, layout, rng)[:2]
        for placement in layout.values():
            there = (placement.x, placement.y)
            assert math.dist(start, there) > 2.0
            docks = [dock for dock in floor.docks if dock.bench == placement.bench]
            dock = min(docks, key=lambda dock: math.dist(dock.position, there))
            assert math.dist(dock.position, there) < 1.1
            assert planner.plan(start, dock.before).length > 0.5


def test_what_is_to_be_taken_from_above_stands_where_the_arm_reaches_it_from_above():
    base, draws = FETCH_BASE, [np.random.default_rng(seed) for seed in range(60)]
    ground = load_room("organic_7").ground(base)

    def docks(start: OnSomeBench) -> list[bool]:
        places = [start.sample(rng, {}, ground) for rng in draws]
        points = [np.array((place.x, place.y)) for place in places]
        near = base.ahead[0], base.above
        return [ground.floor.dock_at(point, base.arm[0], near) is not None for point in points]

    assert all(docks(OnSomeBench(from_above=True)))
    assert not all(docks(OnSomeBench()))


def test_one_has_to_drive_from_one_thing_to_the_other():
    """In `corridor_9` benches stand end to end: a third of all pairs of places are 1.5 m apart."""
    ground = load_room("corridor_9").ground(RIDGEBACK)
    beaker, plate = glassware("beaker", "250 ml"), TargetPlate("plate")
    start = {beaker: OnSomeBench(), plate: OnSomeBench()}
    for seed in range(200):
        layout = sample_layout(start, np.random.default_rng(seed), ground)
        first, second = layout[beaker], layout[plate]
        docks = [
            spot.dock.position
            for spot in ground.spots
            if math.dist(spot.position[:2], (second.x, second.y)) < 1e-9
        ]
        assert min(math.dist(dock, (first.x, first.y)) for dock in docks) >= 2.0


def test_a_base_is_no_faster_diagonally_and_turns_as_it_is_bidden(env):
    env.reset(seed=0)
    filtered = env.workcell.filter
    base = env.workcell.simulation.scene.robot.roles.base
    action = filtered.applied.copy()
    action[base] = (9.0, 9.0, 0.5)
    for _ in range(60):
        filtered(action, env.workcell.simulation.commands)
        applied = filtered.applied[base]
        assert np.hypot(*applied[:2]) <= RIDGEBACK.limits.speed + 1e-6


def test_a_way_is_that_of_the_steps_that_are_played(env):
    env.reset(seed=0)
    steps, world = env.workcell.task.steps, env.workcell.world
    whole, first = Journey(steps, world), Journey(steps[:1], world)
    assert first.columns(success=True)["m_shortest"] < whole.columns(success=True)["m_shortest"]
    picking = Journey(steps[2:], world).columns(success=True)
    assert picking["m_shortest"] is None
    assert picking["spl"] is None
    assert first.columns(success=False)["spl"] == 0.0


def test_an_instrument_stands_level_and_free_with_its_front_to_the_robot(ground):
    beaker, balance = glassware("beaker", "250 ml"), PrecisionBalance("balance")
    start = {beaker: OnSomeBench(), balance: OnSomeBench(instrument=True)}
    length, width, _ = balance.size
    wide = [spot for spot in ground.spots if spot.wide]
    assert 0 < len(wide) < len(ground.spots)
    for seed in range(5):
        layout = sample_layout(start, np.random.default_rng(seed), ground)
        assert list(layout) == [beaker, balance]
        placement = layout[balance]
        assert placement.bench != layout[beaker].bench
        here = (placement.x, placement.y)
        (dock, *_) = (spot.dock for spot in wide
                      if math.dist(spot.position[:2], here) < 1e-9
                      and spot.dock.yaw == placement.yaw)  # fmt: skip
        c, s = math.cos(dock.yaw), math.sin(dock.yaw)
        ahead = c * (here[0] - dock.position[0]) + s * (here[1] - dock.position[1])
        front = RIDGEBACK.size[0] / 2
        assert ahead - length / 2 > front  # all of it is on the bench, before which the base stands
        assert max(length, width) / 2 <= 0.17


def test_an_episode_begins_with_the_arm_stowed_and_the_base_where_it_was_drawn(env):
    places = []
    for seed in range(3):
        env.reset(seed=seed)
        world = env.workcell.world
        away = world.gripper.distance_to(world.robot_base @ world.stowed_hand)
        assert away < 0.002
        places.append(base_at(world)[0])
        (beaker,) = env.workcell.task.start
        assert dock_for(world, beaker).bench in world.touched_by(beaker.name)
    assert math.dist(places[0], places[1]) > 0.1


def test_the_stowed_arm_is_over_the_disc_that_plans_are_for(env):
    env.reset(seed=0)
    simulation, (here, _) = env.workcell.simulation, base_at(env.workcell.world)
    scene, data = simulation.scene, simulation.data
    parts = [scene.groups.index(name) for name in ("arm", "hand", "left_pad", "right_pad")]
    geoms = [g for g in np.flatnonzero(scene.model.geom_contype)
             if scene.group_of_geom[g] in parts]  # fmt: skip
    signs = np.array(np.meshgrid(*([-1.0, 1.0],) * 3)).reshape(3, -1).T
    for geom in geoms:
        box = scene.model.geom_aabb[geom]
        corners = (box[:3] + signs * box[3:]) @ data.geom_xmat[geom].reshape(3, 3).T
        assert np.hypot(*((corners + data.geom_xpos[geom])[:, :2] - here).T).max() < 0.6


def test_the_hand_keeps_its_place_on_the_base_while_that_drives(env):
    env.reset(seed=0)
    world, script = env.workcell.world, env.expert()
    script.start()
    off, fast = 0.0, 0.0
    while script.label != "face/dock":
        env.step(script.act())
        off = max(off, world.gripper.distance_to(world.robot_base @ world.stowed_hand))
        fast = max(fast, float(np.abs(world.base_velocity[:2]).max()))
    assert fast > 0.4
    assert off < 0.01
    assert not script.unexpected


def test_parking_ends_at_rest_where_it_was_bidden():
    goal, yaw = np.array([1.0, -0.5]), 2.0
    way = Parking(goal, yaw, RIDGEBACK.limits)
    position, heading, last = np.zeros(2), 0.0, np.zeros(2)
    most = RIDGEBACK.limits.acceleration / CONTROL_HZ
    for _ in range(10 * CONTROL_HZ):
        velocity = way.velocity(position, heading)
        c, s = math.cos(heading), math.sin(heading)
        over_floor = np.array([[c, -s], [s, c]]) @ velocity[:2]
        assert np.hypot(*(over_floor - last)) <= most + 1e-9
        position = position + over_floor / CONTROL_HZ
        heading, last = heading + velocity[2] / CONTROL_HZ, over_floor
    assert way.arrived(position, heading, within=0.005, within_rad=0.01)
    assert np.abs(last).max() < 0.01


def test_a_way_begins_where_the_base_stopped_short_of_its_room(env):
    env.reset(seed=0)
    way, (dock, *_, last) = Way.of(env.workcell.world), env.workcell.world.floor.docks
    ahead = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
    on = (dock.before + far * ahead for far in np.arange(0.0, 1.0, 0.01))
    short = next(point for point in on if not way.planner.free(point))
    assert way.path(short, last.before).length > 0.2


def test_what_is_poured_onto_the_deck_of_the_robot_is_spilled():
    env = LabEnv(Setting(TRANSPORT, obs="state", room="organic_7", particles=300))
    env.reset(seed=0)
    simulation = env.workcell.simulation
    base, liquid = env.workcell.world.mobile_base, simulation.liquid
    x, y = (axis.ravel() for axis in np.meshgrid([-0.3, -0.2, -0.1], [-0.2, 0.0, 0.2]))
    drops = np.column_stack([x, y, np.full(len(x), 0.45)])  # the deck is 0.31 m high
    there = base.position_w + drops @ base.rotation_w.T
    liquid.release(there, np.zeros_like(there), origin=0)
    still = env.workcell.filter.applied.copy()
    for _ in range(2 * CONTROL_HZ):
        env.step(still)
    assert simulation.account.spilled >= 0.9 * len(drops) * liquid.volume
