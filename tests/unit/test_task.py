"""A task that is written wrongly says so when it is made, not when somebody is scored by it."""

from dataclasses import replace

import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.places import OverBench
from labutopia_lerobot.predicates import Predicate, Transfer, gripped, lifted
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.task import Step, Substep, Task, TaskError
from labutopia_lerobot.tasks import actions

SMALL, LARGE = (
    glassware("beaker", "250 ml", "small"),
    glassware("beaker", "800 ml", "large"),
)
HELD = Substep("held", (gripped(SMALL),))
TASK = Task(
    instruction="Hold it.",
    start={},
    steps=(Step("hold", (), (HELD,)),),
    goal=(gripped(SMALL),),
    never={},
    time_limit_s=1.0,
)


def test_two_substeps_of_one_name_are_refused_within_and_across_steps():
    with pytest.raises(TaskError, match="Two substeps are called held"):
        replace(TASK, steps=(Step("hold", (), (HELD, HELD)),))
    with pytest.raises(TaskError, match="Two substeps are called held"):
        replace(TASK, steps=(Step("hold", (), (HELD,)), Step("again", (), (HELD,))))


def test_two_steps_of_one_name_are_refused_and_a_renamed_step_renames_its_substeps():
    with pytest.raises(TaskError, match="Two steps are called hold"):
        replace(TASK, steps=TASK.steps * 2)
    (step,) = TASK.steps
    twice = replace(TASK, steps=(step.named("1_hold"), step.named("2_hold")))
    assert [substep.name for substep in twice.substeps] == ["1_hold/held", "2_hold/held"]


def test_two_predicates_of_one_name_must_be_the_same():
    taller = Predicate(lifted(SMALL, by=0.1).name, lambda world: False)
    with pytest.raises(TaskError, match="Two different predicates are called 'small lifted"):
        replace(TASK, goal=(lifted(SMALL, by=0.1), taller))
    assert replace(TASK, goal=(lifted(SMALL, by=0.1), lifted(SMALL, by=0.1)))


@pytest.mark.parametrize(
    "outcome",
    [
        "success",
        "timeout",
        "diverged",
        "interrupted",
        "running",
        "broken",
        "collided",
        "displaced",
        "contaminated",
        "pressed_out_of_turn",
    ],
)
def test_reserved_outcomes_are_refused(outcome):
    with pytest.raises(TaskError, match=f"reserved outcomes {outcome}"):
        replace(TASK, never={outcome: gripped(SMALL)})
    with pytest.raises(TaskError, match=f"reserved outcomes {outcome}"):
        Step("hold", (), (HELD,), never={outcome: gripped(SMALL)})


def test_a_forgotten_comma_is_reported():
    with pytest.raises(TaskError, match="is a comma missing"):
        Substep("held", (gripped(SMALL)))  # type: ignore[arg-type]
    with pytest.raises(TaskError, match="is a comma missing"):
        replace(TASK, steps=(Step("hold", (), (HELD,))))  # type: ignore[arg-type]


def test_what_is_no_predicate_is_reported():
    with pytest.raises(TaskError, match=r"`goal` of the task holds .*which is no Predicate"):
        replace(TASK, goal=(gripped,))  # type: ignore[arg-type]


def test_a_step_that_nothing_says_is_done_is_refused():
    with pytest.raises(TaskError, match="no substep"):
        Step("hold", (), ())


def test_an_unknown_step_is_an_error_that_lists_the_steps():
    with pytest.raises(TaskError, match=r"no step 'pour'\. Steps of this task: hold"):
        TASK.steps_until("pour")


def test_a_thing_can_be_put_down_twice_on_one_bench():
    pick, left, right = (
        actions.pick(SMALL),
        OverBench("left", ahead=0.5, left=0.1),
        OverBench("right", ahead=0.5),
    )
    task = replace(
        TASK,
        steps=(
            pick.named("1_pick"),
            actions.place(SMALL, left, within=0.04).named("2_place"),
            pick.named("3_pick"),
            actions.place(SMALL, right, within=0.04).named("4_place"),
        ),
    )
    assert "small standing on left" in task.facts
    assert "small standing on right" in task.facts


def test_a_step_forbids_what_only_others_touch_and_what_only_others_pour():
    heater = Heater("heater")
    steps = (
        Step("hold", (), (HELD,), (SMALL,)),
        replace(TASK.steps[0], name="wait", substeps=(Substep("a", (gripped(LARGE),)),)),
        Step(
            "press",
            (),
            (Substep("b", (gripped(LARGE),)),),
            (heater.button,),
            transfers=(Transfer(SMALL, LARGE),),
        ),
    )
    task = replace(TASK, steps=steps, contents={SMALL: Filling(ml=10)})
    forbidden = [task.forbidden(step) for step in steps]
    pressed = [of_step["pressed_out_of_turn"].name for of_step in forbidden]
    assert pressed == [
        "any button but small pressed",
        "any button but small pressed",  # the hand leaves it
        "any button but heater_button pressed",
    ]
    poured = [of_step["contaminated"].name for of_step in forbidden]
    assert poured[0] == poured[1] != poured[2]
    assert "small into large" in poured[2]
    displaced = {of_step["displaced"].name for of_step in forbidden}
    assert len(displaced) == 1
    assert "small or heater_button" in displaced.pop()
