"""The memory of an episode: latched substeps, the hold clock, the first breach."""

from dataclasses import dataclass

from labutopia_lerobot.predicates import Count, Predicate
from labutopia_lerobot.predicates.counting import Counter
from labutopia_lerobot.task import (
    HOLD_S,
    INTERRUPTED,
    RUNNING,
    SUCCESS,
    TIMEOUT,
    Step,
    Substep,
    Task,
)
from labutopia_lerobot.world import CONTROL_HZ, World


@dataclass
class History:
    """Times at which a fact held in an episode.

    Attributes:
        first: Time at which it first held [s], or None.
        last: Time at which it last held [s], or None.
        times: How often it came to hold.
        holds: Whether it holds now.
    """

    first: float | None = None
    last: float | None = None
    times: int = 0
    holds: bool = False

    def note(self, holds: bool, time: float) -> None:
        """Take note of whether the fact holds at a time [s]."""
        if holds:
            self.first = time if self.first is None else self.first
            self.last = time
            self.times += not self.holds
        self.holds = holds


class Progress:
    """Judges one episode of a task; `update` is called once per control step.

    Args:
        task: The task to judge.
        after: Step behind which the episode begins: its substeps and those before have latched.
        until: Step with which it ends, as soon as that is done; the last is done when the goal has
            held. None for the last.

    Attributes:
        history: Every named predicate of the task, when it held; what only some steps forbid is
            looked at in those steps.
        substeps: Substep -> time at which it latched [s], or None.
        counted: How much of its count the first substep that has not latched has seen.
        outcome: "running", "success", "timeout", "diverged", "interrupted" (a substep's `keeping`
            broke), or the key of the breach (see `Task.forbidden`).
        ever: Whether the goal held at any instant after the last step, or `until` was done.

    Raises:
        TaskError: If there is no step `after` or `until`.
    """

    def __init__(self, task: Task, after: str | None = None, until: str | None = None) -> None:
        self._task = task
        done = task.steps_until(after) if after is not None else ()
        played = task.steps_until(until) if until is not None else task.steps
        whole = len(played) == len(task.steps)
        self._goal, hold_s = (task.goal, HOLD_S) if whole else ((), 0.0)
        self._hold_steps = round(hold_s * CONTROL_HZ)
        self._course = [(step, substep) for step in played for substep in step.substeps]
        self._latched = sum(len(step.substeps) for step in done)
        self._last = played[-1]
        self._forbidden = {step.name: task.forbidden(step) for step in played}
        self._asked = {
            step: {fact.name: fact for fact in (*task.watched, *forbidden.values())}
            for step, forbidden in self._forbidden.items()
        }
        self.history = {name: History() for name in task.facts}
        self.substeps: dict[str, float | None] = {
            substep.name: 0.0 if index < self._latched else None
            for index, substep in enumerate(task.substeps)
        }
        self.outcome = RUNNING
        self.ever = False
        self.counted = 0.0
        self._counter: Counter | None = None
        self._passed = 0
        self._steps = 0
        self._goal_since: int | None = None

    @property
    def facts(self) -> dict[str, bool]:
        """Every named predicate of the task, as of the last update."""
        return {name: fact.holds for name, fact in self.history.items()}

    @property
    def over(self) -> bool:
        """Whether the episode has ended."""
        return self.outcome != RUNNING

    @property
    def step(self) -> Step | None:
        """The first step that is not done, or None behind the last that is played."""
        return self._course[self._latched][0] if self._latched < len(self._course) else None

    @property
    def awaited(self) -> tuple[Predicate, ...]:
        """Facts that must hold next: those of the first unlatched substep, or else of the goal."""
        if self._latched == len(self._course):
            return self._goal
        substep = self._course[self._latched][1]
        if self._passed == len(substep.via):
            following = substep.when
        else:
            following = (substep.via[self._passed],)
        return (*following, *(substep.keeping if self._passed or self.counted else ()))

    @property
    def counting(self) -> Count | None:
        """The counter of the present substep, or None."""
        if self._latched == len(self._course):
            return None
        return self._course[self._latched][1].count

    @property
    def done_part(self) -> tuple[int, int]:
        """How many of the substeps that are played have latched, and how many these are."""
        return self._latched, len(self._course)

    def end(self, outcome: str) -> None:
        """End the episode for a reason that no predicate sees."""
        self.outcome = outcome

    def update(self, world: World) -> None:
        """Judge the present world, one control step after the previous call."""
        if self.over:
            return
        # What must not happen in the last step must not behind it either.
        step, history, now = (self.step or self._last).name, self.history, world.time
        for name, fact in self._asked[step].items():
            history[name].note(fact.holds(world), now)
        forbidden = self._forbidden[step].items()
        breach = next((name for name, fact in forbidden if history[fact.name].holds), None)
        self._latch(world)
        self._clock_the_goal()
        if breach is not None:
            self.outcome = breach
        elif self.over:
            return
        elif self._goal_since is not None and self._steps - self._goal_since >= self._hold_steps:
            self.outcome = SUCCESS
        elif self._steps >= self._task.max_steps:
            self.outcome = TIMEOUT
        self._steps += 1

    def _holds(self, *facts: Predicate) -> bool:
        return all(self.history[fact.name].holds for fact in facts)

    def _latch(self, world: World) -> None:
        for _, substep in self._course[self._latched :]:
            if not self._pass_through(substep, world):
                return
            self.substeps[substep.name] = world.time
            self._latched += 1
            self._passed, self.counted, self._counter = 0, 0.0, None

    def _pass_through(self, substep: Substep, world: World) -> bool:
        """Advance along the course of a substep; return whether it latches now."""
        course = substep.via
        while self._passed < len(course) and self._holds(course[self._passed]):
            self._passed += 1
        enough, kept = self._passed == len(course), self._holds(*substep.keeping)
        if substep.count is not None and enough:
            if kept or self.counted:
                self._counter = self._counter or substep.count.counter()
                self.counted = self._counter.add(world)
            else:
                self._counter = None  # what comes before is not counted
            enough = self.counted >= substep.count.needed
        if (self._passed or self.counted) and not kept:
            self.outcome = INTERRUPTED
            return False
        return enough and self._holds(*substep.when)

    def _clock_the_goal(self) -> None:
        if self.step is None and self._holds(*self._goal):
            self.ever = True
            self._goal_since = self._steps if self._goal_since is None else self._goal_since
        else:
            self._goal_since = None
