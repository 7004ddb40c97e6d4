"""Attacks on pouring, with liquid and without, and odd ways to pour that are right."""

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
    skilled,
    skilled_until,
    slow,
    turned,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Pour
from labutopia_lerobot.world import CONTROL_HZ

pytestmark = pytest.mark.slow


def pouring(env: LabEnv) -> Pour:
    """Return the first of the task's skills that pours."""
    return next(skill for skill in env.workcell.task.skills if isinstance(skill, Pour))


def poured_share(env: LabEnv) -> float:
    """Return how much of what was filled in has arrived."""
    liquid, skill = env.workcell.world.liquid, pouring(env)
    assert liquid is not None
    return liquid.from_in(skill.thing.name, skill.into.name) / liquid.originated_in(
        skill.thing.name
    )


def tilting(arm: Arm, degrees: float, speed_deg: float) -> Actions:
    """Turn the hand about its own axis, to the left of who looks along it."""
    level = arm.pose
    steps = max(1, round(abs(degrees) / speed_deg * CONTROL_HZ))
    for part in np.arange(1, steps + 1) / steps:
        yield arm.at(turned(level, 2, -math.radians(degrees) * part))


def fling_the_water(env: LabEnv) -> Actions:
    """Empty a beaker at one stroke, from 11 cm beside the target and 15 cm too high."""
    yield from until_phase(env, "pour/tilt")
    arm = Arm(env)
    yield from arm.go(arm.pose.moved(y=0.11, z=0.15))
    level = arm.pose
    yield from chain(tilting(arm, 105.0, 260.0), arm.stay(1.0), arm.go(level))


def beside_the_target(env: LabEnv) -> Actions:
    """Pour onto the bench, a hand's width beside the target."""
    yield from until_phase(env, "pour/tilt")
    arm = Arm(env)
    yield from arm.go(arm.pose.moved(y=0.16), speed=0.15)
    level = arm.pose
    yield from chain(tilting(arm, 105.0, 40.0), arm.stay(1.0), arm.go(level))


def half(env: LabEnv) -> Actions:
    """Pour half of it only and hold the beaker upright again."""
    skill = pouring(env)
    yield from skilled_until(env, "pour/tilt", *env.workcell.task.skills)
    script = env.workcell.expert([skill])
    script.start()
    while poured_share(env) < 0.35:
        yield script.act()
    back = Arm(env)
    lean = env.workcell.world.pose(skill.thing).tilt
    yield from tilting(back, -math.degrees(lean), 60.0)


def on_the_rim(env: LabEnv) -> Actions:
    """Rest the lip of the beaker on the target's rim in pouring."""
    low = replace(pouring(env), drop=-0.006, hover=0.12)
    yield from skilled_until(env, "pour/tilt", low)
    arm = Arm(env)
    yield from chain(arm.go(arm.pose.moved(z=-0.03), speed=0.05), arm.stay(0.5))
    yield from skilled(env, pouring(env))


def knock_the_target(env: LabEnv) -> Actions:
    """Bump into the target with the full beaker on the way, then pour as asked."""
    yield from until_phase(env, "pour/start")
    world, arm, skill = env.workcell.world, Arm(env), pouring(env)
    home = arm.pose
    held = world.pose(skill.thing).position_w
    rim = world.frame(skill.into.rim).position_w
    way = rim - held
    beside = home.moved(way[0], way[1] + 0.16, way[2] - 0.06)
    yield from chain(arm.go(beside, speed=0.15), arm.stay(0.2))
    yield from chain(arm.go(beside.moved(y=-0.10), speed=0.1), arm.go(beside, speed=0.1))
    yield from chain(arm.go(home), skilled(env, skill))


def let_it_fall_in(env: LabEnv) -> Actions:
    """Pour as asked, then let the beaker itself fall into the target."""
    yield from until_phase(env, "pour/stabilise")
    arm = Arm(env)
    yield from chain(arm.stay(0.3), arm.stay(1.0, 0.08))


def from_too_high(env: LabEnv) -> Actions:
    """Pour from 45 cm above the target."""
    yield from skilled(env, replace(pouring(env), drop=0.36))


def spill_on_the_way(env: LabEnv) -> Actions:
    """Lean a full beaker by 80 degrees over the bench on the way, then go on as asked."""
    yield from until_phase(env, "place/above")
    arm = Arm(env)
    yield from chain(tilting(arm, 80.0, 60.0), arm.stay(0.5), tilting(arm, -80.0, 60.0))
    yield from skilled(env, env.workcell.task.skills[-1])


