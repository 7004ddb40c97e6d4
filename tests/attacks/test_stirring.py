"""Attacks on stirring, and odd ways to stir that are right: the tip of a rod goes its own ways."""

import math
from collections.abc import Iterable
from itertools import chain

import numpy as np
import pytest

from attacks.arm import Actions, Arm
from attacks.plays import SEEDS, Play, begun, outcome, reached, skilled, slow, until_phase
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.world import CONTROL_HZ, Pose

CIRCLE = 0.009
"""Radius of a stirring circle [m]."""
TOUCHES = 0.0262
"""Radius on which the rod just touches the wall of a 150 ml beaker [m]."""


def out(arm: Arm, middle: Pose) -> Actions:
    """Take the rod out, straight up from the middle."""
    yield from chain(arm.go(middle, speed=0.05), arm.go(middle.moved(z=0.20), speed=0.15))


def along(way: Iterable[tuple[float, float]], higher: float = 0.0) -> Play:
    """Lead the rod's tip along points beside the axis [m], one a control step; then take it out."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "stir/circle")
        points = list(way)
        arm = Arm(env)
        middle = arm.pose.moved(z=higher)
        yield from arm.go(middle, speed=0.05)
        yield from arm.go(middle.moved(*points[0]), speed=0.05)
        yield from arm.stay(0.5)
        for x, y in points:
            yield arm.at(middle.moved(x, y))
        yield from out(arm, middle.moved(z=-higher))

    return play


def arc(
    turns: float, start_deg: float = 0.0, radius: float = CIRCLE, turn_s: float = 2.0
) -> list[tuple[float, float]]:
    """Return points on a circle, counterclockwise if `turns` is positive."""
    steps = round(CONTROL_HZ * turn_s * abs(turns))
    angles = math.radians(start_deg) + 2 * math.pi * turns * np.arange(1, steps + 1) / steps
    return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]


def pause(at: tuple[float, float], seconds: float) -> list[tuple[float, float]]:
    """Return a point for as long as it takes."""
    return [at] * round(seconds * CONTROL_HZ)


def circled(turns: float, start_deg: float, higher: float = 0.0) -> Play:
    """Stir by turns, counterclockwise if positive, from an angle; then take the rod out."""
    return along(arc(turns, start_deg), higher)


def crescent() -> list[tuple[float, float]]:
    """Return a way to and fro on one side of the axis: out at 6 mm, back at 4, never round it."""
    there = arc(115 / 360, -57.5, 0.0062, 2.5)
    back = arc(-115 / 360, 57.5, 0.0038, 2.5)
    return (there + back) * 10


def line() -> list[tuple[float, float]]:
    """Return a way to and fro through the axis."""
    stroke = np.concatenate([np.linspace(-CIRCLE, CIRCLE, 20), np.linspace(CIRCLE, -CIRCLE, 20)])
    return [(0.0, y) for y in stroke] * 8


def eight() -> list[tuple[float, float]]:
    """Return a figure of eight whose crossing is on the axis."""
    angles = np.linspace(0.0, 2 * math.pi * 7, 7 * 75)
    return [(CIRCLE * math.sin(angle), CIRCLE * math.sin(2 * angle) / 1.2) for angle in angles]


def hop(env: LabEnv) -> Actions:
    """Stir five turns, but lift the tip out of the beaker after each."""
    yield from until_phase(env, "stir/circle")
    arm = Arm(env)
    middle = arm.pose
    for _ in range(5):
        yield from arm.go(middle.moved(CIRCLE), speed=0.05)
        for x, y in arc(1.02):
            yield arm.at(middle.moved(x, y))
        yield from chain(arm.go(middle.moved(z=0.09), speed=0.15), arm.go(middle, speed=0.12))
    yield from out(arm, middle)


def grind(env: LabEnv) -> Actions:
    """Press the rod onto the bottom of the beaker and stir there."""
    yield from until_phase(env, "stir/circle")
    arm = Arm(env)
    middle = arm.pose
    low = middle.moved(z=-0.02)
    yield from arm.go(low, speed=0.05)
    for x, y in arc(5.2):
        yield arm.at(low.moved(x, y))
    yield from out(arm, middle)


def drag(env: LabEnv) -> Actions:
    """Stir as asked, then pull the rod out slantwise so that it drags the beaker along."""
    yield from until_phase(env, "stir/retract")
    arm = Arm(env)
    middle = arm.pose
    yield from arm.go(middle.moved(y=0.06), speed=0.05)
    yield from out(arm, middle)


def hit_the_rim(env: LabEnv) -> Actions:
    """Come down on the rim of the beaker with the rod, then do all as asked."""
    yield from until_phase(env, "stir/insert")
    arm = Arm(env)
    above = arm.pose
    rim = env.workcell.task.skills[-1].vessel.mouth_radius
    yield from arm.go(above.moved(x=rim + 0.002), speed=0.1)
    low = env.workcell.world.frame(env.workcell.task.skills[-1].vessel.rim).position_w[2]
    tip = env.workcell.world.pose(env.workcell.task.skills[-1].rod).position_w[2]
    yield from chain(arm.go(arm.pose.moved(z=low - tip - 0.02), speed=0.1), arm.stay(0.3))
    yield from arm.go(above, speed=0.1)
    yield from skilled(env, env.workcell.task.skills[-1])


def brush_the_wall(env: LabEnv) -> Actions:
    """Stir as asked, but bulge out to the wall at one place, so that the rod brushes it."""
    world, skill = env.workcell.world, env.workcell.task.skills[-1]
    way = []
    for x, y in arc(5.2, turn_s=4.0):
        aside = math.degrees(math.acos(y / CIRCLE)) if abs(y) < CIRCLE else 0.0
        wide = 1.0 + (TOUCHES - CIRCLE) / CIRCLE * math.exp(-((aside / 30.0) ** 2))
        way.append((wide * x, wide * y))
    brushed = False
    for action in along(way)(env):
        brushed |= world.touching(skill.rod.name, skill.vessel.name)
        yield action
    assert brushed


def near_the_wall(share: float) -> Play:
    """Stir on a circle this share of the mouth's radius wide."""

    def play(env: LabEnv) -> Actions:
        radius = share * env.workcell.task.skills[-1].vessel.mouth_radius
        yield from along(arc(5.2, 90.0, radius, 3.0))(env)

    return play


