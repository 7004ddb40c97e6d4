"""A task is a value: what stands where, what is done step by step, what counts as success."""

import reprlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Inside, OnBench, Start
from labutopia_lerobot.predicates import (
    Count,
    Predicate,
    Transfer,
    broken,
    collided,
    contaminated,
    displaced,
    pressed_out_of_turn,
)
from labutopia_lerobot.scenes.views import VESSEL_VIEW, View
from labutopia_lerobot.skills import DriveTo, Face
from labutopia_lerobot.skills.skill import Skill
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import CONTROL_HZ, Thing

HOLD_S = 2.0
"""Time that the goal must hold without a break [s] (paper, "Evaluation Execution")."""

RUNNING = "running"
SUCCESS = "success"
TIMEOUT = "timeout"
DIVERGED = "diverged"
INTERRUPTED = "interrupted"
"""Outcome of an episode in which a substep's `keeping` broke."""
BROKEN = "broken"
"""Outcome of an episode in which something movable was knocked or pressed too hard."""
COLLIDED = "collided"
"""Outcome of an episode in which the robot ran into itself or what the step does not touch."""
DISPLACED = "displaced"
"""Outcome of an episode in which something was moved or felled that no step touches."""
CONTAMINATED = "contaminated"
"""Outcome of an episode in which liquid got into a vessel that it does not belong into."""
PRESSED_OUT_OF_TURN = "pressed_out_of_turn"
"""Outcome of an episode in which a button clicked that the step does not touch."""

POLICY_UNREACHABLE = "policy_unreachable"
"""Outcome of an episode whose policy runs elsewhere and could not be asked any more."""

_RESERVED = {
    RUNNING,
    SUCCESS,
    TIMEOUT,
    DIVERGED,
    INTERRUPTED,
    BROKEN,
    COLLIDED,
    DISPLACED,
    CONTAMINATED,
    PRESSED_OUT_OF_TURN,
    POLICY_UNREACHABLE,
}


class TaskError(UserError, ValueError):
    """A task that is written wrongly; the message names what is wrong and says the cure."""


class NeedsLiquidError(UserError, ValueError):
    """A task that is judged by its liquid is asked for without."""


@dataclass(frozen=True)
class Substep:
    """A moment on the way: latched, in the order of the task, once all of `when` holds together.

    Attributes:
        name: A participle; a column of the result tables.
        when: What must hold together at the moment of latching.
        via: What must have held before, one after the other, since the previous substep.
        keeping: What must not cease to hold from the first of `via`, or of what is counted, until
            the latch; if it does, the episode is over. Nothing is counted while it does not hold.
        count: What must have added up since the previous substep, behind the last of `via`.

    Raises:
        TaskError: If anything is of the wrong kind.
    """

    name: str
    when: tuple[Predicate, ...]
    via: tuple[Predicate, ...] = ()
    keeping: tuple[Predicate, ...] = ()
    count: Count | None = None

    def __post_init__(self) -> None:
        for part in ("when", "via", "keeping"):
            _require_all(Predicate, getattr(self, part), f"`{part}` of '{self.name}'")
        if not isinstance(self.count, Count | None):
            raise TaskError(f"`count` of '{self.name}' is {self.count!r}, which is no Count")

    @property
    def facts(self) -> tuple[Predicate, ...]:
        """Every predicate of the substep."""
        return (*self.via, *self.keeping, *self.when)


