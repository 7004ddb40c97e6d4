"""Attacks on what turns, mixers and centrifuges, and odd ways to use them that are right."""

from dataclasses import replace

import pytest

from attacks.arm import Actions, Arm
from attacks.plays import Play, begun, outcome, reached, skilled, until_phase
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.skills import Insert, Pick, Press, PressInto, PushLid, WaitUntilReads
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.skills.turn_knob import TurnKnob

pytestmark = pytest.mark.slow  # half a minute each: a tube on a mixer takes 19 s, a run 28


def one[S: Skill](env: LabEnv, kind: type[S], number: int = 0) -> S:
    """Return a skill of the task, of those of a kind."""
    return [skill for skill in env.workcell.task.skills if isinstance(skill, kind)][number]


def a_moment_only(env: LabEnv) -> Actions:
    """Press the tube into the cup for half a second, and put it back."""
    short = replace(one(env, PressInto), seconds=0.5)
    yield from skilled(env, one(env, Pick), short, one(env, Insert))


def shaken_in_the_air(env: LabEnv) -> Actions:
    """Shake the tube beside the mixer as fast as the arm can, for four seconds, and put it back."""
    yield from skilled(env, one(env, Pick))
    arm = Arm(env)
    here = arm.pose
    for _ in range(8):
        yield from arm.go(here.moved(y=0.05), speed=0.4)
        yield from arm.go(here, speed=0.4)
    yield from skilled(env, one(env, Insert))


def rested_in_the_cup(env: LabEnv) -> Actions:
    """Stand the tube in the cup so lightly that it does not run, wait, and put it back."""
    yield from until_phase(env, "pressinto/press")
    arm = Arm(env)
    home = arm.pose
    yield from arm.go(home.moved(z=-0.0065), speed=0.02)
    yield from arm.stay(4.0)
    yield from arm.go(home.moved(z=0.08))
    yield from skilled(env, one(env, Insert))


def in_two_goes(env: LabEnv) -> Actions:
    """Press for a second, lift the tube and look at it, press again for long enough."""
    press = one(env, PressInto)
    yield from skilled(env, one(env, Pick), replace(press, seconds=1.0), press, one(env, Insert))


def pressed_harder(env: LabEnv) -> Actions:
    """Press the cup down to its stop, and hold the tube there for two seconds more."""
    press = one(env, PressInto)
    longer = replace(press, depth=press.depth + 0.003, seconds=press.seconds + 2.0)
    yield from skilled(env, one(env, Pick), longer, one(env, Insert))


def with_the_lid_open(env: LabEnv) -> Actions:
    """Press start before the lid is shut: it is refused, and then everything as asked."""
    yield from skilled(env, one(env, Press), *env.workcell.task.skills)


def too_short(env: LabEnv) -> Actions:
    """Stop two seconds after the start, while it speeds up."""
    first, second = one(env, Press), one(env, Press, 1)
    yield from skilled(env, one(env, PushLid), first, second)


def not_stopped(env: LabEnv) -> Actions:
    """Start it and let it run on."""
    yield from skilled(env, one(env, PushLid), one(env, Press), one(env, WaitUntilReads))


def pushed_further_in(env: LabEnv) -> Actions:
    """Push the lid 4 cm behind its front edge, wait for two seconds, and do the rest as asked."""
    _, *rest = env.workcell.task.skills
    yield from skilled(env, replace(one(env, PushLid), inward=0.04))
    yield from Arm(env).stay(2.0)
    yield from skilled(env, *rest)


def another_speed(env: LabEnv) -> Actions:
    """Turn the knob by 40 degrees too little and take the hand away."""
    knob = one(env, TurnKnob)
    yield from skilled(env, replace(knob, to=knob.to - 0.7))


def back_and_forth(env: LabEnv) -> Actions:
    """Turn the knob too far first, and back."""
    knob = one(env, TurnKnob)
    yield from skilled(env, replace(knob, to=knob.to + 0.5), knob)


def loaded_into(env: LabEnv, *bores: int) -> Actions:
    """Load tubes into bores by their numbers, shut the lid, start, wait for 15 s, and stop."""
    places = next(iter(env.workcell.task.start)).places
    for number, bore in enumerate(bores):
        into = replace(one(env, Insert, number), into=places[bore])
        yield from skilled(env, one(env, Pick, number), into)
    yield from skilled(env, one(env, PushLid), one(env, Press))
    yield from Arm(env).stay(15.0)
    yield from skilled(env, one(env, Press, 1))