def trickle(env: LabEnv) -> Actions:
    """Trickle some of the water onto the plate, from right above it, then set the beaker down."""
    yield from until_phase(env, "place/lower")
    arm, liquid = Arm(env), env.workcell.world.liquid
    assert liquid is not None
    level = arm.pose.moved(z=0.06)
    yield from arm.go(level, speed=0.15)
    vessel = env.workcell.task.skills[-1].thing.name
    full = liquid.inside[vessel]
    for degrees in np.arange(0.0, 100.0, 0.7):
        yield arm.at(turned(level, 2, -math.radians(degrees)))
        if env.workcell.world.liquid.inside[vessel] < 0.96 * full:
            break
    yield from chain(arm.go(level, speed=0.3), arm.stay(0.5))
    yield from skilled(env, env.workcell.task.skills[-1])


def shaken_about(env: LabEnv) -> Actions:
    """Jerk a full beaker to and fro on the way to the plate, so that it slops over."""
    yield from until_phase(env, "place/above")
    arm = Arm(env)
    level = arm.pose
    for step in range(120):
        yield arm.at(level.moved(y=0.08 * math.sin(2 * math.pi * 2.0 * step / CONTROL_HZ)))
    yield from skilled(env, env.workcell.task.skills[-1])


def in_two_stages(env: LabEnv) -> Actions:
    """Pour a part, hold the beaker upright over the target for a second, and pour the rest."""
    skill = pouring(env)
    yield from skilled(env, replace(skill, angle=math.radians(70)))
    yield from chain(Arm(env).stay(1.0), skilled(env, skill))


def from_higher(env: LabEnv) -> Actions:
    """Pour with the lip 23 cm above the target."""
    yield from skilled(env, replace(pouring(env), drop=0.23, short=0.045))


def slowly(env: LabEnv) -> Actions:
    """Pour at half the speed."""
    yield from skilled(env, replace(pouring(env), turn_speed=0.35, pause_s=2.0))


def hit_the_cap(env: LabEnv) -> Actions:
    """Dispense as asked, let go, and hit the wash bottle's cap with the fist."""
    yield from until_phase(env, "squeeze/withdraw")
    arm = Arm(env)
    back = arm.pose.advanced(-0.12)
    yield from arm.go(back, speed=0.25)
    yield from arm.go(back.moved(z=0.06), speed=0.4, opening=0.0)
    yield from arm.go(back.moved(z=0.06).advanced(0.26), speed=0.4)


FAILING = (
    ("level1/pour", fling_the_water, "off", "interrupted or spilled"),
    ("level1/pour", fling_the_water, "on", "interrupted or spilled"),
    ("level1/pour", beside_the_target, "off", "interrupted or spilled"),
    ("level1/pour", beside_the_target, "on", "interrupted or spilled"),
    ("level1/pour", on_the_rim, "off", "struck"),
    ("level1/pour", knock_the_target, "off", "struck"),
    ("level1/pour", let_it_fall_in, "off", "struck or dropped or broken"),
    ("level1/pour", from_too_high, "off", "interrupted or spilled"),
    ("level2/transport_beaker", spill_on_the_way, "off", "spilled"),
    slow("level2/transport_beaker", spill_on_the_way, "on", "spilled"),
    ("level2/transport_beaker", trickle, "on", "spilled"),
    ("level2/transport_beaker", shaken_about, "on", "spilled"),
    slow("level1/squeeze", hit_the_cap, "on", "collided"),
)
"""Task, play, liquid, and what the judge calls it."""

PASSING = (
    ("level1/pour", in_two_stages, "on"),
    ("level1/pour", from_higher, "off"),
    slow("level1/pour", from_higher, "on"),
    slow("level1/pour", slowly, "on"),
)


@pytest.mark.parametrize(("task", "play", "liquid", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, liquid: str, reported: str, seed: int
):
    assert outcome(begun(task, liquid), play, seed)["outcome"] in reported.split(" or ")


@pytest.mark.parametrize("seed", SEEDS)
def test_half_is_not_enough(seed: int):
    env = begun("level1/pour", "on")
    info = outcome(env, half, seed)
    assert info["outcome"] in UNFINISHED
    assert reached(info) == []
    assert 0.35 < poured_share(env) < 0.8


@pytest.mark.parametrize(("task", "play", "liquid"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, liquid: str, seed: int):
    assert outcome(begun(task, liquid), play, seed)["outcome"] == "success"
