"""Attacks on tasks in which one drives: through benches, past the goal, with a load into things."""

import math
from itertools import count, islice

import numpy as np
import pytest

from attacks.arm import Actions, Arm
from attacks.plays import (
    UNFINISHED,
    Play,
    latched,
    outcome,
    reached,
    roles,
    skilled,
    slow,
    until,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.navigation.tracking import PathTracker
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills import DriveTo, Face, Pick, Place
from labutopia_lerobot.skills.way import Way, base_at, dock_for
from labutopia_lerobot.world import CONTROL_HZ, HAND, LEFT_PAD, RIGHT_PAD, FloatArray

PICK, TRANSPORT = "level5/navigation_and_manipulation", "level5/transport_between_areas"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(Setting(PICK, obs="state", room="organic_7"))


@pytest.fixture(scope="module")
def carrying() -> LabEnv:
    return LabEnv(Setting(TRANSPORT, obs="state", liquid="off", room="organic_7"))


def moving(env: LabEnv, velocity_b: FloatArray) -> np.ndarray:
    """Return the action that bids the base a velocity and leaves the arm where it is bidden."""
    action = env.workcell.simulation.command.astype(np.float32)
    action[roles(env).base] = velocity_b
    return action


def straight_to_the_beaker(env: LabEnv) -> Actions:
    """Drive as the crow flies, through whatever is there."""
    world, (beaker, *_) = env.workcell.world, env.workcell.task.start
    while True:
        (x, y), yaw = base_at(world)
        way = world.pose(beaker).position_w[:2] - (x, y)
        c, s = math.cos(yaw), math.sin(yaw)
        ahead = 0.6 * way / np.hypot(*way)
        yield moving(env, np.array([c * ahead[0] + s * ahead[1], c * ahead[1] - s * ahead[0], 0]))


def without_leaving_where_it_is(env: LabEnv) -> Actions:
    """Pick, from metres away: the arm stretches, and nothing comes of it."""
    (beaker,) = env.workcell.task.start
    world, arm = env.workcell.world, Arm(env)
    over = world.pose(beaker).position_w
    towards = arm.pose.position_w + 0.4 * (over - arm.pose.position_w)
    yield from islice(arm.go(arm.pose.moved(*(0.2 * (towards - arm.pose.position_w)))), 150)
    yield from arm.stay(5.0, 0.0)


def past_it(env: LabEnv) -> Actions:
    """Drive as the expert does, and turn round and round where that would halt."""
    yield from until_phase(env, "face/turn")
    yield from (moving(env, np.array([0.0, 0.0, 0.5])) for _ in range(10 * CONTROL_HZ))


def turning_on(env: LabEnv) -> Actions:
    """Do the task, and roll back and forth with the beaker while it counts."""
    yield from until(env, lambda: env.workcell.progress.ever)
    for tick in count():
        sideways = 0.06 * math.sin(2.0 * math.pi * tick / CONTROL_HZ)
        yield moving(env, np.array([-0.05 if tick < CONTROL_HZ else 0.0, 0.0, sideways]))


def away_with_it(env: LabEnv) -> Actions:
    """Lift the beaker by the arm, and lower it again by driving it into the bench."""
    yield from until(env, lambda: "3_pick/gripped" in latched(env))
    yield from (moving(env, np.array([0.3, 0.0, 0.0])) for _ in range(4 * CONTROL_HZ))


def into_a_wall(env: LabEnv) -> Actions:
    """Carry the beaker on the outstretched arm, sideways along the bench and into what is there."""
    yield from until_phase(env, "driveto/stow", "4_navigate")
    back = np.array([-0.25, 0.0, 0.0])
    yield from (moving(env, back) for _ in range(CONTROL_HZ))
    yield from (moving(env, np.array([0.0, 0.6, 0.0])) for _ in range(25 * CONTROL_HZ))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        (straight_to_the_beaker, {"collided"}),
        (without_leaving_where_it_is, {*UNFINISHED, "collided"}),
        (past_it, UNFINISHED),
        (turning_on, {*UNFINISHED, "collided", "broken"}),
        slow(away_with_it, {"collided", "broken", "load_collided", "dropped"}),
    ],
)
def test_a_person_would_fail(env: LabEnv, play: Play, outcomes: set[str]):
    assert outcome(env, play, 0)["outcome"] in outcomes


