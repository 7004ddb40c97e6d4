"""One JSON file for the leaderboard: rows, where they come from, and every action of theirs.

Whoever has the same build plays drawn episodes again from their actions, without the policy, and
must get the same rows to the bit.
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.result import ACTIONS, RESULT, read_actions
from labutopia_lerobot.evaluation.rollout import Pairing, play
from labutopia_lerobot.evaluation.row import Row, from_columns
from labutopia_lerobot.evaluation.statistics import summarise
from labutopia_lerobot.evaluation.stored_actions import StoredActions, decode
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.claim import differences, write_whole
from labutopia_lerobot.setting import Setting

_OF_THE_POLICY = ("policy", "obs", "device", "renderer", "expert_failure")
"""Columns that tell who played and what was seen: actions that are played again tell nothing."""


class SubmissionError(UserError):
    """A result that cannot be submitted, or a file that is no submission."""


@dataclass(frozen=True)
class Submission:
    """What a file of the leaderboard holds.

    Attributes:
        rows: One per episode.
        summary: What follows from them, as it stands in the file.
        provenance: What they come from (see `origin`).
        actions: Their actions, as JSON, in the order of the rows.
    """

    rows: list[Row]
    summary: list[dict[str, Any]]
    provenance: dict[str, Any]
    actions: list[dict[str, Any]]


def pack(folder: Path, file: Path) -> None:
    """Write the submission of a finished result.

    Raises:
        SubmissionError: If it is unfinished, or an episode's actions are missing.
    """
    if not (folder / RESULT).is_file():
        raise SubmissionError(
            f"{folder} holds no finished result ({RESULT}). Let the evaluation end first: the same "
            "command goes on where it was"
        )
    result = read_json_object(folder / RESULT, SubmissionError)
    kept = read_actions(folder / ACTIONS)
    rows = [from_columns(Row, columns, folder / RESULT) for columns in result["rows"]]
    missing = [row for row in rows if (row.series, row.seed) not in kept]
    if missing:
        raise SubmissionError(
            f"{folder / ACTIONS} lacks the actions of {len(missing)} episodes. Evaluate anew"
        )
    actions = [kept[row.series, row.seed] for row in rows]
    write_whole(file, result | {"actions": actions})


def read(file: Path) -> Submission:
    """Return a submission, and make sure that its summary follows from its rows.

    Raises:
        SubmissionError: If it is none, or its summary does not.
    """
    content = read_json_object(file, SubmissionError)
    parts = ("rows", "summary", "actions")
    lists = [content.get(part) for part in parts]
    told = content.get("provenance")
    if not all(isinstance(part, list) for part in lists) or not isinstance(told, dict):
        raise SubmissionError(f"{file} is no submission: it has no {', '.join(parts)}, provenance")
    rows = [from_columns(Row, columns, file) for columns in content["rows"]]
    if len(rows) != len(content["actions"]) or not rows:
        raise SubmissionError(f"{file} has {len(rows)} rows and {len(content['actions'])} actions")
    computed = json.loads(json.dumps([asdict(summary) for summary in summarise(rows)]))
    if computed != content["summary"]:
        raise SubmissionError(f"{file} is refused: its summary does not follow from its rows")
    return Submission(rows, content["summary"], told, content["actions"])


def other_build(submission: Submission) -> list[str]:
    """Return in what the build that played a submission differs from this one, a line for each."""
    tasks = dict.fromkeys(row.task for row in submission.rows)
    here = provenance.code(tasks) | {"versions": provenance.versions()}
    compared = {name: here[name] for name in ("sources", "tasks", "versions")}
    return differences(submission.provenance, compared)


def replayed(submission: Submission, sample: Sequence[int]) -> Iterator[tuple[Row, list[str]]]:
    """Play episodes again from their actions.

    Args:
        submission: What holds them.
        sample: Indices of rows.

    Yields:
        Each row, and the names of the columns that came out otherwise.

    Raises:
        SubmissionError: If actions cannot be read, or do not fit their row.
    """
    for index in sample:
        row = submission.rows[index]
        again = _again(submission, index)
        told = {name: getattr(row, name) for name in _OF_THE_POLICY}
        before, after = asdict(row), asdict(replace(again, **told))
        yield row, [name for name in before if before[name] != after[name]]


def _again(submission: Submission, index: int) -> Row:
    row, options = submission.rows[index], submission.provenance.get("config", {})
    try:
        actions = decode(submission.actions[index])
    except ValueError as error:
        raise SubmissionError(f"Row {index}: {error}") from None
    setting = Setting(
        task=row.task,
        obs="state",  # nobody looks
        split=row.split,
        axes=tuple(row.axes),
        tasks_dir=options.get("tasks_dir"),
        liquid=row.liquid or "on",
        particles=options.get("particles", Setting.particles),
        robot=row.robot,
        room=row.room,
        step=row.step,
    )
    maker = StoredActions(np.ascontiguousarray(actions, "<f4").tobytes(), actions.shape[1])
    return play(Pairing(setting, row.policy, maker, row.play), row.seed).row
