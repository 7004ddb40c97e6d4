"""The judge: latching, holding, breaching; in a world that says what the test wants."""

from dataclasses import replace

from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.progress import Progress
from labutopia_lerobot.task import Step, Substep, Task


class Story:
    """A world with nothing but a clock and the names of the facts that hold."""

    def __init__(self) -> None:
        self.time = 0.0
        self.true: set[str] = set()

    movable: tuple[object, ...] = ()
    pressed: frozenset[str] = frozenset()

    def touched_by(self, name: str) -> frozenset[str]:
        return frozenset()


def is_true(world: Story, name: str) -> bool:
    return name in world.true


def fact(name: str) -> Predicate:
    return Predicate(name, is_true, ((name,), {}))


TASK = Task(
    instruction="Do a, then b.",
    start={},
    steps=(Step("do", (), (Substep("first", (fact("a"),)), Substep("second", (fact("b"),)))),),
    goal=(fact("goal"),),
    never={"dropped": fact("drop")},
    time_limit_s=10.0,
)


def tell(progress: Progress, world: Story, *facts: str, steps: int = 1) -> None:
    world.true = set(facts)
    for _ in range(steps):
        progress.update(world)
        world.time += 1 / 30


def test_sub_steps_latch_in_order_only():
    progress, world = Progress(TASK), Story()
    tell(progress, world, "b")
    assert progress.substeps == {"first": None, "second": None}
    tell(progress, world, "a")
    assert progress.substeps["first"] is not None
    assert progress.substeps["second"] is None
    tell(progress, world, "b")
    assert progress.substeps["second"] is not None


def test_a_latched_sub_step_stays():
    progress, world = Progress(TASK), Story()
    tell(progress, world, "a")
    latched = progress.substeps["first"]
    tell(progress, world, steps=5)
    assert progress.substeps["first"] == latched


def test_the_goal_without_its_sub_steps_is_no_success():
    progress, world = Progress(TASK), Story()
    tell(progress, world, "goal", "b", steps=200)
    assert progress.outcome == "running"
    assert not progress.ever


def test_success_comes_two_seconds_after_the_goal_begins_to_hold():
    progress, world = Progress(TASK), Story()
    tell(progress, world, "a", "b", "goal", steps=60)
    assert progress.outcome == "running"
    assert progress.ever
    tell(progress, world, "goal")
    assert progress.outcome == "success"


def test_a_break_in_the_goal_starts_the_clock_again():
    progress, world = Progress(TASK), Story()
    tell(progress, world, "a", "b", "goal", steps=59)
    tell(progress, world)
    tell(progress, world, "goal", steps=60)
    assert progress.outcome == "running"
    tell(progress, world, "goal")
    assert progress.outcome == "success"


def test_a_breach_ends_the_episode_even_in_the_moment_of_success():
    progress, world = Progress(TASK), Story()
    tell(progress, world, "a", "b", "goal", steps=60)
    tell(progress, world, "goal", "drop")
    assert progress.outcome == "dropped"
    tell(progress, world, "goal", steps=100)
    assert progress.outcome == "dropped"


def test_the_time_limit_counts_control_steps():
    progress, world = Progress(TASK), Story()
    tell(progress, world, steps=TASK.max_steps)
    assert progress.outcome == "running"
    tell(progress, world)
    assert progress.outcome == "timeout"


def test_what_is_awaited_is_the_next_of_a_course_with_what_is_kept_and_at_last_the_goal():
    kept, left, end = fact("kept"), fact("left"), fact("end")
    swung = Substep("swung", (end,), via=(left, fact("right")), keeping=(kept,))
    progress, world = Progress(replace(TASK, steps=(Step("swing", (), (swung,)),))), Story()

    def awaited() -> list[str]:
        return [fact.name for fact in progress.awaited]

    assert awaited() == ["left"]
    tell(progress, world, "left", "kept")
    assert awaited() == ["right", "kept"]
    tell(progress, world, "right", "kept")
    assert awaited() == ["end", "kept"]
    tell(progress, world, "end", "kept")
    assert awaited() == ["goal"]


TWO = replace(
    TASK,
    steps=(
        Step("begin", (), (Substep("first", (fact("a"),)),), never={"early": fact("x")}),
        Step("end", (), (Substep("second", (fact("b"),)), Substep("third", (fact("c"),)))),
    ),
)


def test_a_step_that_is_played_alone_is_over_as_soon_as_it_is_done():
    progress, world = Progress(TWO, until="begin"), Story()
    tell(progress, world, "b", "goal", steps=70)
    assert progress.outcome == "running"
    tell(progress, world, "a")
    assert (progress.outcome, progress.ever, progress.step) == ("success", True, None)
    assert progress.substeps["second"] is None


def test_a_step_that_is_played_alone_may_be_spoilt_even_while_it_is_done():
    progress, world = Progress(TWO, until="begin"), Story()
    tell(progress, world, "a", "x")
    assert progress.outcome == "early"


def test_the_last_step_played_alone_is_done_when_the_goal_has_held():
    progress, world = Progress(TWO, after="begin", until="end"), Story()
    tell(progress, world, "a", "x", "goal", steps=70)
    assert progress.outcome == "running"
    tell(progress, world, "b", "c", "goal", steps=60)
    assert progress.outcome == "running"
    tell(progress, world, "goal")
    assert progress.outcome == "success"