def side_by_side(env: LabEnv) -> Actions:
    """Load both tubes into neighbouring bores."""
    yield from loaded_into(env, 2, 4)


def one_tube_alone(env: LabEnv) -> Actions:
    """Load one tube only, and start."""
    yield from loaded_into(env, 2)


def without_tubes(env: LabEnv) -> Actions:
    """Shut the empty centrifuge, and start."""
    yield from loaded_into(env)


def under_the_open_lid(env: LabEnv) -> Actions:
    """Load both tubes, and press start with the lid open."""
    yield from skilled(env, *env.workcell.task.skills[:4], one(env, Press))


def stopped_at_once(env: LabEnv) -> Actions:
    """Stop it while it speeds up, and do the rest as asked."""
    skills = env.workcell.task.skills
    waits = [n for n, skill in enumerate(skills) if isinstance(skill, WaitUntilReads)]
    yield from skilled(env, *(skill for n, skill in enumerate(skills) if n not in waits))


def one_tube_left_in(env: LabEnv) -> Actions:
    """Do all of it but take the second tube out."""
    yield from skilled(env, *env.workcell.task.skills[:-2])


def across_and_in_another_order(env: LabEnv) -> Actions:
    """Use the bores at the back and in front, begin with the second tube, rack them elsewhere."""
    centrifuge, rack, *_ = env.workcell.task.start
    for number, bore in ((1, 4), (0, 0)):
        into = replace(one(env, Insert, number), into=centrifuge.places[bore])
        yield from skilled(env, one(env, Pick, number), into)
    yield from skilled(env, *env.workcell.task.skills[4:-4])
    for number, opening in ((3, 10), (2, 7)):
        back = replace(one(env, Insert, number), into=rack.places[opening])
        yield from skilled(env, one(env, Pick, number), back)


UNDONE = (
    ("level1/set_speed", another_speed, ""),
    ("level2/vortex_tube", a_moment_only, "running"),
    ("level2/vortex_tube", shaken_in_the_air, "lifted"),
    ("level2/vortex_tube", rested_in_the_cup, "lifted"),
    ("level2/spin_centrifuge", too_short, "start/pressed"),
    ("level2/spin_centrifuge", not_stopped, "spun"),
    ("level4/centrifuge_pair", side_by_side, "start/pressed"),
    ("level4/centrifuge_pair", one_tube_alone, "one_loaded"),
    ("level4/centrifuge_pair", without_tubes, ""),
    ("level4/centrifuge_pair", under_the_open_lid, "both_loaded"),
    ("level4/centrifuge_pair", stopped_at_once, "start/pressed"),
    ("level4/centrifuge_pair", one_tube_left_in, "one_racked"),
)
"""Task, play, and how far the judge thinks it has come when it is over."""

PASSING = (
    ("level1/set_speed", back_and_forth),
    ("level2/vortex_tube", in_two_goes),
    ("level2/vortex_tube", pressed_harder),
    ("level2/spin_centrifuge", pushed_further_in),
    ("level4/centrifuge_pair", across_and_in_another_order),
)


def environment(task: str) -> LabEnv:
    return begun(task, "on" if task == "level2/vortex_tube" else "off")


@pytest.mark.parametrize(("task", "play", "last"), UNDONE)
def test_what_is_only_half_done_does_not_count(task: str, play: Play, last: str):
    info = outcome(environment(task), play, 0)
    assert info["outcome"] != "success"
    assert (reached(info) or [""])[-1] == last


@pytest.mark.parametrize(("task", "play"), PASSING)
def test_a_person_would_pass(task: str, play: Play):
    assert outcome(environment(task), play, 0)["outcome"] == "success"


def test_a_start_with_an_open_lid_is_refused_and_out_of_turn():
    env = environment("level2/spin_centrifuge")
    info = outcome(env, with_the_lid_open, 0)
    assert info["outcome"] == "pressed_out_of_turn"
    assert info["readings"]["centrifuge_rpm"] == 0.0
