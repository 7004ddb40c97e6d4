"""Attacks on setting down, and odd ways to set down that are right."""

import math
from dataclasses import replace
from itertools import chain

import numpy as np
import pytest

from adversary import Beside
from attacks.arm import Actions, Arm
from attacks.plays import (
    SEEDS,
    UNFINISHED,
    Play,
    begun,
    outcome,
    reached,
    skilled,
    slow,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Place
from labutopia_lerobot.task import TaskError

pytestmark = pytest.mark.slow


def gap_of(env: LabEnv) -> float:
    """Return how high a beaker is above what it is to stand on [m]."""
    skill = placing(env)
    world = env.workcell.world
    return float(world.pose(skill.thing).position_w[2] - skill.on.position_w(world)[2])


def placing(env: LabEnv) -> Place:
    """Return the first of the task's skills that sets something down."""
    return next(skill for skill in env.workcell.task.skills if isinstance(skill, Place))


def release(env: LabEnv, arm: Arm) -> Actions:
    """Open the hand and draw it back."""
    wide = env.workcell.world.robot.max_opening
    yield from chain(arm.stay(0.7, wide), arm.go(arm.pose.advanced(-0.15), speed=0.15))


def let_go_above(height: float, aside: float = 0.0) -> Play:
    """Let a beaker go above what it is to stand on, or above a point beside that."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "place/lower")
        arm = Arm(env)
        beside = arm.pose.moved(x=aside)
        yield from chain(arm.go(beside, speed=0.1), arm.stay(0.3))
        yield from arm.go(beside.moved(z=0.01 - gap_of(env)), speed=0.1)
        yield from arm.stay(0.3)
        yield from arm.go(arm.pose.moved(z=height - gap_of(env)), speed=0.05)
        yield from chain(arm.stay(0.5), release(env, arm))

    return play


def slam(env: LabEnv) -> Actions:
    """Set a beaker down at one metre per second."""
    yield from until_phase(env, "place/lower")
    arm = Arm(env)
    yield from arm.go(arm.pose.moved(z=-0.03 - gap_of(env)), speed=1.0)


def lean_on_it(env: LabEnv) -> Actions:
    """Set a beaker down and press it onto what it stands on with the weight of the arm."""
    yield from until_phase(env, "place/settle")
    arm = Arm(env)
    here = arm.pose
    yield from chain(arm.go(here.moved(z=-0.05), speed=0.05), arm.stay(0.5))
    yield from chain(arm.go(here, speed=0.05), arm.stay(0.3), release(env, arm))


def push_the_target(env: LabEnv) -> Actions:
    """Shove the plate along the bench with the beaker, then set the beaker down on it there."""
    yield from until_phase(env, "place/lower")
    world, arm, skill = env.workcell.world, Arm(env), placing(env)
    plate = skill.on.of
    before = world.pose(plate)
    level = arm.pose
    far = 0.075 + skill.thing.footprint_radius + 0.02
    yield from arm.go(level.moved(y=far), speed=0.25)
    low = world.bench_height + 0.003 - world.pose(skill.thing).position_w[2]
    yield from chain(arm.go(arm.pose.moved(z=low), speed=0.1), arm.stay(0.3))
    yield from arm.go(arm.pose.moved(y=-0.17), speed=0.1)
    assert world.pose(plate).distance_to(before) > 0.02
    yield from arm.go(arm.pose.moved(z=0.12), speed=0.2)
    yield from skilled(env, skill)


def push_it_over(env: LabEnv) -> Actions:
    """Set a beaker down, let go, and push it over with the back of the hand in leaving."""
    yield from until_phase(env, "place/retract")
    arm = Arm(env)
    there = arm.pose.advanced(-0.15)
    yield from arm.go(there, speed=0.2)
    shut = chain(arm.go(there.moved(z=0.04), speed=0.3, opening=0.0), arm.stay(0.2))
    yield from chain(shut, arm.go(arm.pose.advanced(0.25), speed=0.4))


def drag_it_off(env: LabEnv) -> Actions:
    """Set a beaker down as asked, and drag it 6 cm aside in the same grip before letting go."""
    yield from until_phase(env, "place/open")
    arm = Arm(env)
    yield from arm.go(arm.pose.moved(y=-0.06), speed=0.1)
    yield from chain(arm.stay(0.3), release(env, arm))


def on_the_bench_beside(env: LabEnv) -> Actions:
    """Set a beaker down on the bench beside the plate."""
    skill = placing(env)
    skills = env.workcell.task.skills
    aside = Beside(skill.thing, ahead=0.0)
    yield from skilled(env, *skills[: skills.index(skill)], replace(skill, on=aside))


def let_go_on_the_move(env: LabEnv) -> Actions:
    """Let a beaker go on the plate while the hand still moves sideways at a third of a m/s."""
    yield from until_phase(env, "place/settle")
    arm = Arm(env)
    wide = env.workcell.world.robot.max_opening
    yield from arm.go(arm.pose.moved(z=0.002), speed=0.05)
    swing = list(arm.go(arm.pose.moved(y=-0.10), speed=0.32))
    for step, action in enumerate(swing):
        action[-1] = wide if step > 3 else action[-1]
        yield action
    yield from chain(arm.stay(0.5, wide), arm.go(arm.pose.advanced(-0.15), speed=0.15))


def put_elsewhere(ahead: float) -> Play:
    """Do all as asked, but set the vessel down this far ahead of where it stood [m]."""

    def play(env: LabEnv) -> Actions:
        skill = placing(env)
        on = Beside(skill.thing, ahead=ahead)
        skills = [replace(one, on=on) if one is skill else one for one in env.workcell.task.skills]
        yield from skilled(env, *skills)

    return play


def turned_about(degrees: float) -> Play:
    """Set a beaker down turned about the vertical, which nobody minds."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "place/lower")
        world, arm = env.workcell.world, Arm(env)
        hand, cup = arm.pose, world.pose(placing(env).thing)
        angle = math.radians(degrees)
        cosine, sine = math.cos(angle), math.sin(angle)
        about = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        axis = cup.position_w * (1.0, 1.0, 0.0) + hand.position_w * (0.0, 0.0, 1.0)
        there = type(hand)(axis + about @ (hand.position_w - axis), about @ hand.rotation_w)
        yield from chain(arm.go(there, speed=0.1), arm.stay(0.3))
        yield from chain(arm.go(there.moved(z=0.01 - gap_of(env)), speed=0.1), arm.stay(0.3))
        yield from chain(arm.go(arm.pose.moved(z=-0.011), speed=0.03), arm.stay(0.3))
        yield from release(env, arm)

    return play


def second_thoughts(env: LabEnv) -> Actions:
    """Set a beaker down, lift it once more, and set it down again."""
    yield from until_phase(env, "place/open")
    arm = Arm(env)
    yield from chain(arm.go(arm.pose.moved(z=0.10), speed=0.15), arm.stay(0.5))
    yield from skilled(env, placing(env))


def high_over_the_plate(env: LabEnv) -> Actions:
    """Carry a beaker 20 cm higher than need be, and wait there for two seconds."""
    yield from until_phase(env, "place/lower")
    arm = Arm(env)
    yield from chain(arm.go(arm.pose.moved(z=0.20), speed=0.25), arm.stay(2.0))
    yield from skilled(env, placing(env))


FAILING = (
    ("level1/place", let_go_above(0.006), "broken"),
    ("level1/place", let_go_above(0.012), "broken or dropped"),
    ("level1/place", let_go_above(0.020), "broken or dropped"),
    ("level1/place", slam, "broken or dropped"),
    slow("level2/transport_beaker", slam, "broken or dropped"),
    slow("level2/pour_liquid", slam, "broken or dropped"),
    ("level1/place", lean_on_it, "broken"),
    ("level1/place", push_the_target, "displaced"),
    ("level2/transport_beaker", push_the_target, "displaced"),
    slow("level3/transport_beaker", push_the_target, "displaced"),
    ("level1/place", push_it_over, "broken"),
)
"""Task, play, and what the judge calls it."""

UNDONE = (
    ("level1/place", let_go_above(0.0, aside=0.055), "carried"),
    ("level1/place", drag_it_off, "retracted"),
    ("level1/place", on_the_bench_beside, ""),
    ("level2/pour_liquid", put_elsewhere(0.10), "righted"),
    slow("level3/pour_liquid", put_elsewhere(0.10), "righted"),
    slow("level2/pour_liquid", put_elsewhere(-0.06), "righted"),
)
"""Task, play, and how far the judge thinks it has come when it is over."""

PASSING = (
    ("level1/place", let_go_above(0.002)),
    ("level1/place", turned_about(20.0)),
    ("level1/place", turned_about(-10.0)),
    ("level1/place", second_thoughts),
    ("level2/transport_beaker", high_over_the_plate),
)


@pytest.mark.parametrize(("task", "play", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, reported: str, seed: int
):
    assert outcome(begun(task), play, seed)["outcome"] in reported.split(" or ")


@pytest.mark.parametrize(("task", "play", "last"), UNDONE)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_stands_elsewhere_has_not_been_set_down(task: str, play: Play, last: str, seed: int):
    info = outcome(begun(task), play, seed)
    assert info["outcome"] in UNFINISHED
    assert (reached(info) or [""])[-1] == last


@pytest.mark.parametrize("seed", SEEDS)
def test_a_beaker_let_go_on_the_move_slides_off_or_breaks(seed: int):
    info = outcome(begun("level1/place"), let_go_on_the_move, seed)
    assert info["outcome"] in {*UNFINISHED, "broken"}
    assert "retracted" not in reached(info)


@pytest.mark.parametrize(
    ("task", "last"),
    [
        ("level2/transport_beaker", "place"),
        ("level2/pour_liquid", "place"),
        ("level4/clean_beaker", "7_place"),
    ],
)
def test_nothing_is_won_by_standing_still_behind_the_last_step(task: str, last: str):
    with pytest.raises(TaskError, match="Nothing is left to play"):
        begun(task).reset(seed=0, options={"after": last})


@pytest.mark.parametrize(("task", "play"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, seed: int):
    assert outcome(begun(task), play, seed)["outcome"] == "success"
