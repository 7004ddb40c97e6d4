"""One JSON file for the leaderboard: rows, where they come from, and every action of theirs.

Anyone with the same build plays drawn episodes again from their actions, without the policy, and
must get the same rows to the bit. That shows what the actions do, not whose they are: an expert's
or a copy's look the same.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import Condition
from labutopia_lerobot.evaluation.jobs import EvaluationJob
from labutopia_lerobot.evaluation.load_results import LoadedResult, result_in
from labutopia_lerobot.evaluation.policies import RecordedActions
from labutopia_lerobot.evaluation.result_folder import (
    ACTIONS,
    RESULT,
    SCHEMA,
    decode,
    key_in_run,
    read_actions,
)
from labutopia_lerobot.evaluation.rollout import play
from labutopia_lerobot.evaluation.rows import Row, by_condition, from_columns
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.claim import differences, write_whole
from labutopia_lerobot.setting import (
    CLASSIC,
    DEFAULT_ROOM,
    EXACT,
    OF_THE_LEVEL,
    PARTICLES,
    RULES,
    Setting,
    robot_of_level,
)

FIRST_SEED = 100_000
"""First seed of every published evaluation."""

FEWEST_EPISODES = 100
"""Fewest episodes of every condition, where the number was fixed beforehand."""

PUBLISHED: Mapping[str, object] = {
    "liquid": "on",
    "particles": PARTICLES,
    "reasoner": RULES,
    "room": DEFAULT_ROOM,
    "renderer": CLASSIC,
    "odometry": EXACT,
    "tasks_dir": None,
}
"""Option -> its value in every published evaluation; an earlier version may not have had it. The
robot is that of the level."""

_SPLITS = ("id", "ood")

_OF_THE_POLICY = ("policy", "obs", "device", "renderer", "odometry", "expert_failure")
"""Columns about who played and what it saw: actions that are played again say nothing of it."""


class SubmissionError(UserError):
    """A result that cannot be published or submitted, or a file that is no submission."""


@dataclass(frozen=True)
class Submission:
    """Content of a file of the leaderboard.

    Attributes:
        result: Its rows, and where they come from.
        actions: Their actions, as JSON, in the order of the rows.
    """

    result: LoadedResult
    actions: Sequence[Mapping[str, Any]]


def pack(folder: Path, file: Path) -> None:
    """Write the submission of a finished result.

    Raises:
        SubmissionError: If it is unfinished, an episode's actions are missing, or it is not played
            as published.
    """
    if not (folder / RESULT).is_file():
        raise SubmissionError(
            f"{folder} holds no finished result ({RESULT}). Let the evaluation end first: the same "
            "command goes on where it was"
        )
    result = read_json_object(folder / RESULT, SubmissionError)
    kept = read_actions(folder / ACTIONS)
    rows = [from_columns(Row, columns, folder / RESULT) for columns in result["rows"]]
    missing = [row for row in rows if key_in_run(row) not in kept]
    if missing:
        raise SubmissionError(
            f"{folder / ACTIONS} lacks the actions of {len(missing)} episodes. Evaluate anew"
        )
    content = result | {"actions": [kept[key_in_run(row)] for row in rows]}
    _submission(content, folder / RESULT)
    write_whole(file, content)


def read(file: Path) -> Submission:
    """Return a submission, and make sure that it may be on the leaderboard.

    Raises:
        SubmissionError: If it is none, its summary does not follow from its rows, or it was not
            played as published (see `require_published`).
        UnreadableResultError: If its rows cannot be read.
    """
    return _submission(read_json_object(file, SubmissionError), file)


def require_published(result: LoadedResult) -> None:
    """Make sure that numbers of a result may stand beside those of others.

    Raises:
        SubmissionError: If a condition is not in the published setting, was played by two policies,
            or its episodes are not those of the seeds from 100000 on, each once and in order.
    """
    for name, usual in PUBLISHED.items():
        value = result.config.get(name, usual)
        if value != usual:
            raise SubmissionError(
                f"{result.place} was played with {name}={value}; published is {name}={usual}"
            )
    robot = result.config.get("robot", OF_THE_LEVEL)
    if robot != OF_THE_LEVEL and {robot} != {robot_of_level(row.task) for row in result.rows}:
        raise SubmissionError(
            f"{result.place} was played with robot={robot}; published is robot={OF_THE_LEVEL}"
        )
    played = by_condition(result.rows)
    scenes = [condition.scene for condition, _ in played]
    for (condition, policy), rows in played.items():
        where = f"{result.place}, {condition.description}, {policy}"
        unusual = set(condition.marks()) - {"state"}  # which is shown
        if unusual or condition.split not in _SPLITS:
            raise SubmissionError(
                f"{where}: published are the splits {' and '.join(_SPLITS)} in the default setting"
            )
        if scenes.count(condition.scene) > 1:
            raise SubmissionError(f"{where}: the same episodes are there by another policy")
        seeds = [row.seed for row in rows]
        if seeds != list(range(FIRST_SEED, FIRST_SEED + len(rows))):
            raise SubmissionError(
                f"{where}: its {len(rows)} seeds must be {FIRST_SEED} to "
                f"{FIRST_SEED + len(rows) - 1}, each once and in order"
            )


def _submission(content: Mapping[str, Any], file: Path) -> Submission:
    """Return the submission that a JSON object is; see `read`."""
    if content.get("schema") != SCHEMA:
        raise SubmissionError(
            f"{file} has no schema {SCHEMA}, but {content.get('schema')!r}: evaluate anew, with "
            "this version"
        )
    parts = ("rows", "summary", "actions")
    if not all(isinstance(content.get(part), list) for part in parts):
        raise SubmissionError(f"{file} is no submission: it lacks {', '.join(parts)} or provenance")
    result, actions = result_in(content, file, file), content["actions"]
    if len(result.rows) != len(actions) or not actions:
        raise SubmissionError(f"{file} has {len(result.rows)} rows and {len(actions)} actions")
    try:
        summaries = [summary.columns for summary in result.summaries]
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise SubmissionError(f"{file} is refused: its rows are damaged ({error})") from None
    if json.loads(json.dumps(summaries)) != content["summary"]:
        raise SubmissionError(f"{file} is refused: its summary does not follow from its rows")
    require_published(result)
    _require_episodes(result)
    return Submission(result, actions)


def _require_episodes(result: LoadedResult) -> None:
    """Make sure that the number of episodes was fixed beforehand and is enough, or has a rule."""
    if result.sequential:
        return
    wanted = result.config.get("episodes")
    for summary in result.summaries:
        if summary.n != wanted or summary.n < FEWEST_EPISODES:
            raise SubmissionError(
                f"{result.place} holds {summary.n} episodes of {summary.condition.description}, "
                f"and was to play {wanted}: all of them are wanted, and {FEWEST_EPISODES} at "
                "least, or a run that stops by itself (until=0.05)"
            )


def other_build(submission: Submission) -> list[str]:
    """Return in what the build that played a submission differs from this one, a line for each."""
    tasks = dict.fromkeys(row.task for row in submission.result.rows)
    here = provenance.code(tasks) | {"versions": provenance.versions()}
    compared = {name: here[name] for name in ("sources", "tasks", "versions")}
    return differences(submission.result.provenance, compared)


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
        row = submission.result.rows[index]
        again = _again(submission, index)
        of_policy = {name: getattr(row, name) for name in _OF_THE_POLICY}
        before, after = asdict(row), asdict(replace(again, **of_policy))
        yield row, [name for name in before if before[name] != after[name]]


def _again(submission: Submission, index: int) -> Row:
    row = submission.result.rows[index]
    setting = _setting(row.condition)
    try:
        actions = decode(submission.actions[index])
        elements = len(load_robot(setting.robot).elements)
        if actions.shape[1] != elements:
            raise ValueError(f"actions of {actions.shape[1]} elements, and not of {elements}")
    except ValueError as error:
        raise SubmissionError(f"Row {index}: {error}") from None
    maker = RecordedActions(np.ascontiguousarray(actions, "<f4").tobytes(), actions.shape[1])
    return play(EvaluationJob(setting, row.policy, maker, row.play), row.seed).row


def _setting(condition: Condition) -> Setting:
    """Return in what an episode is played again: nobody looks, and no file is believed."""
    return Setting(
        task=condition.task,
        obs="state",
        split=condition.split,
        axes=condition.axes,
        step=condition.step,
    )
