"""Attacks on picking up, and odd ways to pick up that are right."""

import math
from dataclasses import replace
from itertools import chain

import numpy as np
import pytest

from attacks.arm import Actions, Arm
from attacks.plays import (
    SEEDS,
    UNFINISHED,
    Play,
    begun,
    outcome,
    reached,
    shove_a_distractor,
    skilled,
    skilled_until,
    turned,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.world import Pose

pytestmark = pytest.mark.slow


def hang_by_the_lip(env: LabEnv) -> Actions:
    """Lift a beaker by its lip on open fingers, and go on as if it were held."""
    yield from until_phase(env, "pick/close")
    arm = Arm(env)
    yield from arm.go(arm.pose.moved(z=0.25), speed=0.1)


def hold_it_aslant(env: LabEnv) -> Actions:
    """Lift a flask and hold it leaning by 45 degrees."""
    yield from until_phase(env, "pick/hold")
    arm = Arm(env)
    yield from arm.go(turned(arm.pose, 2, math.radians(45)), speed=0.2)


def put_it_down_again(env: LabEnv) -> Actions:
    """Lift a flask, hold it for half a second and set it down again."""
    yield from until_phase(env, "pick/hold")
    arm, (flask,) = Arm(env), env.workcell.task.start
    yield from arm.stay(0.5)
    gap = env.workcell.world.pose(flask).position_w[2] - env.workcell.world.bench_height
    yield from arm.go(arm.pose.moved(z=0.02 - gap), speed=0.15)
    yield from chain(arm.go(arm.pose.moved(z=-0.019), speed=0.03), arm.stay(0.5))
    yield from chain(arm.stay(0.7, 0.08), arm.go(arm.pose.advanced(-0.15)))


def lifted_by(height: float) -> Play:
    """Do as asked, but lift less than the 20 cm that were asked for [m]."""

    def play(env: LabEnv) -> Actions:
        pick, *others = env.workcell.task.skills
        yield from skilled(env, replace(pick, lift=height), *others)

    return play


def scrape_along(env: LabEnv) -> Actions:
    """Press a flask onto the bench with the arm before it is lifted."""
    yield from until_phase(env, "pick/lift")
    arm = Arm(env)
    low = arm.pose.moved(z=-0.04)
    yield from chain(arm.go(low, speed=0.05), arm.stay(0.5))
    yield from arm.go(low.moved(z=0.29))


def snatch(env: LabEnv) -> Actions:
    """Run into a flask with the open hand at 1 m/s, then pick it up as if nothing had been."""
    yield from until_phase(env, "pick/reach")
    arm = Arm(env)
    yield from arm.go(arm.pose.advanced(0.16), speed=1.0)
    yield from skilled(env, *env.workcell.task.skills)


def from_another_side(yaw_deg: float) -> Play:
    """Pick up as the expert does, with a hand that comes from further on one side."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "pick/lower")
        arm, skill = Arm(env), env.workcell.task.skills[0]
        world = env.workcell.world
        thing = world.pose(skill.thing)
        centre = thing.position_w + skill.thing.grip_height * thing.z_axis
        cosine, sine = math.cos(math.radians(yaw_deg)), math.sin(math.radians(yaw_deg))
        about = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        grasp = Pose(centre, about @ arm.pose.rotation_w).advanced(-skill.depth)
        before = grasp.advanced(-skill.standoff)
        wide, shut = world.robot.max_opening, skill.thing.grip_width - skill.squeeze
        yield from chain(arm.go(before.moved(z=0.10), opening=wide), arm.go(before, opening=wide))
        yield from chain(arm.go(grasp, speed=0.15), arm.stay(0.3), arm.stay(0.6, shut))
        yield from arm.go(grasp.moved(z=skill.lift), speed=0.15)

    return play


def with_rests(env: LabEnv) -> Actions:
    """Lift a flask in five stages, with a second of rest after each."""
    yield from until_phase(env, "pick/lift")
    arm = Arm(env)
    for _ in range(5):
        yield from chain(arm.go(arm.pose.moved(z=0.05), speed=0.15), arm.stay(1.0))


def regrasp(env: LabEnv) -> Actions:
    """Lift a beaker, set it down where it stood, take it anew, and do the task."""
    pick = env.workcell.task.skills[0]
    yield from skilled_until(env, "pick/hold", replace(pick, lift=0.08))
    arm = Arm(env)
    yield from chain(arm.go(arm.pose.moved(z=-0.079), speed=0.1), arm.stay(0.3))
    yield from chain(arm.stay(0.7, 0.08), arm.go(arm.pose.advanced(-0.15), speed=0.15))
    yield from skilled(env, *env.workcell.task.skills)


FAILING = (
    ("level1/pick", scrape_along, "broken"),
    ("level1/pick", snatch, "broken"),
)
"""Task, play, and what the judge calls it."""

UNDONE = (
    ("level1/pick", hold_it_aslant, "lifted"),
    ("level1/pick", put_it_down_again, "lifted"),
    ("level1/pick", lifted_by(0.15), "gripped"),
    ("level2/transport_beaker", lifted_by(0.13), "gripped"),
)
"""Task, play, and how far the judge thinks it has come when it is over."""

PASSING = (
    ("level1/pick", from_another_side(15.0)),
    ("level1/pick", from_another_side(-15.0)),
    ("level1/pick", with_rests),
    ("level2/transport_beaker", regrasp),
)


@pytest.mark.parametrize(("task", "play", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, reported: str, seed: int
):
    assert outcome(begun(task), play, seed)["outcome"] == reported


@pytest.mark.parametrize(("task", "play", "last"), UNDONE)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_not_so_in_the_end_has_not_been_done(task: str, play: Play, last: str, seed: int):
    info = outcome(begun(task), play, seed)
    assert info["outcome"] in UNFINISHED
    assert (reached(info) or [""])[-1] == last


@pytest.mark.parametrize("seed", [3, *(pytest.param(n, marks=pytest.mark.slow) for n in (1, 4, 9))])
def test_a_flask_may_not_shove_what_stands_around(seed: int):
    env = begun("level1/pick", axes=("layout",))
    assert outcome(env, shove_a_distractor("pick/lift"), seed)["outcome"] in {"displaced", "broken"}


@pytest.mark.parametrize("seed", SEEDS)
def test_a_beaker_that_hangs_on_open_fingers_is_not_gripped(seed: int):
    info = outcome(begun("level2/transport_beaker"), hang_by_the_lip, seed)
    assert info["outcome"] != "success"
    assert reached(info) == []


@pytest.mark.parametrize(("task", "play"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, seed: int):
    assert outcome(begun(task), play, seed)["outcome"] == "success"
