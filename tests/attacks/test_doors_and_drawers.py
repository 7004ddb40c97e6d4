"""Attacks on doors and drawers, and odd ways to open and close them that are right."""

import math
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
    turned,
    until,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills.handle import Operable
from labutopia_lerobot.world import CONTROL_HZ

WIDE = 0.05
"""Opening of a hand that lets a handle go [m]."""


def part_of(env: LabEnv) -> Operable:
    (part,) = {skill.part for skill in env.workcell.task.skills}
    return part


def opening_of(env: LabEnv) -> float:
    """Return how far the door or drawer is open [rad or m]."""
    return env.workcell.world.joint(part_of(env).joint)


def swing(env: LabEnv, arm: Arm, by: float, speed: float) -> Actions:
    """Carry the hand along with the door or drawer, by so much at such a speed [rad or m, s]."""
    part, world, hand = part_of(env), env.workcell.world, arm.pose
    steps = max(1, round(abs(by) / speed * CONTROL_HZ))
    for share in np.arange(1, steps + 1) / steps:
        yield arm.at(part.carried(hand, world, by * share))


def let_go(arm: Arm) -> Actions:
    """Open the fingers and draw the hand back."""
    yield from chain(arm.stay(0.5, WIDE), arm.go(arm.pose.advanced(-0.12)))


def fling_on(by: float, speed: float) -> Play:
    """Open by the handle as asked, then fling it on in the same grip."""

    def play(env: LabEnv) -> Actions:
        opens = env.workcell.task.skills[0].to - (0.02 if by < 0.3 else math.radians(3))
        yield from until(env, lambda: opening_of(env) > opens)
        arm = Arm(env)
        yield from chain(swing(env, arm, by, speed), arm.stay(0.3), let_go(arm))

    return play


def slam_again(back: float, speed: float) -> Play:
    """Close gently, pull it open again in the same grip, and slam it shut."""

    def play(env: LabEnv) -> Actions:
        closing = env.workcell.task.skills[-1]
        close = "close/pause"
        yield from skilled_until(env, close, *env.workcell.task.skills[:-1], closing)
        arm = Arm(env)
        yield from swing(env, arm, back, 0.15 if back < 0.3 else 0.5)
        yield from arm.stay(0.3)
        assert opening_of(env) > back / 2
        yield from chain(swing(env, arm, -1.05 * back, speed), arm.stay(0.3), let_go(arm))

    return play


def fling_open(env: LabEnv) -> Actions:
    """Tear a drawer open by its handle."""
    yield from until_phase(env, "open/move")
    arm = Arm(env)
    yield from chain(swing(env, arm, 0.17, 1.0), arm.stay(0.5), let_go(arm))


def jam_the_handle(env: LabEnv) -> Actions:
    """Open with fingers that are not closed, but twisted about the handle."""
    yield from until_phase(env, "open/grip")
    arm = Arm(env)
    yield from arm.stay(0.5, 0.018)
    yield from arm.go(turned(arm.pose, 2, math.radians(30)), speed=0.1)
    way = 0.17 * env.workcell.world.frame(part_of(env).joint).z_axis
    yield from chain(arm.go(arm.pose.moved(*way), speed=0.15), arm.stay(0.5), let_go(arm))


def shove_and_let_run(env: LabEnv) -> Actions:
    """Give an open drawer a push of half a metre per second and let it run shut by itself."""
    yield from until_phase(env, "close/move")
    arm = Arm(env)
    yield from swing(env, arm, -0.10, 0.6)
    yield from let_go(arm)


def push_back_with_the_fist(env: LabEnv) -> Actions:
    """Open a drawer as asked, let go, and push it half shut again with the fist."""
    yield from until_phase(env, "open/leave")
    arm = Arm(env)
    yield from arm.go(arm.pose.advanced(-0.06), speed=0.25)
    yield from arm.stay(0.2, 0.0)
    yield from arm.go(arm.pose.advanced(0.12), speed=0.10)
    assert opening_of(env) < 0.11
    yield from arm.go(arm.pose.advanced(-0.12))


def push_back_in_the_grip(env: LabEnv) -> Actions:
    """Open a door as asked, swing it half shut again and leave it so."""
    yield from until_phase(env, "open/release")
    arm = Arm(env)
    yield from chain(swing(env, arm, -math.radians(25), 0.5), arm.stay(0.3))
    assert opening_of(env) < math.radians(35)
    yield from let_go(arm)


def the_drawer_below(env: LabEnv) -> Actions:
    """Open the drawer below the one that was asked for, then that one."""
    (cabinet,) = env.workcell.task.start
    (skill,) = env.workcell.task.skills
    below = type(skill)(cabinet.drawers[1], skill.to)
    yield from skilled(env, below, skill)


