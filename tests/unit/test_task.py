"""A task that is written wrongly says so when it is made, not when somebody is scored by it."""

from dataclasses import replace

import pytest

from labutopia_lerobot.labware.glass.glassware import beaker
from labutopia_lerobot.predicates import Predicate, gripped, lifted, poured, spilled
from labutopia_lerobot.predicates.predicate import same
from labutopia_lerobot.task import Milestone, Step, Task, TaskError

SMALL, LARGE = beaker("small"), beaker("large", "800 ml")
HELD = Milestone("held", (gripped(SMALL),))
TASK = Task(
    instruction="Hold it.",
    start={},
    steps=(Step("hold", (), (HELD,)),),
    goal=(gripped(SMALL),),
    never={},
    time_limit_s=1.0,
)


def test_two_milestones_of_one_name_are_refused_within_and_across_steps():
    with pytest.raises(TaskError, match="Two milestones are called held"):
        replace(TASK, steps=(Step("hold", (), (HELD, HELD)),))
    with pytest.raises(TaskError, match="Two milestones are called held"):
        replace(TASK, steps=(Step("hold", (), (HELD,)), Step("again", (), (HELD,))))


def test_two_steps_of_one_name_are_refused_and_a_renamed_step_renames_its_milestones():
    with pytest.raises(TaskError, match="Two steps are called hold"):
        replace(TASK, steps=TASK.steps * 2)
    (step,) = TASK.steps
    twice = replace(TASK, steps=(step.named("1_hold"), step.named("2_hold")))
    assert [milestone.name for milestone in twice.milestones] == ["1_hold/held", "2_hold/held"]


def test_two_predicates_of_one_name_must_be_the_same():
    taller = Predicate(lifted(SMALL, by=0.1).name, lifted(SMALL, by=0.2).holds)
    with pytest.raises(TaskError, match="Two different predicates are called 'small lifted"):
        replace(TASK, goal=(lifted(SMALL, by=0.1), taller))
    assert replace(TASK, goal=(lifted(SMALL, by=0.1), lifted(SMALL, by=0.1)))


def test_names_carry_their_thresholds():
    assert poured(SMALL, LARGE, share=0.4).name != poured(SMALL, LARGE, share=0.8).name
    assert spilled(SMALL, share=0.01).name != spilled(SMALL, share=0.05).name


def test_equal_calls_make_equal_predicates_and_others_do_not():
    assert same(lifted(SMALL, by=0.1), lifted(SMALL, by=0.1))
    assert not same(lifted(SMALL, by=0.1), lifted(LARGE, by=0.1))
    assert not same(gripped(SMALL), lifted(SMALL, by=0.1))


@pytest.mark.parametrize(
    "outcome",
    ["success", "timeout", "diverged", "interrupted", "running", "broken", "collided"],
)
def test_reserved_outcomes_are_refused(outcome):
    with pytest.raises(TaskError, match=f"reserved outcomes {outcome}"):
        replace(TASK, never={outcome: gripped(SMALL)})
    with pytest.raises(TaskError, match=f"reserved outcomes {outcome}"):
        Step("hold", (), (HELD,), never={outcome: gripped(SMALL)})


def test_a_forgotten_comma_is_told():
    with pytest.raises(TaskError, match="is a comma missing"):
        Milestone("held", (gripped(SMALL)))  # type: ignore[arg-type]
    with pytest.raises(TaskError, match="is a comma missing"):
        replace(TASK, steps=(Step("hold", (), (HELD,))))  # type: ignore[arg-type]


def test_what_is_no_predicate_is_told():
    with pytest.raises(TaskError, match=r"`goal` of the task holds .*which is no Predicate"):
        replace(TASK, goal=(gripped,))  # type: ignore[arg-type]


def test_a_step_that_nothing_tells_is_done_is_refused():
    with pytest.raises(TaskError, match="no milestone"):
        Step("hold", (), ())


def test_an_unknown_step_is_an_error_that_lists_the_steps():
    with pytest.raises(TaskError, match=r"no step 'pour'\. Steps of this task: hold"):
        TASK.steps_until("pour")


def test_not_turns_a_fact_round():
    fact = Predicate("so", lambda world: True)
    assert fact.holds(None)  # type: ignore[arg-type]
    assert not (~fact).holds(None)  # type: ignore[arg-type]
    assert (~fact).name == "not (so)"