@pytest.mark.slow
def test_who_never_halts_has_not_arrived(env: LabEnv):
    def by(env: LabEnv) -> Actions:
        yield from until_phase(env, "driveto/drive")
        script = env.expert()
        script.start()
        while not script.finished:
            action = script.act()
            if np.abs(action[roles(env).base]).max() < 0.05:
                action[roles(env).base] = (0.0, 0.0, 0.3)
            yield action

    assert reached(outcome(env, by, 0)) == []


@pytest.mark.slow
def test_a_load_that_runs_into_something_ends_the_episode(carrying: LabEnv):
    ended = outcome(carrying, into_a_wall, 0)["outcome"]
    assert ended in {"collided", "broken", "load_collided", "dropped"}


def into_furniture_in_a_loose_grip(env: LabEnv) -> Actions:
    """Hold the beaker no firmer than it takes, touch a safety cabinet with it, and drive back."""
    (beaker, plate), world = env.workcell.task.start, env.workcell.world
    yield from skilled(env, DriveTo(beaker), Face(beaker), Pick(beaker, 0.25, support=None))
    yield from skilled(env, DriveTo(plate, beaker))

    def loosely(velocity_b: tuple[float, float, float]) -> np.ndarray:
        action = moving(env, np.array(velocity_b))
        action[roles(env).gripper] = world.gripper_opening - 0.0003
        return action

    yield from (loosely((0.0, 0.0, 0.0)) for _ in range(CONTROL_HZ))
    while abs(off := math.remainder(math.pi - base_at(world)[1], 2 * math.pi)) > 0.01:
        yield loosely((0.0, 0.0, float(np.clip(1.5 * off, -0.5, 0.5))))
    yield from (loosely((0.0, 0.0, 0.0)) for _ in range(CONTROL_HZ // 2))
    arm = Arm(env)
    stretched, loose = arm.pose.moved(x=-0.25), world.gripper_opening - 0.0003
    yield from arm.go(stretched, speed=0.2, opening=loose)
    while world.touched_by(beaker.name) <= {LEFT_PAD, RIGHT_PAD, HAND}:
        yield loosely((0.04, 0.0, 0.0))
    yield from (loosely((-0.12, 0.0, 0.0)) for _ in range(CONTROL_HZ))


@pytest.mark.slow
def test_a_load_in_a_loose_grip_that_runs_into_something_ends_the_episode(carrying: LabEnv):
    play = into_furniture_in_a_loose_grip
    assert outcome(carrying, play, 0)["outcome"] == "load_collided"


def dragged_along_the_bench(env: LabEnv) -> Actions:
    """Grip the beaker where it stands, and pull it over the bench by driving."""
    yield from until(env, lambda: "3_pick/gripped" in latched(env))
    yield from (moving(env, np.array([0.0, 0.1, 0.0])) for _ in range(2 * CONTROL_HZ))


@pytest.mark.slow
def test_a_load_is_not_driven_against_the_bench_that_it_stands_on(carrying: LabEnv):
    assert outcome(carrying, dragged_along_the_bench, 0)["outcome"] == "load_collided"


def driven(env: LabEnv, goal: FloatArray, *, backwards: bool) -> Actions:
    """Drive along a planned path, the front or the back ahead."""
    world = env.workcell.world
    way = Way.of(world)
    path = way.path(base_at(world)[0], goal)
    tracker, sign = PathTracker(path, way.limits), -1.0 if backwards else 1.0
    while not tracker.arrived(base_at(world)[0], within=0.02):
        position, yaw = base_at(world)
        forward, left, turning = tracker.velocity(position, yaw + math.pi * backwards)
        yield moving(env, np.array([sign * forward, sign * left, turning]))
    yield from (moving(env, np.zeros(3)) for _ in range(CONTROL_HZ))


def backwards(env: LabEnv) -> Actions:
    """Drive to the bench with the back ahead."""
    (beaker,) = env.workcell.task.start
    dock = dock_for(env.workcell.world, beaker)
    yield from driven(env, dock.before, backwards=True)
    yield from skilled(env, Face(beaker), Pick(beaker, 0.25, support=None))


def by_a_detour(env: LabEnv) -> Actions:
    """Drive to the far end of the room first."""
    (beaker,) = env.workcell.task.start
    world = env.workcell.world
    docks = [dock.before for dock in world.floor.docks]
    here = world.pose(beaker).position_w[:2]
    yield from driven(env, max(docks, key=lambda at: math.dist(at, here)), backwards=False)
    yield from skilled(env, DriveTo(beaker), Face(beaker), Pick(beaker, 0.25, support=None))


@pytest.mark.parametrize("play", [backwards, pytest.param(by_a_detour, marks=pytest.mark.slow)])
def test_a_person_would_pass(env: LabEnv, play: Play):
    assert outcome(env, play, 0)["outcome"] == "success"


def held_on_the_pan(env: LabEnv) -> Actions:
    """Set the beaker down on the balance and do not let go: it weighs the hand too."""
    yield from until_phase(env, "place/open", "6_weigh")
    yield from Arm(env).stay(8.0)


def beside_the_pan(env: LabEnv) -> Actions:
    """Lower the beaker into the console of the balance instead of onto its pan."""
    yield from until_phase(env, "place/lower", "6_weigh")
    arm, world = Arm(env), env.workcell.world
    _, balance = env.workcell.task.start
    front = -0.19 * world.pose(balance).x_axis
    yield from arm.go(arm.pose.moved(*front), speed=0.15)
    yield from arm.go(arm.pose.moved(z=-0.20), speed=0.1)


def rolling_on_with_the_scale_settled(env: LabEnv) -> Actions:
    """Weigh it, and roll to and fro while it counts."""
    yield from until(env, lambda: env.workcell.progress.ever)
    for tick in range(10 * CONTROL_HZ):
        back = 0.06 * math.cos(math.pi * tick / CONTROL_HZ)
        yield moving(env, np.array([-back, 0.0, 0.02]))


def thrown_onto_it(env: LabEnv) -> Actions:
    """Let the beaker go a hand's breadth above the pan."""
    yield from until_phase(env, "place/lower", "6_weigh")
    arm = Arm(env)
    yield from arm.stay(1.0, env.workcell.simulation.scene.robot.max_opening)


def weighed_twice(env: LabEnv) -> Actions:
    """Weigh it, lift it off before that has counted, and weigh it again."""
    yield from until_phase(env, "place/done")
    beaker, balance = env.workcell.task.start
    pan = balance.pan.place
    yield from skilled(env, Pick(beaker, 0.05, support=None), Place(beaker, pan))
    # A reading of the balance settles more slowly than a play is waited for.
    yield from Arm(env).stay(3.0, env.workcell.simulation.scene.robot.max_opening)


@pytest.fixture(scope="module")
def weighing() -> LabEnv:
    return LabEnv(Setting("level5/weigh_across_rooms", obs="state", room="organic_7"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        (held_on_the_pan, UNFINISHED),
        (beside_the_pan, {"load_collided", "broken"}),
        (rolling_on_with_the_scale_settled, {*UNFINISHED, "collided"}),
        (thrown_onto_it, {"dropped", "broken"}),
        (weighed_twice, {"success"}),
    ],
)
def test_a_beaker_is_weighed_that_stands_alone_on_the_pan(
    weighing: LabEnv, play: Play, outcomes: set[str]
):
    assert outcome(weighing, play, 0)["outcome"] in outcomes
