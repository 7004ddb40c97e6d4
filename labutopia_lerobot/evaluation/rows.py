"""One row per episode, and what follows from rows: one summary per condition and policy."""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import MISSING, asdict, dataclass, field, fields
from functools import cached_property
from pathlib import Path
from statistics import fmean
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import Condition
from labutopia_lerobot.evaluation.uncertainty.anytime import confidence_sequence
from labutopia_lerobot.evaluation.uncertainty.intervals import Interval, exact, wilson
from labutopia_lerobot.foreign_files import checked, types_of
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.setting import (
    CLASSIC,
    DEFAULT_ROBOT,
    DEFAULT_ROOM,
    EXACT,
    FILAMENT,
    PARTICLES,
    RULES,
)

_FORMER_NAMES = {"prelude_failures": "setup_failures"}
"""Column name in results of earlier versions -> its name now."""


class UnreadableResultError(UserError):
    """A result that cannot be read; the message names the file and what is wrong."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """Result of one episode: one row of a result file.

    Attributes:
        task: Task id.
        split: `train`, `id` or `ood`.
        axes: Axes that were to vary, or with `ood` to be shifted, beside the task's own.
        drawn: Axis -> what the episode drew on it.
        policy: What the policy is called.
        play: How its steps were played, `single` or `staged`.
        obs: `pixels` or `state`.
        seed: What the environment was reset with.
        success: Whether the goal held for as long as it must.
        ever_success: Whether the goal held at any instant.
        outcome: How it ended.
        steps: Control steps played.
        seconds: The same in simulated time [s].
        substeps: Substep -> time at which it latched [s], or None.
        facts: Every predicate of the task, as it was at the end.
        history: Predicate -> when it first and last held [s], and how often it came to hold.
        liquid: `on` or `off`; None for a task whose vessels are empty anyway.
        ml_total: Liquid in the scene [ml], the sum of the next five; None without liquid.
        ml_poured: Liquid at the end in other vessels than it was filled into [ml].
        ml_retained: Liquid in the vessels that it was filled into [ml].
        ml_spilled: Liquid on something that can never move, as the bench [ml].
        ml_clinging: Liquid outside on a vessel, or on something that can move [ml].
        ml_in_flight: Liquid outside all vessels that touches nothing [ml].
        clipped_actions: Actions beyond a limit of the robot.
        nonfinite_actions: Actions with an infinite or undefined element.
        setup_failures: Starts that were drawn anew, because the expert could not bring about from
            them what the task begins with.
        expert_failure: Which phase the expert could not finish ("pick/lower not done after 6 s"),
            or None; None for every other policy.
        cause: Why it is no success (see `causes`), or None.
        device: Device of torch that the policy ran on, or None.
        renderer: What drew the pictures that the policy saw, or None.
        robot: What played.
        room: Where.
        step_times: Step (an action of the paper) -> time at which its last substep latched [s], or
            None; empty in rows of earlier versions.
        ml_off_target: Liquid missing from where it should have gone, or too much there [ml]; the
            worst of the task's pours (see `precision`). None where nothing is poured.
        mm_off_place: Distance of a thing, or a finger, from its place at the end [mm]; the worst.
        deg_off_place: Angle of it from its direction at the end [deg]; the worst.
        unwanted_contacts: "what and what" -> control steps in which they touched though they should
            not; None in rows of earlier versions.
        step: The step that was played alone, behind the expert's of those before it; then the row
            has its substeps only, and success is that it was done. None for the whole task.
        particles: In how many particles liquid was divided.
        after: Step behind which the episode began, or None for the start of the task.
        readings: What displays showed at the end, by name; None for dashes and errors.
        solutions: Contents of vessels at the end, by vessel, as `Solution.numbers` has it; None for
            no number. Empty without liquid, and in rows of earlier versions without chemistry.
        unreacted: Why mixtures were left as they were, in words.
        reasoner: Who says what reacts: `rules`, or a language model and the hash of its answers.
        odometry: Where the base was observed to be: as it was, or with the drift of its wheels.
        driving: Of a robot that drives: way driven and shortest way [m], least distances of its
            middle and of its footprint from things [m], SPL, and how far it was at the end from
            where it should dock [m, deg] (see `journey`); None of one that does not.
    """

    task: str
    split: str
    axes: list[str]
    drawn: dict[str, Value]
    policy: str
    play: str
    obs: str
    seed: int
    success: bool
    ever_success: bool
    outcome: str
    steps: int
    seconds: float
    substeps: dict[str, float | None]
    liquid: str | None
    ml_total: float | None
    ml_poured: float | None
    ml_retained: float | None
    ml_spilled: float | None
    ml_clinging: float | None
    ml_in_flight: float | None
    clipped_actions: int
    nonfinite_actions: int
    # Results of earlier versions, and rows that are kept in the repository, lack some of these.
    facts: dict[str, bool] = field(default_factory=dict)
    history: dict[str, dict[str, float | int | None]] = field(default_factory=dict)
    setup_failures: int | None = None
    expert_failure: str | None = None
    cause: str | None = None
    device: str | None = None
    renderer: str | None = None
    robot: str = DEFAULT_ROBOT
    room: str = DEFAULT_ROOM
    step_times: dict[str, float | None] = field(default_factory=dict)
    ml_off_target: float | None = None
    mm_off_place: float | None = None
    deg_off_place: float | None = None
    unwanted_contacts: dict[str, int] | None = None
    step: str | None = None
    particles: int = PARTICLES
    after: str | None = None
    readings: dict[str, float | None] = field(default_factory=dict)
    solutions: dict[str, dict[str, float | None]] = field(default_factory=dict)
    unreacted: list[str] = field(default_factory=list)
    reasoner: str = RULES
    odometry: str = EXACT
    driving: dict[str, float | None] | None = None

    @cached_property
    def condition(self) -> Condition:
        """Under which condition it was played."""
        return Condition(
            task=self.task,
            split=self.split,
            axes=tuple(self.axes),
            play=self.play,
            step=self.step,
            after=self.after,
            liquid=self.liquid,
            particles=self.particles,
            reasoner=self.reasoner,
            robot=self.robot,
            room=self.room,
            obs=self.obs,
            renderer=_kind(self.renderer),
            odometry=self.odometry,
        )

    @property
    def scene(self) -> tuple[Condition, int]:
        """Identity of the scene that the policy met: its condition and the seed."""
        return self.condition.scene, self.seed


def from_columns[Kind](kind: type[Kind], columns: Mapping[str, Any], file: Path) -> Kind:
    """Return a dataclass of the columns that it knows; a later version may have added others.

    Args:
        kind: The dataclass.
        columns: Name -> value, as they came from JSON.
        file: Where they came from.

    Raises:
        UnreadableResultError: If a column is missing, or holds what it cannot.
    """
    refusal = UnreadableResultError
    columns = {_FORMER_NAMES.get(name, name): value for name, value in columns.items()}
    known = fields(kind)  # type: ignore[arg-type]  # mypy cannot say "dataclass"
    missing = [
        column.name
        for column in known
        if column.name not in columns and column.default is column.default_factory is MISSING
    ]
    if missing:
        raise UnreadableResultError(
            f"{file} lacks the columns {', '.join(missing)}: it is no result of `eval/run.py`, or "
            "of a version too old. Make it anew"
        )
    types = types_of(kind)  # type: ignore[arg-type]  # mypy does not know that classes hash
    return kind(
        **{
            c.name: checked(types[c.name], columns[c.name], f"{file}, {c.name}", refusal)
            for c in known
            if c.name in columns
        }
    )


def _kind(renderer: str | None) -> str | None:
    """Return which kind of renderer it is that has a name such as `Filament on llvmpipe`."""
    if renderer is None:
        return None
    return FILAMENT if renderer.casefold().startswith(FILAMENT) else CLASSIC


@dataclass(frozen=True)
class EvaluationSummary:
    """One policy under one condition.

    Attributes:
        policy: What the policy is called.
        condition: Under which condition it played.
        sequential: Whether the run could stop early by its own outcomes (`until`).
        n: Episodes.
        successes: Episodes in which the goal held for as long as it must.
        rate: Share of the successes.
        wilson95: Confidence interval of the rate (see `uncertainty.proportion`).
        exact95: Confidence interval of Clopper and Pearson.
        anytime95: Confidence interval that stays valid whenever one stops (see `anytime`).
        ever_rate: Share of the episodes in which the goal held at any instant.
        substep_rates: Substep -> share of the episodes in which it and all before it latched.
        step_rates: Step -> share of the episodes in which it and all before it were done.
        mean_seconds_to_success: Mean simulated duration of the successes [s], or None.
        outcomes: Outcome -> number of episodes, the most frequent first.
        causes: Why episodes failed (see `causes`) -> number of them, the most frequent first.
    """

    policy: str
    condition: Condition
    sequential: bool
    n: int
    successes: int
    rate: float
    wilson95: Interval
    exact95: Interval
    anytime95: Interval
    ever_rate: float
    substep_rates: dict[str, float] = field(default_factory=dict)
    step_rates: dict[str, float] = field(default_factory=dict)
    mean_seconds_to_success: float | None = None
    outcomes: dict[str, int] = field(default_factory=dict)
    causes: dict[str, int] = field(default_factory=dict)

    @property
    def interval(self) -> Interval:
        """The interval of the rate that is valid for how the number of episodes came about."""
        return self.anytime95 if self.sequential else self.wilson95

    @property
    def label(self) -> str:
        """The name of the policy, with what is unusual about its condition."""
        return self.condition.label(self.policy)

    @property
    def columns(self) -> dict[str, Any]:
        """Everything about it as result files have it, the condition column by column."""
        columns = asdict(self)
        condition: dict[str, Any] = columns.pop("condition")
        return condition | columns


def summarise(rows: Iterable[Row], *, sequential: bool = False) -> list[EvaluationSummary]:
    """Return one summary per condition and policy, in the order in which they first occur.

    Args:
        rows: What to count.
        sequential: Whether the run could stop early by its own outcomes.
    """
    return [
        summary_of(of_one, policy, condition, sequential)
        for (condition, policy), of_one in by_condition(rows).items()
    ]


def by_condition(rows: Iterable[Row]) -> dict[tuple[Condition, str], list[Row]]:
    """Return condition and policy -> their rows; both in the order in which they first occur."""
    groups: dict[tuple[Condition, str], list[Row]] = {}
    for row in rows:
        groups.setdefault((row.condition, row.policy), []).append(row)
    return groups


def summary_of(
    rows: Sequence[Row], policy: str, condition: Condition, sequential: bool
) -> EvaluationSummary:
    """Return the summary of the rows of one policy under one condition."""
    n, successes = len(rows), [row for row in rows if row.success]
    low, high = confidence_sequence(len(successes), n)
    return EvaluationSummary(
        policy=policy,
        condition=condition,
        sequential=sequential,
        n=n,
        successes=len(successes),
        rate=len(successes) / n,
        wilson95=wilson(len(successes), n),
        exact95=exact(len(successes), n),
        anytime95=(float(low), float(high)),
        ever_rate=sum(row.ever_success for row in rows) / n,
        substep_rates=_reached(rows, lambda row: row.substeps),
        step_rates=_reached(rows, lambda row: row.step_times),
        mean_seconds_to_success=fmean(row.seconds for row in successes) if successes else None,
        outcomes=dict(Counter(row.outcome for row in rows).most_common()),
        causes=dict(Counter(row.cause for row in rows if row.cause is not None).most_common()),
    )


def _reached(
    rows: Sequence[Row], times: Callable[[Row], Mapping[str, float | None]]
) -> dict[str, float]:
    """Return name -> share of the episodes that have it in which it has a time."""
    reached: dict[str, list[bool]] = {}
    for row in rows:
        for name, time in times(row).items():
            reached.setdefault(name, []).append(time is not None)
    return {name: sum(each) / len(each) for name, each in reached.items()}
