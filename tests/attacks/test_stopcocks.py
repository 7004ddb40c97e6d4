"""Attacks on stopcocks, and odd ways to turn them that are right."""

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
    skilled,
    skilled_until,
    slow,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import RunOut

TASK = "level1/turn_stopcock"


def running(env: LabEnv) -> RunOut:
    """Return the task's skill."""
    (skill,) = (skill for skill in env.workcell.task.skills if isinstance(skill, RunOut))
    return skill


def leave_it_open(env: LabEnv) -> Actions:
    """Open it and go away."""
    yield from until_phase(env, "runout/run")
    arm = Arm(env)
    yield from chain(arm.stay(0.5, 0.04), arm.go(arm.pose.advanced(-0.1)), arm.stay(12.0))


def open_and_shut_at_once(env: LabEnv) -> Actions:
    """Turn it to and fro: some drops."""
    yield from skilled(env, replace(running(env), ml=1.0, last_ml=0.5))


def keep_hold_of_it(env: LabEnv) -> Actions:
    """Do all of it, but let go."""
    yield from skilled_until(env, "runout/release", running(env))


def push_the_flask_aside(env: LabEnv) -> Actions:
    """Push the flask from under the tip, and run it onto the stand."""
    world, arm = env.workcell.world, Arm(env)
    flask = world.frame("flask_rim").position_w
    here = arm.pose
    beside = here.moved(*(flask - here.position_w + (-0.08, 0.12, -0.02)))
    yield from chain(arm.stay(0.5, 0.0), arm.go(beside), arm.go(beside.moved(x=0.08)))
    yield from chain(arm.go(beside.moved(x=0.08, y=-0.16), speed=0.1), arm.stay(1.0))


def in_two_portions(env: LabEnv) -> Actions:
    """Let 3 ml run, let go of it, and then 4 more."""
    skill = running(env)
    yield from skilled(env, replace(skill, ml=3.0), replace(skill, ml=7.0))


def without_a_slit(env: LabEnv) -> Actions:
    """Open and shut it in one stroke each."""
    yield from skilled(env, replace(running(env), last_ml=0.0))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        (leave_it_open, {"overshot"}),
        slow(open_and_shut_at_once, UNFINISHED),
        slow(keep_hold_of_it, UNFINISHED),
        (push_the_flask_aside, {"struck", "displaced", "collided", "broken", "spilled"}),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_none_of_it_counts(play: Play, outcomes: set[str], seed: int):
    assert outcome(begun(TASK, "on"), play, seed)["outcome"] in outcomes


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "play", [in_two_portions, slow(without_a_slit)], ids=lambda play: play.__name__
)
def test_it_counts_though_it_looks_odd(play: Play, seed: int):
    assert outcome(begun(TASK, "on"), play, seed)["outcome"] == "success"