@dataclass(frozen=True)
class Step:
    """One action of the paper, such as its "Pick": done when its last substep has latched.

    Attributes:
        name: A verb, such as `pick`.
        skills: What the scripted expert plays.
        substeps: What latches within it, in this order.
        touches: What the hand is to touch, buttons among it: in this step, and in the next one, in
            which the hand leaves it. When arm or hand push against anything else, or a button that
            is not named clicks, the episode ends. What no step of a task names must stay where it
            stands.
        transfers: Liquid poured in this step, from where to where; other liquid that gets into a
            vessel that it was not filled into ends the episode.
        never: Outcome that ends the episode -> the fact that must not occur during this step; of
            the last step also behind it.
        notes: Facts that are reported beside, and judge nothing.

    Raises:
        TaskError: If it has no substep, or anything is of the wrong kind.
    """

    name: str
    skills: tuple[Skill, ...]
    substeps: tuple[Substep, ...]
    touches: tuple[Thing, ...] = ()
    never: Mapping[str, Predicate] = field(default_factory=dict)
    transfers: tuple[Transfer, ...] = ()
    notes: tuple[Predicate, ...] = ()

    def __post_init__(self) -> None:
        _require_all(Skill, self.skills, f"`skills` of step '{self.name}'")
        _require_all(Substep, self.substeps, f"`substeps` of step '{self.name}'")
        _require_all(Transfer, self.transfers, f"`transfers` of step '{self.name}'")
        _require_all(Predicate, self.notes, f"`notes` of step '{self.name}'")
        _require_outcomes(self.never, f"step '{self.name}'")
        if not self.substeps:
            raise TaskError(f"Step '{self.name}' has no substep: name the fact by which it is done")

    def named(self, name: str) -> "Step":
        """Return the same step under another name, which its substeps bear before their own."""
        substeps = (replace(m, name=f"{name}/{m.name}") for m in self.substeps)
        return replace(self, name=name, substeps=tuple(substeps))


@dataclass(frozen=True)
class Task:
    """One benchmark task, shared by demonstration, evaluation and tests.

    Attributes:
        instruction: The canonical instruction, the same string in dataset and environment.
        start: Where each thing stands at the start, as a distribution.
        steps: Steps, in the order in which they are done.
        goal: What must hold together for `HOLD_S` after the last step.
        never: Outcome that ends the episode -> the fact that must not occur at any time.
        time_limit_s: Simulated time after which the episode is over [s].
        setup: Skills that the expert has played when the episode starts, such as the pick
            before a pour (paper: "relies on Pick as a prerequisite").
        contents: What vessels hold from the beginning.
        view: Where the two fixed cameras are.
        paraphrases: Other ways to say the instruction.
        needs_liquid: Whether it cannot be judged without liquid, as by a mass or a temperature.
        drives: Whether the robot drives: it then has a base, and starts somewhere in a furnished
            room, its arm stowed.

    Raises:
        TaskError: If two steps or two substeps share a name, two predicates share a name without
            being the same, an outcome is reserved, anything is of the wrong kind, or something is
            driven to that does not say `drives`.
    """

    instruction: str
    start: Mapping[Piece, Start]
    steps: tuple[Step, ...]
    goal: tuple[Predicate, ...]
    never: Mapping[str, Predicate]
    time_limit_s: float
    setup: tuple[Skill, ...] = ()
    contents: Mapping[Piece, Filling] = field(default_factory=dict)
    view: View = VESSEL_VIEW
    paraphrases: tuple[str, ...] = ()
    needs_liquid: bool = False
    drives: bool = False

    def __post_init__(self) -> None:
        _require_all(Step, self.steps, "`steps` of the task")
        _require_all(Predicate, self.goal, "`goal` of the task")
        _require_all(str, self.paraphrases, "`paraphrases` of the task")
        _require_outcomes(self.never, "the task")
        _require_unique("step", [step.name for step in self.steps])
        _require_unique("substep", [substep.name for substep in self.substeps])
        _require_unique("thing", [piece.name for piece in self.start])
        self._require_said_if_it_drives()
        named: dict[str, Predicate] = {}
        forbidden = (self.forbidden(step).values() for step in self.steps)
        for fact in (*self.watched, *chain(*forbidden)):
            if fact != named.setdefault(fact.name, fact):
                raise TaskError(
                    f"Two different predicates are called '{fact.name}': judging goes by names. "
                    "Name apart what they are about, such as two places, or make them with "
                    "`@predicate`, whose names show every argument"
                )

    def _require_said_if_it_drives(self) -> None:
        if self.drives:
            return
        starts = (
            f"`{piece.name}` starts {type(region).__name__}"
            for piece, region in self.start.items()
            if not isinstance(region, OnBench | Inside)
        )
        played = (
            f"its expert plays {type(skill).__name__}"
            for skill in (*self.setup, *self.skills)
            if isinstance(skill, DriveTo | Face)
        )
        for why in chain(starts, played):
            raise TaskError(f"One drives in this task, as {why}: say `drives=True`")

    @property
    def substeps(self) -> tuple[Substep, ...]:
        """The substeps of all steps, in order."""
        return tuple(substep for step in self.steps for substep in step.substeps)

    @property
    def skills(self) -> tuple[Skill, ...]:
        """The skills of all steps, in order."""
        return tuple(skill for step in self.steps for skill in step.skills)

    @property
    def max_steps(self) -> int:
        """Control steps of an episode at most."""
        return round(self.time_limit_s * CONTROL_HZ)

    @property
    def watched(self) -> tuple[Predicate, ...]:
        """Facts that are evaluated at every control step, whichever step is being done."""
        steps = (
            (*(fact for substep in step.substeps for fact in substep.facts), *step.notes)
            for step in self.steps
        )
        return (*chain(*steps), *self.goal, *self.never.values())

    @property
    def facts(self) -> dict[str, Predicate]:
        """Every named predicate of the task, by name: `watched`, and what steps forbid."""
        forbidden = (self.forbidden(step).values() for step in self.steps)
        return {fact.name: fact for fact in (*self.watched, *chain(*forbidden))}

    def forbidden(self, step: Step | None) -> dict[str, Predicate]:
        """Return outcome -> what must not occur during a step: what it says, and the task, and all.

        Args:
            step: One of the steps; None before the first, while the setup is played.
        """
        index = len(self.steps) if step is None else self.steps.index(step)
        near = self.steps if step is None else self.steps[max(index - 1, 0) : index + 1]
        touched = _things_of(near)
        poured = (transfer for past in self.steps[: index + 1] for transfer in past.transfers)
        return {
            **self.never,
            **({} if step is None else step.never),
            BROKEN: broken(),
            COLLIDED: collided(*touched),
            DISPLACED: displaced(*_things_of(self.steps)),
            PRESSED_OUT_OF_TURN: pressed_out_of_turn(*touched),
            **({CONTAMINATED: contaminated(*poured)} if self.contents else {}),
        }

    def steps_until(self, name: str) -> tuple[Step, ...]:
        """Return the steps up to and with the one of this name.

        Raises:
            TaskError: If there is none; the message lists the steps.
        """
        names = [step.name for step in self.steps]
        if name not in names:
            raise TaskError(f"There is no step '{name}'. Steps of this task: {', '.join(names)}")
        return self.steps[: names.index(name) + 1]

    def without_liquid(self, name: str) -> "Task":
        """Return the same task with empty vessels: what is poured or spilled is judged by tilts.

        Args:
            name: Of the task, for what is raised.

        Raises:
            NeedsLiquidError: If the task needs its liquid.
        """
        dissolving = [vessel.name for vessel, held in self.contents.items() if held.reacts]
        if dissolving:
            raise NeedsLiquidError(
                f"liquid=off: {name} has solutions in {', '.join(dissolving)}, which only its "
                "liquid can show. Choose liquid=on"
            )
        if self.needs_liquid:
            raise NeedsLiquidError(f"liquid=off: {name} is judged by its liquid. Choose liquid=on")
        return replace(self, contents={})


