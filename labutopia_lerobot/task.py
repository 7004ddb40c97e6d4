"""A task is a value: what stands where, what the expert does, what counts as success."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from labutopia_lerobot.layout import Piece, Start
from labutopia_lerobot.predicates import Predicate
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.views import VESSEL_VIEW, View
from labutopia_lerobot.world import CONTROL_HZ

HOLD_S = 2.0
"""How long the goal must hold without a break (paper, "Evaluation Execution")."""


INTERRUPTED = "interrupted"
"""Outcome of an episode in which a sub-step's `keeping` broke."""


@dataclass(frozen=True)
class Substep:
    """A milestone: latched, in the order of the task, once all of `when` holds together.

    Attributes:
        name: A participle; a column of the result tables.
        when: What must hold together at the moment of latching.
        via: What must have held before, one after the other, since the previous sub-step.
        keeping: What must not cease to hold from the first of `via` until the latch; if it does,
            the episode is over.
    """

    name: str
    when: tuple[Predicate, ...]
    via: tuple[Predicate, ...] = ()
    keeping: tuple[Predicate, ...] = ()


@dataclass(frozen=True)
class Task:
    """One benchmark task, shared by demonstration, evaluation and tests.

    Attributes:
        instruction: The canonical instruction, the same string in dataset and environment.
        start: Where each thing stands at the start, as a distribution.
        prelude: Skills that the expert has played when the episode starts, such as the pick
            before a pour (paper: "relies on Pick as a prerequisite").
        expert: The skills that the scripted expert plays, in order.
        substeps: Milestones on the way; they latch in this order.
        goal: What must hold together for `HOLD_S` after the last sub-step.
        never: Outcome that ends the episode -> the fact that must not occur.
        time_limit_s: Simulated time after which the episode is over [s].
        contents: What vessels hold; they are filled when the prelude is over.
        view: Where the two fixed cameras are.
        paraphrases: Other ways to say the instruction.
    """

    instruction: str
    start: Mapping[Piece, Start]
    expert: tuple[Skill, ...]
    substeps: tuple[Substep, ...]
    goal: tuple[Predicate, ...]
    never: Mapping[str, Predicate]
    time_limit_s: float
    prelude: tuple[Skill, ...] = ()
    contents: Mapping[Piece, Filling] = field(default_factory=dict)
    view: View = VESSEL_VIEW
    paraphrases: tuple[str, ...] = ()

    @property
    def max_steps(self) -> int:
        """Control steps of an episode at most."""
        return round(self.time_limit_s * CONTROL_HZ)

    def without_liquid(self) -> "Task":
        """Return the same task with empty vessels: what is poured or spilled is judged by tilts."""
        return replace(self, contents={})

    @property
    def facts(self) -> dict[str, Predicate]:
        """Every named predicate of the task, by name: sub-steps, goal, breaches."""
        milestones = [
            predicate
            for substep in self.substeps
            for predicate in (*substep.via, *substep.keeping, *substep.when)
        ]
        everything = [*milestones, *self.goal, *self.never.values()]
        return {predicate.name: predicate for predicate in everything}