BOTH_WAYS = [*arc(3.0), *pause((CIRCLE, 0.0), 0.3), *arc(-5.2)]
WITH_A_PAUSE = [*arc(2.0), *pause((CIRCLE, 0.0), 1.0), *arc(3.2)]
EGG = [(1.3 * x, 0.7 * y) for x, y in arc(5.3, turn_s=2.5)]

FAILING = (
    ("level1/stir", hop, "off", "interrupted"),
    ("level1/stir", grind, "off", "struck"),
    ("level1/stir", drag, "off", "struck or displaced"),
    ("level1/stir", hit_the_rim, "off", "struck"),
    slow("level2/stir_glassrod", grind, "off", "struck"),
)
"""Task, play, liquid, and what the judge calls it."""

UNDONE = (
    ("level1/stir", along(crescent()), "off", "running or timeout"),
    slow("level1/stir", along(crescent()), "on", "running or timeout"),
    slow("level1/stir", along(line()), "off", "running or timeout"),
    slow("level1/stir", along(eight()), "off", "running or timeout"),
    slow("level1/stir", along(arc(6.0, radius=0.0015)), "off", "running or timeout"),
    ("level1/stir", circled(4.0, 135.0), "off", "interrupted or running or timeout"),
    ("level1/stir", circled(5.2, 0.0, higher=0.025), "off", "running or timeout"),
)
"""Task, play, liquid, and how the judge ends what is no stirring."""

PASSING = (
    ("level1/stir", circled(5.2, 135.0), "off"),
    slow("level1/stir", circled(-5.2, 45.0), "off"),
    slow("level1/stir", circled(-5.2, 45.0), "on"),
    slow("level1/stir", along(WITH_A_PAUSE), "off"),
    slow("level1/stir", along(BOTH_WAYS), "off"),
    slow("level1/stir", near_the_wall(0.75), "off"),
    ("level1/stir", brush_the_wall, "off"),
    slow("level1/stir", along(EGG), "off"),
)


@pytest.mark.slow
@pytest.mark.parametrize(("task", "play", "liquid", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, liquid: str, reported: str, seed: int
):
    assert outcome(begun(task, liquid), play, seed)["outcome"] in reported.split(" or ")


@pytest.mark.slow
@pytest.mark.parametrize(("task", "play", "liquid", "reported"), UNDONE)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_goes_round_too_little_is_not_stirred(
    task: str, play: Play, liquid: str, reported: str, seed: int
):
    info = outcome(begun(task, liquid), play, seed)
    assert info["outcome"] in reported.split(" or ")
    assert "stirred" not in reached(info)


@pytest.mark.parametrize(("task", "play", "liquid"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, liquid: str, seed: int):
    assert outcome(begun(task, liquid), play, seed)["outcome"] == "success"
