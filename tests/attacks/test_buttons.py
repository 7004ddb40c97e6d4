"""Attacks on buttons, and odd ways to press them that are right."""

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
    skilled,
    slow,
    turned,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Press
from labutopia_lerobot.world import Button, Pose


def pressing(env: LabEnv) -> Press:
    """Return the task's skill that presses a button."""
    (skill,) = (skill for skill in env.workcell.task.skills if isinstance(skill, Press))
    return skill


def wrong_one(env: LabEnv) -> Button:
    """Return a button that is not to be pressed."""
    right = pressing(env).button
    everything = [piece for piece in env.workcell.task.start if hasattr(piece, "button")]
    buttons = [piece.button for piece in everything]
    buttons += [one for piece in env.workcell.task.start for one in getattr(piece, "buttons", ())]
    return next(button for button in buttons if button.name != right.name)


def press_the_wrong_one(env: LabEnv) -> Actions:
    """Press another button, neatly, and then the right one."""
    skill = pressing(env)
    yield from skilled(env, replace(skill, button=wrong_one(env), hold=0.3), skill)


def then_another(env: LabEnv) -> Actions:
    """Press the right button for a second, then another one."""
    skill = pressing(env)
    short = replace(skill, hold=1.0)
    yield from skilled(env, short, replace(skill, button=wrong_one(env), hold=0.3))


def tap(env: LabEnv) -> Actions:
    """Tap the button and let it go at once, where it was to be kept pressed."""
    yield from skilled(env, replace(pressing(env), hold=0.0))


def pushed_at(
    aside: float = 0.0,
    above: float = 0.0,
    lean_deg: float = 0.0,
    opening: float | None = None,
    speed: float = 0.06,
    beyond: float = 0.004,
) -> Play:
    """Press beside the axis, across or along the finger tips [m], aslant, fast, or too far [m]."""

    def play(env: LabEnv) -> Actions:
        yield from until_phase(env, "press/press")
        world, arm, button = env.workcell.world, Arm(env), pressing(env).button
        reach = world.robot.finger_reach
        face = world.frame(button.name)
        hand = turned(arm.pose, 0, math.radians(lean_deg))
        point = face.position_w - 0.03 * face.z_axis
        point = point + aside * hand.y_axis + above * hand.x_axis
        before = Pose(point - reach * hand.z_axis, hand.rotation_w)
        yield from chain(arm.go(before, speed=0.1, opening=opening), arm.stay(0.5))
        inside = before.moved(*((0.03 + button.travel + beyond) * face.z_axis))
        yield from arm.go(inside, speed=speed)

    return play


def one_tip(opening: float) -> Play:
    """Press with one finger tip, the other one beside the button."""

    def play(env: LabEnv) -> Actions:
        aside = (opening + env.workcell.world.robot.finger_thickness) / 2
        yield from pushed_at(aside=-aside, opening=opening)(env)

    return play


def on_before_it_is_loaded(env: LabEnv) -> Actions:
    """Switch the empty hot plate on, load it, and switch it off and on again."""
    press, short = pressing(env), replace(pressing(env), hold=0.1)
    skills = [skill for skill in env.workcell.task.skills if skill is not press]
    yield from skilled(env, short, *skills, short, press)


def off_again(env: LabEnv) -> Actions:
    """Heat a beaker as asked, and switch the plate off with a second press."""
    yield from until_phase(env, "press/leave")
    arm = Arm(env)
    inside = arm.pose
    yield from chain(arm.go(inside.advanced(-0.03), speed=0.15), arm.go(inside, speed=0.06))
    yield from chain(arm.stay(0.3), arm.go(inside.advanced(-0.12)))


def with_the_beaker(env: LabEnv) -> Actions:
    """Press the button with the bottom of the beaker on the way to the plate."""
    yield from until_phase(env, "place/above")
    world, arm, button = env.workcell.world, Arm(env), pressing(env).button
    home = arm.pose
    way = (
        world.frame(button.name).position_w
        - world.pose(env.workcell.task.skills[0].thing).position_w
    )
    above = home.moved(way[0], way[1], way[2] + 0.03)
    yield from chain(arm.go(above, speed=0.15), arm.stay(0.3))
    yield from chain(arm.go(above.moved(z=-0.04), speed=0.05), arm.stay(0.3))
    yield from arm.go(above.moved(z=0.10), speed=0.15)
    yield from skilled(env, *env.workcell.task.skills[1:])


FAILING = (
    ("level1/press", press_the_wrong_one, "wrong_button"),
    ("level3/press", press_the_wrong_one, "wrong_button"),
    ("level1/press", then_another, "wrong_button"),
    ("level2/heat_beaker", on_before_it_is_loaded, "pressed_out_of_turn"),
    slow("level3/heat_beaker", on_before_it_is_loaded, "pressed_out_of_turn"),
    ("level2/heat_beaker", with_the_beaker, "pressed_out_of_turn"),
    ("level1/press", pushed_at(beyond=0.15), "collided"),
)
"""Task, play, and what the judge calls it."""

UNDONE = (
    ("level1/press", tap, "pressed"),
    slow("level3/press", tap, "pressed"),
    ("level1/press", pushed_at(above=0.014), "pressed"),
    ("level1/press", pushed_at(above=-0.014), "pressed"),
    ("level2/heat_beaker", off_again, "pressed"),
)
"""Task, play, and how far the judge thinks it has come when it is over."""

PASSING = (
    ("level1/press", one_tip(0.03)),
    ("level3/press", one_tip(0.03)),
    ("level1/press", pushed_at(lean_deg=13.0)),
    ("level1/press", pushed_at(lean_deg=-13.0)),
    ("level1/press", pushed_at(aside=0.006)),
    ("level1/press", pushed_at(speed=0.01)),
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


@pytest.mark.parametrize(("task", "play"), PASSING)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_person_would_pass(task: str, play: Play, seed: int):
    assert outcome(begun(task), play, seed)["outcome"] == "success"
