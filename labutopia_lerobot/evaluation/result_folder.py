"""The folder of a result: rows and actions as they come, then everything with its provenance.

`evaluation.json` says what the rows come from (see `origin`), `rows.jsonl` holds them,
`actions.jsonl` what was commanded, `result.json` says that it is finished. Killed at any moment,
the same command goes on with the rows that are there.
"""

import base64
import json
import os
import zlib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.condition import SINGLE
from labutopia_lerobot.evaluation.rows import (
    EvaluationSummary,
    Row,
    UnreadableResultError,
    from_columns,
)
from labutopia_lerobot.foreign_files import parse_json, read_json_object, read_text
from labutopia_lerobot.runtime.claim import differences, locked, write_whole

ROWS = "rows.jsonl"
"""One JSON row per finished episode, in the order in which they finished."""

ACTIONS = "actions.jsonl"
"""The actions of every episode, written before its row."""

ORIGIN = "evaluation.json"
RESULT = "result.json"
VIDEOS = "videos"

SCHEMA = 1
"""Version of the meaning of a result's columns. A new column leaves it; a new meaning raises it."""

EpisodeKey = tuple[str, str, str, int]
"""Task, split, way of playing and seed: all in which episodes of one run differ."""


_FLOAT = np.dtype("<f4")
_LARGEST = 100_000_000
"""More bytes than the actions of any episode take."""


def encode(actions: NDArray[np.float32]) -> dict[str, Any]:
    """Return actions, shape (steps, elements), as JSON.

    Bytes of the same significance stand together before they are compressed: those of neighbouring
    actions are alike.
    """
    planes = np.ascontiguousarray(actions, _FLOAT).reshape(-1).view(np.uint8)
    content = zlib.compress(planes.reshape(-1, _FLOAT.itemsize).T.tobytes(), 9)
    return {"shape": list(actions.shape), "zlib": base64.b64encode(content).decode()}


def decode(stored: Mapping[str, Any]) -> NDArray[np.float32]:
    """Return the actions that `encode` wrote, shape (steps, elements), to the bit.

    Raises:
        ValueError: If it is nothing that `encode` writes.
    """
    try:
        inflating = zlib.decompressobj()
        content = inflating.decompress(base64.b64decode(stored["zlib"]), _LARGEST)
        planes = np.frombuffer(content, np.uint8).reshape(_FLOAT.itemsize, -1).T
        steps, elements = stored["shape"]
        return planes.copy().view(_FLOAT).reshape(steps, elements)
    except (KeyError, TypeError, zlib.error) as error:
        raise ValueError(f"no stored actions: {error}") from None


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
        named = zip(("task", "split", "play", "seed"), key_in_run(row), strict=True)
        _append(self.path / ACTIONS, dict(named) | encode(actions))
        _append(self.path / ROWS, asdict(row))

    def actions(self) -> list[NDArray[np.float32]]:
        """Return the actions of `rows`, in their order, shape (steps, elements) each.

        Raises:
            UnreadableResultError: If they are missing or damaged.
        """
        kept = read_actions(self.path / ACTIONS)
        try:
            return [decode(kept[key_in_run(row)]) for row in self.rows]
        except (KeyError, ValueError) as error:
            raise UnreadableResultError(
                f"{self.path / ACTIONS} lacks actions of a row: {error}. Choose another out="
            ) from None

    def finish(
        self,
        rows: Sequence[Row],
        summaries: Sequence[EvaluationSummary],
        provenance: dict[str, Any],
    ) -> Path:
        """Write the result file, whole or not at all, and return it.

        Args:
            rows: Every row, ordered by task, split and seed.
            summaries: What follows from them.
            provenance: What they come from (see `origin`).
        """
        result = {
            "schema": SCHEMA,
            "rows": [asdict(row) for row in rows],
            "summary": [summary.columns for summary in summaries],
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
            raise OccupiedFolderError(_finished(path, origin))
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


def key_in_run(row: Row) -> EpisodeKey:
    """Return what distinguishes an episode from the others of its run."""
    return row.task, row.split, row.play, row.seed


def read_actions(file: Path) -> dict[EpisodeKey, dict[str, Any]]:
    """Return the actions of every episode, as JSON (see `stored_actions`).

    Raises:
        UnreadableResultError: If a line of the file holds none, or there is no such file.
    """
    try:
        return {
            (line["task"], line["split"], line.get("play", SINGLE), line["seed"]): line
            for line in _lines(file, "action")
        }
    except (OSError, KeyError) as error:
        raise UnreadableResultError(f"{file} holds no actions: {error}") from None


def _lines(file: Path, what: str) -> list[dict[str, Any]]:
    lines = []
    for number, line in enumerate(read_text(file, UnreadableResultError).split("\n")[:-1], start=1):
        try:
            content = parse_json(line, file, UnreadableResultError)
        except UnreadableResultError:
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


def _finished(path: Path, origin: dict[str, Any]) -> str:
    """Return what to say of a folder with a result, which something else may have made."""
    begun = (path / ORIGIN).exists()
    made_by = read_json_object(path / ORIGIN, UnreadableResultError) if begun else origin
    different = differences(made_by, origin)
    other = ["Another evaluation made it:", *different] if different else []
    read = f"Read it with labutopia-report {path}, or choose another out="
    return "\n".join([f"out={path} already holds a result.", *other, read])


def _refuse_other(path: Path, origin: dict[str, Any]) -> None:
    there = read_json_object(path / ORIGIN, UnreadableResultError)
    different = differences(there, origin)
    if different:
        raise OccupiedFolderError(
            f"out={path} holds another evaluation, unfinished, or one that other code or weights "
            "began:\n" + "\n".join(different) + "\nChoose another out=, or repeat the command that "
            "began it, with the same code and weights"
        )
