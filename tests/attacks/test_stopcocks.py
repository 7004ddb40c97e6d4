"""Attacks on stopcocks, and odd ways to turn them that are right."""

from dataclasses import replace
from functools import cache
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
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills import RunOut
from labutopia_lerobot.skills.skill import Skill

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


@cache
def titrating() -> LabEnv:
    """Return an environment whose particles are a third of what the mark may be missed by."""
    return LabEnv(Setting("level4/titrate_by_volume", obs="state"))


def asked_for(env: LabEnv) -> tuple[RunOut, tuple[Skill, ...]]:
    """Return the task's skill at the stopcock, and what comes after it."""
    first, *rest = env.workcell.task.skills
    assert isinstance(first, RunOut)
    return first, tuple(rest)


def beyond_the_mark(env: LabEnv) -> Actions:
    """Let 0.4 ml more run."""
    run, rest = asked_for(env)
    yield from skilled(env, replace(run, ml=run.ml + 0.4), *rest)


def short_of_the_mark(env: LabEnv) -> Actions:
    """Shut it 0.4 ml before, and take the flask away."""
    run, rest = asked_for(env)
    yield from skilled(env, replace(run, ml=run.ml - 0.4), *rest)


def leave_the_flask(env: LabEnv) -> Actions:
    """Run to the mark, and no more."""
    yield from skilled(env, asked_for(env)[0])


def onto_the_stand_again(env: LabEnv) -> Actions:
    """Run to the mark, lift the flask and set it down where it was."""
    run, (pick, place) = asked_for(env)
    under = next(piece for piece in env.workcell.task.start if piece.name == "stand").under
    yield from skilled(env, run, pick, replace(place, on=under, through=None, hover=0.012))


def in_drops(env: LabEnv) -> Actions:
    """Let a part run, shut it, and run the rest."""
    run, rest = asked_for(env)
    yield from skilled(env, replace(run, ml=run.ml - 1.5), run, *rest)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("play", "outcomes"),
    [
        (beyond_the_mark, {"overshot"}),
        (short_of_the_mark, UNFINISHED),
        (leave_the_flask, UNFINISHED),
        (onto_the_stand_again, UNFINISHED),
        (in_drops, {"success"}),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_a_mark_is_met_and_the_flask_taken_away(play: Play, outcomes: set[str]):
    assert outcome(titrating(), play, 0)["outcome"] in outcomes


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


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "play", [in_two_portions, slow(without_a_slit)], ids=lambda play: play.__name__
)
def test_it_counts_though_it_looks_odd(play: Play, seed: int):
    assert outcome(begun(TASK, "on"), play, seed)["outcome"] == "success"
