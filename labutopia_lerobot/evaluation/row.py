"""One row of a result: what became of an episode."""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.robots import DEFAULT_ROBOT
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.scenes import DEFAULT_ROOM


class UnreadableResultError(UserError):
    """A result that cannot be read; the message names the file and what is wrong."""


@dataclass(frozen=True)
class Row:
    """What became of one episode: one row of a result file.

    Attributes:
        task: Task id.
        split: `train`, `id` or `ood`.
        axes: Axes that were to vary, or with `ood` to be shifted, beside the task's own.
        drawn: Axis -> what the episode drew on it.
        policy: What the policy is called.
        play: How the sequence was played.
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
    facts: dict[str, bool]
    history: dict[str, dict[str, float | int | None]]
    liquid: str | None
    ml_total: float | None
    ml_poured: float | None
    ml_retained: float | None
    ml_spilled: float | None
    ml_clinging: float | None
    ml_in_flight: float | None
    clipped_actions: int
    nonfinite_actions: int
    # Results of earlier versions lack what follows.
    prelude_failures: int | None = None
    expert_failure: str | None = None
    cause: str | None = None
    device: str | None = None
    renderer: str | None = None
    robot: str = DEFAULT_ROBOT
    room: str = DEFAULT_ROOM


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
        field.name
        for field in known
        if field.name not in columns and field.default is field.default_factory is MISSING
    ]
    if missing:
        raise UnreadableResultError(
            f"{file} lacks the columns {', '.join(missing)}: it is no result of `eval/run.py`, or "
            "of a version too old. Make it anew"
        )
    return kind(**{field.name: columns[field.name] for field in known if field.name in columns})