def _things_of(steps: Iterable[Step]) -> list[Thing]:
    """Return everything that steps touch, each once."""
    return list({thing.name: thing for step in steps for thing in step.touches}.values())


def _require_all(kind: type, items: object, where: str) -> None:
    """Make sure that something is a tuple of one kind of thing."""
    if not isinstance(items, tuple):
        cure = " (is a comma missing?)" if isinstance(items, kind) else ""
        raise TaskError(f"{where} must be a tuple, not {_in_short(items)}{cure}")
    for item in items:
        if not isinstance(item, kind):
            raise TaskError(f"{where} holds {_in_short(item)}, which is no {kind.__name__}")


def _in_short(item: object) -> str:
    """Return what something is: a thing or fact by its name, else as Python shows it."""
    name = getattr(item, "name", None)
    return reprlib.repr(item) if name is None else f"the {type(item).__name__} '{name}'"


def _require_outcomes(never: Mapping[str, Predicate], where: str) -> None:
    reserved = _RESERVED & never.keys()
    if reserved:
        raise TaskError(
            f"`never` of {where} uses the reserved outcomes {', '.join(sorted(reserved))}: "
            "call them otherwise"
        )
    _require_all(Predicate, tuple(never.values()), f"`never` of {where}")


def _require_unique(kind: str, names: list[str]) -> None:
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise TaskError(f"Two {kind}s are called {', '.join(sorted(twice))}: name them apart")
