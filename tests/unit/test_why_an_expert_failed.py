"""Why an episode was no success, by who judged it and who played it."""

import re
from dataclasses import replace

import pytest

from adversary import begun
from labutopia_lerobot.checks.why import why_failed
from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.progress import Progress
from labutopia_lerobot.task import Step, Substep

YES = Predicate("yes", lambda world: True)
NO = Predicate("no", lambda world: False)
NEARLY = Predicate("nearly", lambda world: False, measure=lambda world: {"mm": 3.14159, "deg": 2})
KNOWN = Predicate("bad", lambda world: True, explain=lambda world: "jar met bench")


@pytest.fixture(scope="module")
def env():
    return begun("level1/pick")


def reported(env, **changes) -> str:
    """Judge a changed task once in the present world; return why its expert has failed."""
    task = replace(env.workcell.task, never={}, **changes)
    progress = Progress(task)
    for _ in range(3):
        progress.update(env.workcell.world)
    assert progress.over
    expert = env.workcell.expert()
    expert.start()
    return "\n".join(why_failed(task, progress, expert, env.workcell.world))


def test_a_breach_is_reported_with_its_fact(env):
    step = Step("do", (), (Substep("done", (NO,)),), never={"bad": YES})
    why = reported(env, steps=(step,), goal=(NO,))
    assert "Ended in step 'do': bad (yes)" in why
    assert "Substeps not reached: done" in why
    assert "Did not hold at the end, for 'done': no" in why


def test_what_makes_a_breach_hold_is_reported_and_by_how_much_a_fact_is_missed(env):
    step = Step("do", (), (Substep("done", (NEARLY,)),), never={"bad": KNOWN})
    why = reported(env, steps=(step,), goal=(NO,))
    assert "Ended in step 'do': bad (bad): jar met bench\n" in why
    assert "Did not hold at the end, for 'done': nearly (off by 3.14 mm, 2 deg)" in why


def test_a_push_that_no_step_allows_is_reported_with_who_what_how_hard_and_the_cure():
    env = begun("level1/pick")
    task = replace(
        env.workcell.task, steps=tuple(replace(s, touches=()) for s in env.workcell.task.steps)
    )
    progress, expert = Progress(task), env.workcell.expert()
    expert.start()
    while not progress.over:
        env.step(expert.act())
        progress.update(env.workcell.world)
    (ending, *_) = why_failed(task, progress, expert, env.workcell.world)
    reported = re.search(r"collided \(.*\): (\w+) pushed flask with ([\d.]+) N", ending)
    assert reported is not None, ending
    assert reported[1] in ("left_pad", "right_pad", "hand")
    assert float(reported[2]) >= 2.0
    assert "name it in `touches` of the step" in ending


def test_what_was_not_kept_is_reported(env):
    substep = Substep("done", (YES,), via=(YES,), keeping=(NO,))
    why = reported(env, steps=(Step("do", (), (substep,)),), goal=(YES,))
    assert "what a substep must keep ceased to hold" in why
    assert "for 'done': no" in why


def test_a_goal_that_did_not_hold_long_enough_is_reported(env):
    step = Step("do", (), (Substep("done", (YES,)),))
    why = reported(env, steps=(step,), goal=(YES,), time_limit_s=0.05)
    assert "Ended in the goal: the time limit of 0.05 s ran out" in why
    assert "Substeps not reached: none" in why
    assert "All held at the end, for the goal, but not for long enough" in why


def test_a_phase_that_was_given_up_and_touches_that_no_phase_lists_are_reported(env):
    task = env.workcell.task
    progress, expert = Progress(task), env.workcell.expert()
    progress.end("diverged")
    expert.start()
    expert.failure = "pick/lower not done after 6 s"
    expert.unexpected["hand", "bench"] = 7
    why = why_failed(task, progress, expert, env.workcell.world)
    assert "Ended in step 'pick': diverged" in why
    assert "Expert: gave up: pick/lower not done after 6 s" in why
    assert "Touched what no phase lists: hand and bench, 7 control steps" in why
