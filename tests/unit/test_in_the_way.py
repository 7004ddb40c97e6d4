"""What is in a robot's way and on no map: where it is put, what people do, what the expert does."""

import math

import numpy as np
import pytest

from labutopia_lerobot.checks.playing import expert, play
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import OnSomeBench, Placement, sample_base, sample_layout
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.path_planner import PathPlanner
from labutopia_lerobot.robots import FETCH, RIDGEBACK_PANDA
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.robots.robot import Robot
from labutopia_lerobot.scenario import draw_scenario
from labutopia_lerobot.scenario.in_the_way import SETS, place_in_the_way
from labutopia_lerobot.scenes import LABORATORY, load_room
from labutopia_lerobot.scenes.ground import Ground
from labutopia_lerobot.scenes.passer_by import RADIUS, WAY, PasserBy
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

TASK = "level5/navigate"
FLOOR = -LABORATORY.bench.height


@pytest.fixture(scope="module")
def ground() -> Ground:
    return load_room("organic_7").ground(RIDGEBACK)


def walking(
    x: float, towards: float, robot: Robot = RIDGEBACK_PANDA, base_pose: FloatArray | None = None
) -> tuple[Simulation, SimulatedWorld, PasserBy]:
    """Return somebody who begins to walk 1.9 m to the right of a base, from an x, at a yaw."""
    person = PasserBy("passer_by")
    simulation = Simulation(compile_scene([person], robot, LABORATORY, VESSEL_VIEW))
    place = Placement(x, -1.9, towards, FLOOR)
    simulation.reset({person: place}, rng=np.random.default_rng(3), base_pose=base_pose)
    return simulation, SimulatedWorld(simulation), person


def ways(
    simulation: Simulation, world: SimulatedWorld, person: PasserBy, seconds: int
) -> tuple[list[float], set[str]]:
    """Return every y where somebody was for a time, and what has touched them."""
    places: list[float] = []
    touched: set[str] = set()
    for _ in range(seconds * CONTROL_HZ):
        simulation.step(simulation.command)
        places.append(float(world.pose(person).position_w[1]))
        touched |= world.touched_by(person.name)
    return places, touched


@pytest.mark.parametrize("name", SETS)
def test_it_is_on_free_floor_away_from_where_one_works_and_shuts_nothing_off(ground, name):
    beaker, floor = glassware("beaker", "250 ml"), ground.floor
    found = 0
    for seed in range(6):
        rng = np.random.default_rng(seed)
        layout = sample_layout({beaker: OnSomeBench()}, rng, ground)
        pose = sample_base(ground, layout, rng)
        placed = place_in_the_way(SETS[name], layout, RIDGEBACK, ground, pose, FLOOR, rng)
        if placed is None:
            continue
        found += 1
        thing = np.array([layout[beaker].x, layout[beaker].y])
        dock = floor.dock_at(thing, RIDGEBACK.arm[0], RIDGEBACK.ahead)
        occupancy = Occupancy(floor.cells, floor.origin, floor.resolution)
        marked, clear = occupancy.copy(), occupancy.clearance()
        for piece, at in placed.items():
            along = np.array([math.cos(at.yaw), math.sin(at.yaw)])
            ends = [0.0, WAY / 2, WAY] if isinstance(piece, PasserBy) else [0.0]
            for far in ends:
                point = np.array([at.x, at.y]) + far * along
                assert clear[occupancy.cell(*point)] >= piece.footprint_radius
                for kept in (pose[:2], dock.before, dock.position):
                    assert math.dist(point, kept) > piece.footprint_radius + 0.6
            assert at.height == FLOOR
            marked.add_disc(np.array([at.x, at.y]), piece.footprint_radius)
        assert PathPlanner.of(marked, RIDGEBACK.limits).plan(pose[:2], dock.before).length > 0.5
    assert found >= 3


def test_a_disc_on_a_map_takes_every_cell_that_it_reaches_into():
    occupancy = Occupancy.empty((2.0, 2.0))
    occupancy.add_disc(np.array([1.0, 1.0]), 0.3)
    away = np.hypot(*(occupancy.middles(occupancy.cells != 0) - 1.0).T)
    assert away.max() < 0.3 + 0.05
    free = np.hypot(*(occupancy.middles(occupancy.cells == 0) - 1.0).T)
    assert free.min() > 0.3


def test_a_person_walks_to_and_fro_and_rests():
    simulation, world, person = walking(-1.1, 0.0)  # past base and bench
    places = []
    for _ in range(25 * CONTROL_HZ):
        simulation.step(simulation.command)
        places.append(world.pose(person).position_w[0])
    steps = np.diff(places)
    assert np.ptp(places) == pytest.approx(WAY, abs=0.25)
    assert 0.35 < np.abs(steps).max() * CONTROL_HZ < 0.75
    assert (steps < -0.005).any()
    assert (steps > 0.005).any()
    assert (np.abs(steps) < 1e-4).sum() > CONTROL_HZ


def test_a_person_stops_before_a_base_and_turns_round():
    simulation, world, person = walking(-0.7, math.pi / 2)  # straight into its side
    side = -RIDGEBACK.size[1] / 2
    places, touched = ways(simulation, world, person, seconds=20)
    assert side - 1.0 < max(places) + RADIUS < side - 0.2
    assert min(places[int(np.argmax(places)) :]) < max(places) - 0.3
    assert not touched


def test_a_person_stops_before_an_arm_that_is_folded_beyond_the_base():
    base = np.array([-0.5, 0.0, math.pi])  # its front at -0.78 m, the hand at -0.97 m
    simulation, world, person = walking(-1.12, math.pi / 2, FETCH, base)
    _, touched = ways(simulation, world, person, seconds=20)
    assert not touched


