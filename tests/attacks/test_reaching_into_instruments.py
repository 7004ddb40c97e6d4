"""Attacks on tasks in which one drives to an instrument and reaches into it."""

import math

import numpy as np
import pytest

from attacks.arm import Actions, Arm
from attacks.plays import UNFINISHED, Play, outcome, roles, skilled, slow, until, until_phase
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.places import OnTop, OverBench
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills import BackOff, DriveTo, Face, Pick, Place
from labutopia_lerobot.tasks.level4.drying_beakers import MIDDLE, MOUTH, RIGHT
from labutopia_lerobot.tasks.level5.beyond.clear_bench import BASIN, PLACES
from labutopia_lerobot.world import CONTROL_HZ


@pytest.fixture(scope="module")
def oven() -> LabEnv:
    setting = Setting("level5/transport_to_oven", obs="state", liquid="off", room="organic_7")
    return LabEnv(setting)


def in_the_middle(env: LabEnv) -> Actions:
    """Set the beaker down elsewhere on the shelf."""
    yield from until_phase(env, "place/before", "6_place")
    beaker, _ = env.workcell.task.start
    yield from skilled(env, Place(beaker, MIDDLE, through=MOUTH, retreat=0.06))


def before_the_oven(env: LabEnv) -> Actions:
    """Let the beaker go on the bench below the oven."""
    yield from until_phase(env, "place/before", "6_place")
    arm, world = Arm(env), env.workcell.world
    ahead = 0.12 * world.robot_base.x_axis
    yield from arm.go(arm.pose.moved(*ahead), speed=0.1)
    beaker, _ = env.workcell.task.start
    down = world.bench_height - world.pose(beaker).position_w[2] + 0.002
    yield from arm.go(arm.pose.moved(z=down), speed=0.1)
    yield from arm.stay(1.0, env.workcell.simulation.scene.robot.max_opening)


def into_its_wall(env: LabEnv) -> Actions:
    """Bring the beaker in, and on to the right until it meets the wall."""
    yield from until_phase(env, "place/above", "6_place")
    arm, world = Arm(env), env.workcell.world
    deep = 0.20 * world.robot_base.x_axis
    yield from arm.go(arm.pose.moved(*deep), speed=0.1)
    right = -0.35 * world.robot_base.y_axis
    yield from arm.go(arm.pose.moved(*right), speed=0.1)


def from_above(env: LabEnv) -> Actions:
    """Let the beaker go a hand's breadth over the shelf."""
    yield from until_phase(env, "place/lower", "6_place")
    yield from Arm(env).stay(1.0, env.workcell.simulation.scene.robot.max_opening)


def held_in_the_oven(env: LabEnv) -> Actions:
    """Set it down and keep hold of it."""
    yield from until_phase(env, "place/open", "6_place")
    yield from Arm(env).stay(8.0)


def rolling_while_it_counts(env: LabEnv) -> Actions:
    """Do it all, and roll to and fro afterwards."""
    yield from until(env, lambda: env.workcell.progress.ever)
    for tick in range(10 * CONTROL_HZ):
        action = env.workcell.simulation.command.astype(np.float32)
        back = 0.06 * math.cos(math.pi * tick / CONTROL_HZ)
        action[roles(env).base] = (-back, 0.0, 0.02)
        yield action


def set_down_in_two_goes(env: LabEnv) -> Actions:
    """Stand it in the middle of the shelf first, then where it belongs."""
    yield from until_phase(env, "place/before", "6_place")
    beaker, _ = env.workcell.task.start
    yield from skilled(
        env,
        Place(beaker, MIDDLE, through=MOUTH, retreat=0.06),
        Pick(beaker, 0.05, support=None, hover=0.02),
        Place(beaker, RIGHT, hover=0.05, through=MOUTH, retreat=0.06),
    )


@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        slow(in_the_middle, UNFINISHED),
        slow(before_the_oven, {*UNFINISHED, "dropped", "broken"}),
        slow(into_its_wall, {"struck", "collided", "broken", "load_collided"}),
        slow(from_above, {"dropped", "broken"}),
        slow(held_in_the_oven, UNFINISHED),
        slow(rolling_while_it_counts, {*UNFINISHED, "collided"}),
        slow(set_down_in_two_goes, {"success"}),
    ],
)
def test_a_beaker_is_in_the_oven_that_stands_on_the_right_of_its_shelf(
    oven: LabEnv, play: Play, outcomes: set[str]
):
    assert outcome(oven, play, 0)["outcome"] in outcomes


@pytest.fixture(scope="module")
def cupboard() -> LabEnv:
    return LabEnv(Setting("level5/fetch_reagent", obs="state", room="organic_7"))


def torn_open(env: LabEnv) -> Actions:
    """Grip the handle, and pull the door open in a third of a second."""
    yield from until_phase(env, "open/move")
    arm, world = Arm(env), env.workcell.world
    back = -0.35 * world.robot_base.x_axis + 0.10 * world.robot_base.y_axis
    yield from arm.go(arm.pose.moved(*back), speed=1.0)
    yield from arm.stay(2.0)


