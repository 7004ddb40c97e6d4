"""Attacks on shaking, and odd ways to shake that are right."""

import math
from dataclasses import replace
from itertools import chain

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
    slow,
    turned,
    until_phase,
)
from labutopia_lerobot.env import LabEnv

LEFT_AND_RIGHT = (20, -20, 20, -20, 20, -20, 0)


def rolled(*degrees: float, axis: int = 2, ahead: float = 0.0, higher: float = 0.0) -> Play:
    """Shake about one of the hand's own axes, through these angles one after the other.

    First the hand goes aside by some way [m]; it comes back only in height.
    """

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "shake/left")
        arm = Arm(env)
        level = arm.pose.moved(x=ahead, z=higher)
        yield from arm.go(level)
        for angle in degrees:
            yield from arm.go(turned(level, axis, math.radians(angle)))
            yield from arm.stay(0.2)
        yield from arm.go(level.moved(z=-higher))

    return play


def up_and_down(env: LabEnv) -> Actions:
    """Move a beaker up and down six times, upright."""
    yield from until_phase(env, "shake/left")
    arm = Arm(env)
    level = arm.pose
    for _ in range(6):
        yield from chain(arm.go(level.moved(z=0.06)), arm.go(level))


def swirled(env: LabEnv) -> Actions:
    """Lean a beaker by 20 degrees and let the lean go round, four times, without a swing."""
    yield from until_phase(env, "shake/left")
    arm = Arm(env)
    level = arm.pose
    for step in range(4 * 45):
        angle = math.radians(8 * step)
        lean = turned(level, 2, math.radians(20) * math.cos(angle))
        yield arm.at(turned(lean, 1, math.radians(20) * math.sin(angle)))
    yield from arm.go(level)


def low(env: LabEnv) -> Actions:
    """Shake a beaker 8 cm above the bench, where 20 were asked for."""
    yield from rolled(*LEFT_AND_RIGHT, higher=-0.17)(env)


def beside_the_middle(env: LabEnv) -> Actions:
    """Shake as asked, but all the while 15 cm to the left of the middle of the workspace."""
    (skill,) = env.workcell.task.skills
    yield from skilled(env, replace(skill, at=replace(skill.at, left=0.15)))


FAILING = (
    ("level1/shake", rolled(20, 140, 20, -20, 20, -20, 0), "off", "spilled"),
    ("level1/shake", rolled(20, 140, 20, -20, 20, -20, 0), "on", "spilled"),
)
"""Task, play, liquid, and what the judge calls it."""

UNDONE = (
    ("level1/shake", rolled(20, 14, 20, 14, 20, 14, 20, 0), "off", "at_start"),
    ("level1/shake", rolled(4, -4, 4, -4, 4, -4, 0), "off", "at_start"),
    ("level1/shake", rolled(20, 0, 20, 0, 20, 0, 20, 0, 20, 0, 20, 0), "off", "at_start"),
    ("level1/shake", rolled(20, -20, 20, -20, 0), "off", "at_start"),
    ("level1/shake", up_and_down, "off", "at_start"),
    ("level1/shake", swirled, "off", "at_start"),
)
"""Task, play, liquid, and how far the judge thinks it has come when it is over."""

PASSING = (
    ("level1/shake", rolled(*LEFT_AND_RIGHT, axis=1), "off"),
    ("level1/shake", rolled(-20, 20, -20, 20, -20, 20, 0), "off"),
    ("level1/shake", beside_the_middle, "off"),
    ("level1/shake", rolled(*LEFT_AND_RIGHT, higher=0.10), "off"),
    slow("level1/shake", rolled(*LEFT_AND_RIGHT, ahead=0.10), "on"),
    ("level1/shake", rolled(20, -20, 0, 20, -20, 0, 20, -20, 0), "off"),
)


@pytest.mark.parametrize(("task", "play", "liquid", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, liquid: str, reported: str, seed: int
):
    assert outcome(begun(task, liquid), play, seed)["outcome"] == reported


@pytest.mark.slow
@pytest.mark.parametrize(("task", "play", "liquid", "last"), UNDONE)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_no_shake_is_not_counted(task: str, play: Play, liquid: str, last: str, seed: int):
    info = outcome(begun(task, liquid), play, seed)
    assert info["outcome"] in UNFINISHED
    assert (reached(info) or [""])[-1] == last


@pytest.mark.parametrize(
    "seed", [2, *(pytest.param(n, marks=pytest.mark.slow) for n in (3, 6, 7, 10))]
)
def test_a_beaker_in_the_hand_may_not_shove_what_stands_around(seed: int):
    env = begun("level1/shake", axes=("layout",))
    assert outcome(env, shove_a_distractor("shake/start"), seed)["outcome"] in {
        "displaced",
        "broken",
    }


@pytest.mark.slow
@pytest.mark.parametrize("task", ["level1/shake", "level2/shake_beaker"])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_beaker_is_not_shaken_near_the_bench(task: str, seed: int):
    assert outcome(begun(task), low, seed)["outcome"] != "success"


@pytest.mark.slow
@pytest.mark.parametrize(("task", "play", "liquid"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, liquid: str, seed: int):
    assert outcome(begun(task, liquid), play, seed)["outcome"] == "success"
