"""One row of a result: what became of an episode."""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field, fields
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.robots import DEFAULT_ROBOT
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.scenes import DEFAULT_ROOM
from labutopia_lerobot.setting import FILAMENT

SINGLE = "single"
"""One policy plays all steps (the paper's SP and, step by step, S1 to Sk)."""

STAGED = "staged"
"""One policy per step, switched on the milestones of the steps (the paper's A1 to Ak)."""

Series = tuple[str, str, str]
"""Task, split and way of playing: what the episodes of one run belong to, one per seed."""


class UnreadableResultError(UserError):
    """A result that cannot be read; the message names the file and what is wrong."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """What became of one episode: one row of a result file.

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
        substeps: Sub-step -> time at which it latched [s], or None.
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
        prelude_failures: Starts that were drawn anew, because the expert could not bring about from
            them what the task begins with.
        expert_failure: Which phase the expert could not finish ("pick/lower not done after 6 s"),
            or None; None for every other policy.
        cause: Why it is no success (see `causes`), or None.
        device: Device of torch that the policy ran on, or None.
        renderer: What drew the pictures that the policy saw, or None.
        robot: What played.
        room: Where.
        step_times: Step (an action of the paper) -> time at which its last sub-step latched [s], or
            None; empty in rows of earlier versions.
        ml_off_target: Liquid missing from where it should have gone, or too much there [ml]; the
            worst of the task's pours (see `precision`). None where nothing is poured.
        mm_off_place: How far a thing, or a finger, is off its place at the end [mm]; the worst.
        deg_off_place: How far it is off its direction at the end [deg]; the worst.
        unwanted_contacts: "what and what" -> control steps in which they touched though they should
            not; None in rows of earlier versions.
        step: The step that was played alone, behind the expert's of those before it; then the row
            has its sub-steps only, and success is that it was done. None for the whole task.
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
    prelude_failures: int | None = None
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

    @property
    def seen_through_filament(self) -> bool:
        """Whether the pictures that the policy saw were Filament's (see `sim.renderers`)."""
        return self.renderer is not None and self.renderer.casefold().startswith(FILAMENT)

    @property
    def series(self) -> Series:
        """Task, split and way of playing."""
        return self.task, self.split, self.play


def from_columns[Kind](kind: type[Kind], columns: Mapping[str, Any], file: Path) -> Kind:
    """Return a dataclass of the columns that it knows; a later version may have added others.

    Args:
        kind: The dataclass.
        columns: Name -> value, as they came from JSON.
        file: Where they came from.

    Raises:
        UnreadableResultError: If a column is missing.
    """
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
    return kind(**{c.name: columns[c.name] for c in known if c.name in columns})