def into_the_door(env: LabEnv) -> Actions:
    """Take the bottle, and swing it against the open door."""
    yield from until_phase(env, "carry/past", "4_take")
    arm, world = Arm(env), env.workcell.world
    out = -0.30 * world.robot_base.x_axis
    yield from arm.go(arm.pose.moved(*out), speed=0.15)
    aside = 0.45 * world.robot_base.y_axis
    yield from arm.go(arm.pose.moved(*aside), speed=0.15)


def dropped_before_the_cupboard(env: LabEnv) -> Actions:
    """Let the bottle go as soon as it is out."""
    yield from until_phase(env, "driveto/stow", "5_navigate")
    yield from Arm(env).stay(2.0, env.workcell.simulation.scene.robot.max_opening)


def beside_the_plate(env: LabEnv) -> Actions:
    """Set the bottle down on the bench with the plate."""
    yield from until_phase(env, "place/lower", "7_place")
    _, bottle, plate = env.workcell.task.start
    arm, world = Arm(env), env.workcell.world
    aside = 0.20 * world.robot_base.y_axis
    yield from arm.go(arm.pose.moved(*aside), speed=0.15)
    down = world.stood(plate).position_w[2]
    down += 0.001 - world.pose(bottle).position_w[2]
    yield from arm.go(arm.pose.moved(z=down), speed=0.05)
    yield from arm.stay(1.0, env.workcell.simulation.scene.robot.max_opening)
    yield from arm.go(arm.pose.advanced(-0.15), speed=0.15)


def put_down_on_the_way(env: LabEnv) -> Actions:
    """Stand the bottle on the bench below the cupboard first, and take it from there."""
    yield from until_phase(env, "backoff/back", "5_navigate")
    cupboard, bottle, plate = env.workcell.task.start
    out = BackOff(bottle, past=cupboard.door)
    before = OverBench("before the cupboard", ahead=0.45, left=-0.15)
    yield from skilled(
        env,
        Place(bottle, before),
        Pick(bottle, 0.15, support=None, hover=0.02),
        out,
        DriveTo(plate, bottle),
        Face(plate, bottle),
        Place(bottle, OnTop(plate)),
    )


@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        slow(torn_open, {"slammed", "collided", "broken"}),
        slow(into_the_door, {"struck", "collided", "broken", "load_collided"}),
        slow(dropped_before_the_cupboard, {"dropped", "broken", "knocked_over"}),
        slow(beside_the_plate, {*UNFINISHED, "load_collided"}),
        slow(put_down_on_the_way, {"success"}),
    ],
)
def test_a_bottle_is_fetched_that_stands_on_the_plate(
    cupboard: LabEnv, play: Play, outcomes: set[str]
):
    assert outcome(cupboard, play, 0)["outcome"] in outcomes


@pytest.fixture(scope="module")
def sink() -> LabEnv:
    return LabEnv(Setting("level5/clear_bench", obs="state", room="organic_7"))


def let_go_over_the_basin(env: LabEnv) -> Actions:
    """Drop the beaker into the sink."""
    yield from until_phase(env, "place/lower", "6_place")
    yield from Arm(env).stay(1.0, env.workcell.simulation.scene.robot.max_opening)


def into_the_side_of_the_basin(env: LabEnv) -> Actions:
    """Set the beaker down, and push it sideways along the floor into the wall."""
    yield from until_phase(env, "place/open", "6_place")
    arm, world = Arm(env), env.workcell.world
    left = 0.30 * world.robot_base.y_axis
    yield from arm.go(arm.pose.moved(*left), speed=0.2)


def one_is_left(env: LabEnv) -> Actions:
    """Carry two of the three away, and wait."""
    yield from until_phase(env, "driveto/stow", "13_navigate")


def kept_in_the_hand(env: LabEnv) -> Actions:
    """Set the last one down and keep hold of it."""
    yield from until_phase(env, "place/open", "18_place")
    yield from Arm(env).stay(8.0)


def elsewhere_in_the_basin(env: LabEnv) -> Actions:
    """Stand the first one in the middle, move it to the side, and go on as anybody would."""
    yield from until_phase(env, "place/above", "6_place")
    first, *_ = env.workcell.task.start
    yield from skilled(
        env,
        Place(first, BASIN, hover=0.30, retreat=0.30, deep=True),
        Pick(first, 0.02, support=None, hover=0.15, approach="deep"),
        Place(first, PLACES[0], hover=0.05, retreat=0.30, deep=True),
    )
    rest = [skill for step in env.workcell.task.steps[6:] for skill in step.skills]
    yield from skilled(env, *rest)


@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        slow(let_go_over_the_basin, {"dropped", "broken"}),
        slow(into_the_side_of_the_basin, {"collided", "broken", "knocked_over"}),
        slow(one_is_left, UNFINISHED),
        slow(kept_in_the_hand, UNFINISHED),
        slow(elsewhere_in_the_basin, {"success"}),
    ],
)
def test_a_bench_is_clear_when_all_three_stand_in_the_sink(
    sink: LabEnv, play: Play, outcomes: set[str]
):
    assert outcome(sink, play, 0)["outcome"] in outcomes