@pytest.mark.parametrize(
    ("aside", "beyond"),
    [(0.0, RADIUS + 0.4), (-0.16 - RIDGEBACK.size[0] / 2, 0.22)],
    ids=["ahead", "beside its shoulder"],
)
def test_a_person_does_not_stop_for_what_is_beyond_the_end_of_its_way(aside, beyond):
    base = np.array([-0.7 + aside, 0.1 + beyond + RIDGEBACK.size[1] / 2, 0.0])
    simulation, world, person = walking(-0.7, math.pi / 2, base_pose=base)
    places, touched = ways(simulation, world, person, seconds=10)
    assert max(places) == pytest.approx(-1.9 + WAY, abs=0.03)
    assert not touched


def test_a_person_stops_for_what_is_just_beyond_the_end_of_its_way():
    base = np.array([-0.7, 0.1 + RADIUS + 0.01 + RIDGEBACK.size[1] / 2, 0.0])
    simulation, world, person = walking(-0.7, math.pi / 2, base_pose=base)
    places, touched = ways(simulation, world, person, seconds=10)
    assert max(places) < -1.9 + WAY - 0.3
    assert not touched


def test_nobody_is_in_the_way_unless_asked_for():
    assert draw_scenario(Setting(TASK), 0).variation.in_the_way == ()
    drawn = {
        draw_scenario(Setting(TASK, axes=("dynamic",)), seed).drawn["dynamic"] for seed in range(9)
    }
    assert drawn == {"stool", "passer_by"}
    ood = draw_scenario(Setting(TASK, split="ood", axes=("dynamic",)), 0)
    assert [piece.walks for piece in ood.variation.in_the_way] == [False, True]


@pytest.mark.parametrize("split", ["id", pytest.param("ood", marks=pytest.mark.slow)])
def test_the_expert_gets_past_them_and_touches_none(split):
    setting = Setting(TASK, obs="state", split=split, axes=("dynamic",), room="organic_7")
    with LabEnv(setting) as env:
        env.reset(seed=100100)
        world, expert, over, near = env.workcell.world, env.expert(), False, math.inf
        expert.start()
        while not over:
            _, _, terminated, truncated, info = env.step(expert.act())
            over = terminated or truncated
            here = world.mobile_base.position_w
            near = min(near, *(math.dist(world.pose(other).position_w[:2], here[:2])
                               for other in world.in_the_way))  # fmt: skip
    assert info["outcome"] == "success"
    assert not expert.unexpected
    assert near > 0.7  # the base is 0.62 m wide where it is widest, a person 0.25 m


def test_the_expert_goes_on_from_beside_one_who_waits_for_it():
    task = "level5/navigation_and_manipulation"
    with LabEnv(Setting(task, obs="state", robot="fetch", axes=("dynamic",))) as env:
        _, info = play(env, expert, 100026).trace[-1]  # both stood for ever, 0.96 m apart
    assert info["outcome"] == "success"


def test_two_who_wait_for_each_other_do_not_stand_for_ever():
    with LabEnv(Setting("level5/clear_bench", obs="state", axes=("dynamic",))) as env:
        env.reset(seed=100028)
        (person,), expert = env.workcell.world.in_the_way, env.expert()
        expert.start()
        for _ in range(30 * CONTROL_HZ):  # for 110 s each stood where the other wanted to go
            _, _, _, _, info = env.step(expert.act())
            assert not env.workcell.world.touched_by(person.name)
    assert math.isfinite(info["substeps"]["1_navigate/arrived"])


def test_a_base_does_not_edge_towards_one_who_stands():
    task = "level5/transport_between_areas"
    with LabEnv(Setting(task, obs="state", axes=("dynamic",))) as env:
        env.reset(seed=100072)
        (person,), expert = env.workcell.world.in_the_way, env.expert()
        expert.start()
        for _ in range(12 * CONTROL_HZ):  # after 10 s a corner met somebody, 5 cm by 5 cm
            env.step(expert.act())
            assert not env.workcell.world.touched_by(person.name)


def test_a_person_stops_before_a_finger_that_reaches_in_from_the_side():
    setting = Setting("level5/weigh_across_rooms", obs="state", robot="fetch", axes=("dynamic",))
    with LabEnv(setting) as env:
        env.reset(seed=100043)
        (person,), expert = env.workcell.world.in_the_way, env.expert()
        expert.start()
        for _ in range(8 * CONTROL_HZ):  # after 6.5 s a shoulder met a finger of one who stood
            env.step(expert.act())
            assert not env.workcell.world.touched_by(person.name)


@pytest.mark.parametrize("split", ["id", "ood"])
def test_who_drives_into_them_has_collided(split):
    setting = Setting(TASK, obs="state", split=split, axes=("dynamic",), room="organic_7")
    with LabEnv(setting) as env:
        env.reset(seed=100100)
        world, over = env.workcell.world, False
        other, base = world.in_the_way[0], RIDGEBACK_PANDA.roles.base
        while not over:
            action = env.workcell.simulation.command
            way = world.pose(other).position_w - world.mobile_base.position_w
            ahead = world.mobile_base.rotation_w.T @ (0.6 * way / np.linalg.norm(way[:2]))
            action[base] = (ahead[0], ahead[1], 0.0)
            _, _, terminated, truncated, info = env.step(action.astype(np.float32))
            over = terminated or truncated
    assert info["outcome"] == "collided"
