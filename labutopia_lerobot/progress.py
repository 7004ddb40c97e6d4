"""The memory of an episode: latched sub-steps, the hold clock, the first breach."""

from labutopia_lerobot.task import HOLD_S, INTERRUPTED, Substep, Task
from labutopia_lerobot.world import CONTROL_HZ, World

SUCCESS = "success"
TIMEOUT = "timeout"
DIVERGED = "diverged"
RUNNING = "running"


class Progress:
    """Judges one episode of a task; `update` is called once per control step.

    Attributes:
        facts: Every named predicate of the task, as of the last update.
        substeps: Sub-step name -> time at which it latched [s], or None.
        outcome: "running", "success", "timeout", "diverged", "interrupted" (a sub-step's `keeping`
            broke), or the key of the breached `Task.never`.
        ever: Whether the goal held at any instant after the last sub-step.
    """

    def __init__(self, task: Task) -> None:
        self._task = task
        self._predicates = task.facts
        self._hold_steps = round(HOLD_S * CONTROL_HZ)
        self.start()

    def start(self) -> None:
        """Forget the previous episode."""
        self.facts: dict[str, bool] = dict.fromkeys(self._predicates, False)
        self.substeps: dict[str, float | None] = {step.name: None for step in self._task.substeps}
        self.outcome = RUNNING
        self.ever = False
        self._passed = 0
        self._steps = 0
        self._goal_since: int | None = None

    @property
    def over(self) -> bool:
        """Whether the episode has ended."""
        return self.outcome != RUNNING

    def end(self, outcome: str) -> None:
        """End the episode for a reason that no predicate sees."""
        self.outcome = outcome

    def update(self, world: World) -> None:
        """Judge the present world, one control step after the previous call."""
        if self.over:
            return
        self.facts = {name: fact.holds(world) for name, fact in self._predicates.items()}
        self._latch_substeps(world.time)
        self._clock_the_goal()
        breach = next(
            (name for name, fact in self._task.never.items() if self.facts[fact.name]), None
        )
        if breach is not None:
            self.outcome = breach
        elif self.over:
            return
        elif self._goal_since is not None and self._steps - self._goal_since >= self._hold_steps:
            self.outcome = SUCCESS
        elif self._steps >= self._task.max_steps:
            self.outcome = TIMEOUT
        self._steps += 1

    def _latch_substeps(self, time: float) -> None:
        for substep in self._task.substeps:
            if self.substeps[substep.name] is not None:
                continue
            if not self._pass_through(substep):
                return
            self.substeps[substep.name] = time
            self._passed = 0

    def _pass_through(self, substep: Substep) -> bool:
        """Advance along the sub-step's `via`; tell whether it latches now."""
        begun = self._passed > 0
        while self._passed < len(substep.via) and self.facts[substep.via[self._passed].name]:
            self._passed += 1
        if begun and not all(self.facts[fact.name] for fact in substep.keeping):
            self.outcome = INTERRUPTED
            return False
        arrived = self._passed == len(substep.via)
        return arrived and all(self.facts[fact.name] for fact in substep.when)

    def _clock_the_goal(self) -> None:
        done = all(latched is not None for latched in self.substeps.values())
        if done and all(self.facts[fact.name] for fact in self._task.goal):
            self.ever = True
            self._goal_since = self._steps if self._goal_since is None else self._goal_since
        else:
            self._goal_since = None
