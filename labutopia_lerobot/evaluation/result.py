"""The folder of a result: rows as they come, then everything with its provenance.

`evaluation.json` tells what the rows come from, `rows.jsonl` holds them, `result.json` says that it
is finished. Killed at any moment, the same command goes on with the rows that are there.
"""

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.row import Row, UnreadableResultError, from_columns
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.runtime.claim import differences, locked, write_whole

ROWS = "rows.jsonl"
"""One JSON row per finished episode, in the order in which they finished."""

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

    def add(self, row: Row) -> None:
        """Keep a row, whatever happens next."""
        with (self.path / ROWS).open("a") as rows:
            rows.write(json.dumps(asdict(row)) + "\n")
            rows.flush()
            os.fsync(rows.fileno())

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
        _drop_half_a_row(path / ROWS)
        yield ResultFolder(path)


def film_of(folder: Path, row: Row) -> Path:
    """Return where the film of an episode lies, if there is one."""
    name = f"{row.task.replace('/', '-')}_{row.split}_seed{row.seed}_{row.outcome}.mp4"
    return folder / VIDEOS / name


def film_of_expert(film: Path) -> Path:
    """Return where the expert's film of the same scene lies, if there is one."""
    return film.with_stem(f"{film.stem}_expert")


def read_rows(file: Path) -> list[Row]:
    """Return the rows of a file of rows; without half a row at its end, which a kill leaves.

    Raises:
        UnreadableResultError: If anything else is no row.
    """
    rows = []
    for number, line in enumerate(file.read_text().split("\n")[:-1], start=1):
        try:
            columns = json.loads(line)
        except ValueError:
            columns = None
        if not isinstance(columns, dict):
            raise UnreadableResultError(f"Line {number} of {file} is no row: delete that line")
        rows.append(from_columns(Row, columns, file))
    return rows


def _drop_half_a_row(file: Path) -> None:
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
