"""Attacks that fit one task, and odd plays of it that are right: own inverse kinematics, no expert.

The expert plays up to a phase; from there on the hand goes where the play wants it.
"""

import math
from dataclasses import replace
from functools import cache
from itertools import chain

import numpy as np
import pytest

from adversary import play as play_skills
from attacks.arm import Actions, Arm
from attacks.plays import Play, outcome, turned, until_phase
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import Setting

SEEDS = [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 5))]
CIRCLE = 0.009
"""Radius of a stirring circle [m]."""


@cache
def begun(task: str, liquid: str = "off") -> LabEnv:
    return LabEnv(Setting(task, obs="state", liquid=liquid, particles=300))


def rolled(*degrees: float, axis: int = 2) -> Play:
    """Shake about one of the hand's own axes, through these angles one after the other."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "shake/left")
        arm = Arm(env)
        level = arm.pose
        for angle in degrees:
            yield from arm.go(turned(level, axis, math.radians(angle)))
            yield from arm.stay(0.2)

    return play


def circled(turns: float, start_deg: float, higher: float = 0.0) -> Play:
    """Stir by turns, counterclockwise if positive, from an angle; then take the rod out."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "stir/circle")
        arm = Arm(env)
        middle = arm.pose
        yield from arm.go(middle.moved(z=higher), speed=0.05)
        yield from arm.go(_on_circle(middle.moved(z=higher), math.radians(start_deg)), speed=0.05)
        yield from arm.stay(0.5)
        steps = round(60 * abs(turns))
        for part in np.arange(1, steps + 1) / steps:
            angle = math.radians(start_deg) + part * 2 * math.pi * turns
            yield arm.at(_on_circle(middle.moved(z=higher), angle))
        yield from chain(arm.go(middle, speed=0.05), arm.go(middle.moved(z=0.20), speed=0.15))

    return play


def _on_circle(middle, angle: float):
    return middle.moved(CIRCLE * math.cos(angle), CIRCLE * math.sin(angle))


def let_go_above(height: float) -> Play:
    """Let a beaker go above what it is to stand on."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "place/align")
        world, arm = env.workcell.world, Arm(env)
        yield from arm.stay(0.3)
        (skill,) = env.workcell.task.steps[-1].skills
        gap = world.pose(skill.thing).position_w[2] - skill.on.position_w(world)[2]
        yield from arm.go(arm.pose.moved(z=height - gap), speed=0.05)
        yield from arm.stay(0.5)
        wide = world.robot.max_opening
        yield from chain(arm.stay(0.7, wide), arm.go(arm.pose.advanced(-0.15), speed=0.15))

    return play


def slam(env: LabEnv) -> Actions:
    """Set a beaker down at one metre per second."""
    yield from until_phase(env, "place/lower")
    arm = Arm(env)
    yield from chain(arm.go(arm.pose.moved(z=-0.13), speed=1.0), arm.stay(60.0))


def hang_by_the_lip(env: LabEnv) -> Actions:
    """Lift a beaker by its lip on open fingers, and go on as if it were held."""
    yield from until_phase(env, "pick/close")
    arm = Arm(env)
    yield from chain(arm.go(arm.pose.moved(z=0.25), speed=0.1), arm.stay(60.0))


def fling_open(env: LabEnv) -> Actions:
    """Tear a drawer open by its handle."""
    yield from until_phase(env, "open/move")
    arm = Arm(env)
    (part,) = (skill.part for skill in env.workcell.task.steps[0].skills)
    way = 0.17 * env.workcell.world.frame(part.joint).z_axis
    yield from chain(arm.go(arm.pose.moved(*way), speed=1.0), arm.stay(0.5))
    yield from chain(arm.stay(0.5, 0.05), arm.go(arm.pose.advanced(-0.12)))


def jam_the_handle(env: LabEnv) -> Actions:
    """Open a drawer with fingers that are not closed, but twisted about its handle."""
    yield from until_phase(env, "open/grip")
    arm = Arm(env)
    (part,) = (skill.part for skill in env.workcell.task.steps[0].skills)
    yield from arm.stay(0.5, 0.018)
    yield from arm.go(turned(arm.pose, 2, math.radians(30)), speed=0.1)
    way = 0.17 * env.workcell.world.frame(part.joint).z_axis
    yield from chain(arm.go(arm.pose.moved(*way), speed=0.15), arm.stay(0.5))
    yield from chain(arm.stay(0.5, 0.05), arm.go(arm.pose.advanced(-0.12)))


def fling_the_water(env: LabEnv) -> Actions:
    """Empty a beaker at one stroke, from 11 cm beside the target and 15 cm too high."""
    yield from until_phase(env, "pour/tilt")
    arm = Arm(env)
    yield from arm.go(arm.pose.moved(y=0.11, z=0.15))
    level = arm.pose
    for part in np.arange(1, 13) / 12:
        yield arm.at(turned(level, 2, -math.radians(105) * part))
    yield from chain(arm.stay(1.0), arm.go(level), arm.stay(60.0))


FAILING: tuple[tuple[str, Play], ...] = (
    ("level1/shake", rolled(20, 14, 20, 14, 20, 14, 20, 0)),
    ("level1/shake", rolled(4, -4, 4, -4, 4, -4, 0)),
    ("level1/stir", circled(5.2, 0.0, higher=0.025)),
    ("level1/stir", circled(4.0, 135.0)),
    ("level1/place", let_go_above(0.012)),
    ("level1/place", let_go_above(0.020)),
    ("level1/place", slam),
    ("level2/transport_beaker", slam),
    ("level2/transport_beaker", hang_by_the_lip),
    ("level2/pour_liquid", slam),
    ("level1/open_drawer", fling_open),
    ("level1/open_drawer", jam_the_handle),
    ("level1/open_door", jam_the_handle),
    ("level1/pour", fling_the_water),
)

PASSING: tuple[tuple[str, Play], ...] = (
    ("level1/shake", rolled(20, -20, 20, -20, 20, -20, 0, axis=1)),
    ("level1/shake", rolled(-20, 20, -20, 20, -20, 20, 0)),
    ("level1/stir", circled(5.2, 135.0)),
    ("level1/stir", circled(-5.2, 45.0)),
    ("level1/place", let_go_above(0.002)),
)


@pytest.mark.parametrize(("task", "play"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_fail(task: str, play: Play, seed: int):
    assert outcome(begun(task), play, seed)["outcome"] != "success"


@pytest.mark.parametrize(("task", "play"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, seed: int):
    assert outcome(begun(task), play, seed)["outcome"] == "success"


@pytest.mark.parametrize("play", [slam, let_go_above(0.006)])
def test_a_beaker_that_is_not_set_down_gently_is_broken(play: Play):
    assert outcome(begun("level1/place"), play, 0)["outcome"] == "broken"


def test_a_beaker_that_hangs_on_open_fingers_is_not_gripped():
    info = outcome(begun("level2/transport_beaker"), hang_by_the_lip, 0)
    assert info["substeps"]["gripped"] == np.inf


def test_a_beaker_put_down_elsewhere_has_not_been_put_back():
    env = begun("level2/pour_liquid")
    env.reset(seed=0)
    pick, pour, place = env.workcell.task.skills
    elsewhere = replace(place, on=replace(place.on, left=place.on.left + 0.25))
    assert play_skills(env, pick, pour, elsewhere, seed=0)["outcome"] == "running"


def test_water_flung_at_the_target_is_not_poured():
    assert outcome(begun("level1/pour", "on"), fling_the_water, 0)["outcome"] != "success"
