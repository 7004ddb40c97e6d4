"""The folder of a result: rows as they come, then everything with its provenance.

`evaluation.json` tells what the rows come from, `rows.jsonl` holds them, `actions.jsonl` what was
commanded, `result.json` says that it is finished. Killed at any moment, the same command goes on
with the rows that are there.
"""

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.row import (
    SINGLE,
    Row,
    Series,
    UnreadableResultError,
    from_columns,
)
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.evaluation.stored_actions import decode, encode
from labutopia_lerobot.runtime.claim import differences, locked, write_whole

ROWS = "rows.jsonl"
"""One JSON row per finished episode, in the order in which they finished."""

ACTIONS = "actions.jsonl"
"""The actions of every episode, written before its row."""

ORIGIN = "evaluation.json"
RESULT = "result.json"
VIDEOS = "videos"


class OccupiedFolderError(UserError):
    """The folder already holds a result, or one of another evaluation."""


class ResultFolder:
    """Writes a result; see `claim`.

    Args:
        path: The folder.

    Attributes:
        path: The folder.
        rows: What an earlier run played, in the order in which it finished.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.rows = read_rows(path / ROWS)

    def add(self, row: Row, actions: NDArray[np.float32]) -> None:
        """Keep a row and its actions, shape (steps, elements), whatever happens next."""
        named = {"task": row.task, "split": row.split, "play": row.play, "seed": row.seed}
        _append(self.path / ACTIONS, named | encode(actions))
        _append(self.path / ROWS, asdict(row))

    def actions(self) -> list[NDArray[np.float32]]:
        """Return the actions of `rows`, in their order, shape (steps, elements) each.

        Raises:
            UnreadableResultError: If they are missing or damaged.
        """
        kept = read_actions(self.path / ACTIONS)
        try:
            return [decode(kept[row.series, row.seed]) for row in self.rows]
        except (KeyError, ValueError) as error:
            raise UnreadableResultError(
                f"{self.path / ACTIONS} lacks actions of a row: {error}. Choose another out="
            ) from None

    def finish(
        self, rows: Sequence[Row], summaries: Sequence[Summary], provenance: dict[str, Any]
    ) -> Path:
        """Write the result file, whole or not at all, and return it.

        Args:
            rows: Every row, ordered by task, split and seed.
            summaries: What follows from them.
            provenance: What they come from (see `origin`).
        """
        result = {
            "rows": [asdict(row) for row in rows],
            "summary": [asdict(summary) for summary in summaries],
            "provenance": provenance,
        }
        write_whole(self.path / RESULT, result)
        return self.path / RESULT


@contextmanager
def claim(path: Path, origin: dict[str, Any]) -> Iterator[ResultFolder]:
    """Begin a result in a folder, or go on with an unfinished one; it is locked meanwhile.

    Args:
        path: The folder; made if it does not exist.
        origin: Whatever decides what the rows are.

    Yields:
        The folder, with the rows that are already there.

    Raises:
        OccupiedFolderError: If it holds a finished result, or one that something else began, or
            another process plays into it.
        UnreadableResultError: If its rows are damaged.
    """
    with locked(path, "out", OccupiedFolderError):
        begun = (path / ORIGIN).exists()
        if (path / RESULT).exists() or ((path / ROWS).exists() and not begun):
            raise OccupiedFolderError(f"out={path} already holds a result. Choose another out=")
        if begun:
            _refuse_other(path, origin)
        else:
            write_whole(path / ORIGIN, origin)
        for file in (path / ROWS, path / ACTIONS):
            _drop_half_a_line(file)
        yield ResultFolder(path)


def film_of(folder: Path, row: Row) -> Path:
    """Return where the film of an episode lies, if there is one."""
    how = [row.play] if row.play != SINGLE else []
    words = [row.task.replace("/", "-"), row.split, *how, f"seed{row.seed}", row.outcome]
    return folder / VIDEOS / f"{'_'.join(words)}.mp4"


def film_of_expert(film: Path) -> Path:
    """Return where the expert's film of the same scene lies, if there is one."""
    return film.with_stem(f"{film.stem}_expert")


def read_rows(file: Path) -> list[Row]:
    """Return the rows of a file of rows; without half a row at its end, which a kill leaves.

    Raises:
        UnreadableResultError: If anything else is no row.
    """
    return [from_columns(Row, columns, file) for columns in _lines(file, "row")]


def read_actions(file: Path) -> dict[tuple[Series, int], dict[str, Any]]:
    """Return series and seed -> the actions of that episode, as JSON (see `stored_actions`).

    Raises:
        UnreadableResultError: If a line of the file holds none, or there is no such file.
    """
    try:
        return {
            ((line["task"], line["split"], line.get("play", SINGLE)), line["seed"]): line
            for line in _lines(file, "action")
        }
    except (OSError, KeyError) as error:
        raise UnreadableResultError(f"{file} holds no actions: {error}") from None


def _lines(file: Path, what: str) -> list[dict[str, Any]]:
    lines = []
    for number, line in enumerate(file.read_text().split("\n")[:-1], start=1):
        try:
            content = json.loads(line)
        except ValueError:
            content = None
        if not isinstance(content, dict):
            raise UnreadableResultError(f"Line {number} of {file} is no {what}: delete that line")
        lines.append(content)
    return lines


def _append(file: Path, content: dict[str, Any]) -> None:
    with file.open("a") as lines:
        lines.write(json.dumps(content) + "\n")
        lines.flush()
        os.fsync(lines.fileno())


def _drop_half_a_line(file: Path) -> None:
    """Cut the file behind its last whole line; make it if it is not there."""
    with file.open("a+b") as rows:
        rows.seek(0)
        rows.truncate(rows.read().rfind(b"\n") + 1)


def _refuse_other(path: Path, origin: dict[str, Any]) -> None:
    there = read_json_object(path / ORIGIN, UnreadableResultError)
    different = differences(there, origin)
    if different:
        raise OccupiedFolderError(
            f"out={path} holds another evaluation, unfinished, or one that other code or weights "
            "began:\n" + "\n".join(different) + "\nChoose another out=, or repeat the command that "
            "began it, with the same code and weights"
        )
