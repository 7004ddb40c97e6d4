"""Attacks on the long tasks of level 4: order, cleanliness, and what has been done before."""

import math
from collections.abc import Sequence
from dataclasses import replace

import pytest

from adversary import Beside, Careless
from attacks.arm import Actions, Arm
from attacks.plays import (
    Play,
    begun,
    latched,
    outcome,
    skilled,
    slow,
    turned,
    until_phase,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Shake
from labutopia_lerobot.skills.skill import Skill

pytestmark = pytest.mark.slow

SLOW_SEEDS = [pytest.param(seed, marks=pytest.mark.slow) for seed in range(5)]
SEEDS = [0, *SLOW_SEEDS[1:]]


def skills_of(env: LabEnv, *steps: str) -> tuple[Skill, ...]:
    """Return the skills of some steps, in the order asked for."""
    found = {step.name: step.skills for step in env.workcell.task.steps}
    return tuple(skill for step in steps for skill in found[step])


def in_this_order(*steps: str) -> Play:
    """Do some steps, and no others, in an order of one's own."""

    def play(env: LabEnv) -> Actions:
        yield from skilled(env, *skills_of(env, *steps))

    return play


def piece(env: LabEnv, name: str):
    """Return what stands in the task under a name."""
    return next(piece for piece in env.workcell.task.start if piece.name == name)


def into(step: str, wrong: str) -> Play:
    """Do as asked up to a pour, and pour into another vessel than the one asked for."""

    def play(env: LabEnv) -> Actions:
        steps = [one.name for one in env.workcell.task.steps]
        (skill,) = skills_of(env, step)
        astray = replace(skill, into=piece(env, wrong))
        yield from skilled(env, *skills_of(env, *steps[: steps.index(step)]), astray)

    return play


def rest_into_the_next(env: LabEnv) -> Actions:
    """When 80 % of the blue are in, pour the rest into the beaker with the green."""
    pick, pour = skills_of(env, "1_pick", "2_pour")
    yield from skilled(env, pick)
    script = env.workcell.expert([replace(pour, turn_speed=0.15)])
    script.start()
    liquid = env.workcell.world.liquid
    while liquid.from_in("blue_beaker", "large_beaker") < 0.8 * liquid.originated_in("blue_beaker"):
        yield script.act()
        liquid = env.workcell.world.liquid
    arm = Arm(env)
    level = arm.pose
    lean = env.workcell.world.pose(pick.thing).tilt
    for part in range(1, 31):
        yield arm.at(turned(level, 2, lean * part / 30))
    yield from arm.stay(0.5)
    assert "2_pour/poured" in latched(env)
    yield from skilled(env, replace(pour, into=piece(env, "green_beaker")))
    raise AssertionError("nothing of the blue got into the green")


def put_elsewhere(step: str, ahead: float) -> Play:
    """Set a vessel down some way ahead of where it stood [m], and do the rest as asked."""

    def play(env: LabEnv) -> Actions:
        steps = env.workcell.task.steps
        (wrong,) = skills_of(env, step)
        skills: Sequence[Skill] = [skill for one in steps for skill in one.skills]
        yield from skilled(
            env,
            *(
                replace(one, on=Beside(one.thing, ahead=ahead)) if one is wrong else one
                for one in skills
            ),
        )

    return play


def no_shake(env: LabEnv) -> Actions:
    """Rinse the dirty beaker without shaking it."""
    yield from skilled(
        env, *(skill for skill in env.workcell.task.skills if not isinstance(skill, Shake))
    )


def slam_the_oven(env: LabEnv) -> Actions:
    """Load the oven as asked, and slam its door."""
    yield from until_phase(env, "close/move")
    door, world, arm = env.workcell.task.skills[-1].part, env.workcell.world, Arm(env)
    hand = arm.pose
    for step in range(1, 16):
        yield arm.at(door.carried(hand, world, -math.radians(4.5 * step)))


def glass_against_glass(env: LabEnv) -> Actions:
    """Set the second beaker down so that it touches the first one."""
    steps = [step.name for step in env.workcell.task.steps]
    (last,) = (step for step in steps if step.endswith(("5_place", "6_place")))
    first, second = skills_of(env, f"{int(last[0]) - 2}_place")[0], skills_of(env, last)[0]
    wide = first.thing.footprint_radius + second.thing.footprint_radius - 0.004
    against = replace(second.on, left=first.on.left + wide)
    careless = Careless(replace(second, on=against), frozenset({first.thing.name}))
    yield from skilled(env, *skills_of(env, *steps[: steps.index(last)]), careless)


def start_it_empty(env: LabEnv) -> Actions:
    """Start the empty oven, then load it, and press twice at the end."""
    (*_, press) = env.workcell.task.skills
    yield from skilled(env, press, *env.workcell.task.skills, press)


def with_rests(env: LabEnv) -> Actions:
    """Do as asked, and rest for two seconds after each action."""
    for skill in env.workcell.task.skills:
        yield from skilled(env, skill)
        yield from Arm(env).stay(2.0)


FUSION, CLEAN = "level4/liquid_fusion", "level4/clean_beaker"
DRYING, DEVICE = "level4/drying_beakers", "level4/device_operation"
JOBS = "level4/open_transport_pour"

FAILING = (
    (FUSION, in_this_order("4_pick", "5_pour", "6_place"), "off", "struck or collided"),
    (FUSION, in_this_order("10_press"), "off", "pressed_out_of_turn"),
    (FUSION, into("2_pour", "green_beaker"), "off", "interrupted or spilled"),
    (FUSION, put_elsewhere("3_place", -0.08), "off", "struck"),
    (FUSION, rest_into_the_next, "on", "contaminated"),
    (CLEAN, in_this_order("4_pick"), "off", "struck or collided"),
    (CLEAN, into("2_pour", "waste_beaker"), "off", "interrupted or spilled"),
    slow(CLEAN, no_shake, "off", "interrupted"),
    (DEVICE, start_it_empty, "off", "pressed_out_of_turn"),
    slow(DRYING, glass_against_glass, "off", "struck"),
    slow(DRYING, slam_the_oven, "off", "slammed"),
    slow(JOBS, into("pour", "beaker"), "off", "interrupted or spilled"),
)
"""Task, play, liquid, and what the judge calls it."""

PASSING = (
    (DRYING, with_rests, "off"),
    (CLEAN, with_rests, "off"),
)


@pytest.mark.parametrize(("task", "play", "liquid", "reported"), FAILING)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_person_would_call_a_failure_is_called_by_its_name(
    task: str, play: Play, liquid: str, reported: str, seed: int
):
    assert outcome(begun(task, liquid), play, seed)["outcome"] in reported.split(" or ")


@pytest.mark.parametrize(("task", "play", "liquid"), PASSING)
@pytest.mark.parametrize("seed", SLOW_SEEDS)
def test_a_person_would_pass(task: str, play: Play, liquid: str, seed: int):
    assert outcome(begun(task, liquid), play, seed)["outcome"] == "success"