def too_little(env: LabEnv) -> Actions:
    """Open a drawer by 8 cm only, let go, and close it."""
    opening, closing = env.workcell.task.skills
    yield from skilled(env, type(opening)(opening.part, 0.08), closing)


def never_let_go(env: LabEnv) -> Actions:
    """Open and close a drawer without letting go of it in between."""
    yield from until_phase(env, "open/release")
    arm = Arm(env)
    yield from chain(swing(env, arm, -0.157, 0.15), arm.stay(0.5), let_go(arm))


def open_to_the_stop(env: LabEnv) -> Actions:
    """Pull a drawer out as far as it goes, gently, where 13 cm or more were asked for."""
    yield from until_phase(env, "open/release")
    arm = Arm(env)
    yield from chain(swing(env, arm, 0.148, 0.15), arm.stay(0.3))
    assert opening_of(env) > 0.28
    yield from let_go(arm)


def two_pulls(env: LabEnv) -> Actions:
    """Open a drawer in two pulls, with the hand drawn back in between."""
    skill = env.workcell.task.skills[0]
    yield from skilled(env, type(skill)(skill.part, 0.07), *env.workcell.task.skills)


def slowly(env: LabEnv) -> Actions:
    """Open a drawer at 3 cm per second."""
    yield from until_phase(env, "open/move")
    arm = Arm(env)
    yield from chain(swing(env, arm, 0.15, 0.03), arm.stay(0.3), let_go(arm))


def with_the_fist(env: LabEnv) -> Actions:
    """Push a drawer shut by its handle with the closed fist."""
    yield from until_phase(env, "close/reach")
    arm = Arm(env)
    handle = env.workcell.world.frame(part_of(env).handle.name)
    yield from arm.stay(0.8, 0.0)
    ahead = (handle.position_w - arm.pose.position_w) @ arm.pose.z_axis
    tips = env.workcell.world.robot.finger_reach
    yield from arm.go(arm.pose.advanced(ahead - tips - 0.012), speed=0.15)
    far = opening_of(env) + 0.004
    yield from swing(env, arm, -far - 0.012, 0.10)
    yield from chain(arm.stay(0.5), arm.go(arm.pose.advanced(-0.15), speed=0.15))


FAILING = (
    ("level1/open_drawer", fling_open, "slammed"),
    ("level1/open_drawer", fling_on(0.16, 1.0), "slammed"),
    ("level1/open_door", fling_on(math.radians(40), math.radians(140)), "slammed"),
    ("level3/open_door", fling_on(math.radians(40), math.radians(140)), "slammed"),
    ("level1/close_drawer", slam_again(0.125, 0.7), "slammed"),
    ("level1/close_door", slam_again(math.radians(25), math.radians(120)), "slammed"),
    ("level2/operate_drawer", slam_again(0.125, 0.7), "slammed"),
    ("level1/close_drawer", shove_and_let_run, "slammed"),
    ("level1/open_drawer", the_drawer_below, "collided"),
)
"""Task, play, and what the judge calls it."""

UNDONE = (
    ("level1/open_drawer", push_back_with_the_fist, "opened"),
    ("level1/open_door", push_back_in_the_grip, "opened"),
    ("level2/operate_drawer", too_little, "gripped"),
    ("level2/operate_drawer", never_let_go, "opened"),
)
"""Task, play, and how far the judge thinks it has come when it is over."""

PASSING = (
    ("level1/open_drawer", two_pulls),
    ("level2/operate_drawer", two_pulls),
    ("level1/open_drawer", slowly),
    ("level1/open_drawer", open_to_the_stop),
    ("level1/close_drawer", with_the_fist),
)


@pytest.mark.parametrize(("task", "play", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, reported: str, seed: int
):
    assert outcome(begun(task), play, seed)["outcome"] == reported


@pytest.mark.parametrize("task", ["level1/open_drawer", "level1/open_door"])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_handle_that_jams_in_twisted_fingers_is_not_gripped(task: str, seed: int):
    info = outcome(begun(task), jam_the_handle, seed)
    assert info["outcome"] != "success"
    assert reached(info) == []


@pytest.mark.parametrize(("task", "play", "last"), UNDONE)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_not_so_in_the_end_has_not_been_done(task: str, play: Play, last: str, seed: int):
    info = outcome(begun(task), play, seed)
    assert info["outcome"] in UNFINISHED
    assert (reached(info) or [""])[-1] == last


@pytest.mark.parametrize(("task", "play"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, seed: int):
    assert outcome(begun(task), play, seed)["outcome"] == "success"
