"""The tables of a dataset: episodes, with the columns that are ours, and frames.

Reads the files directly, so that a look at a dataset costs neither torch nor a cache folder, and
frames a row group at a time, an episode of ours, so that memory does not grow with the dataset.

Anybody may have made a dataset. What is read here has the types that it should have, and no text in
it becomes a path: files lie where LeRobot puts them, and links lead nowhere else.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, fields
from itertools import groupby
from pathlib import Path
from typing import Any, TypedDict

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from labutopia_lerobot.datasets.description import DamagedDatasetError, present_name
from labutopia_lerobot.datasets.routes import Routes
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import checked, inside, parse_json, printable
from labutopia_lerobot.registry import UnknownTaskError
from labutopia_lerobot.scenario.own_files import OwnFiles, without_paths
from labutopia_lerobot.setting import Setting

TASKS = "meta/tasks.parquet"
EPISODES = "meta/episodes"

OURS = "labutopia/"
"""Prefix of the columns that are ours."""

SETTING = "labutopia/setting"
SEED = "labutopia/seed"
OUTCOME = "labutopia/outcome"
CAUSE = "labutopia/cause"
DRAWN = "labutopia/drawn"
VOLUMES = "labutopia/volumes"
PARAPHRASES = "labutopia/paraphrases"
PRIVILEGED = "labutopia/privileged"
SEGMENTS = "labutopia/segments"
MACHINE = "labutopia/machine"
RENDERER = "labutopia/renderer"
ROUTES = "labutopia/routes"
CUT = "labutopia/cut"
"""Columns of the episode table. JSON: every field of `Setting`; axis -> what was drawn on it; where
the liquid was at the end [ml]; other ways to say the instruction; what the elements of the
privileged state are called; what the numbers of a segmentation, if there is one, mean; of a robot
with a base, map and planned paths (`routes.Routes`), null where nobody drives; which piece of a
whole episode this is (`Cut`), in datasets that were cut. Plain: seed, outcome, cause of a failure
(empty for a success), what it was played on, what drew the pictures (empty where there are
none)."""

Row = dict[str, Any]
"""An episode: column of the episode table -> value."""


_LOCAL = "tasks_dir"
"""The field of `Setting` that only means something where it was chosen."""

_LARGEST_NUMBER = 2**62

_COUNTED = (
    "episode_index",
    "length",
    "dataset_from_index",
    "dataset_to_index",
    "data/chunk_index",
    "data/file_index",
)
"""Columns that every row of the episode table has: whole numbers from 0 on."""

_WORDS = (OUTCOME, CAUSE, MACHINE, RENDERER)
_JSON = (SETTING, DRAWN, VOLUMES, PARAPHRASES, PRIVILEGED, SEGMENTS, ROUTES, CUT)
"""Our own columns, which a row may lack: texts, and JSON in texts."""


class PlayedIn(TypedDict):
    """Keys that the column `SETTING` always has."""

    task: str


class Cut(TypedDict):
    """Which piece of a whole episode an episode is.

    Attributes:
        step: Name of the step that it is.
        first: Which frame of the whole its first one is.
        pace: How fast the expert's hand moved, as a share of its usual speeds.
        last: Whether the whole ends with it.
    """

    step: str
    first: int
    pace: float
    last: bool


def data_file(root: Path, row: Mapping[str, Any]) -> Path:
    """Return the file in which an episode's frames are (LeRobot, `DEFAULT_DATA_PATH`).

    Raises:
        DamagedDatasetError: If it lies outside the dataset.
    """
    chunk, file = row["data/chunk_index"], row["data/file_index"]
    return inside(root, f"data/chunk-{chunk:03d}/file-{file:03d}.parquet", DamagedDatasetError)


def video_file(root: Path, row: Mapping[str, Any], key: str) -> Path:
    """Return the file in which an episode's video is (LeRobot, `DEFAULT_VIDEO_PATH`).

    Raises:
        DamagedDatasetError: If it lies outside the dataset, or the episode does not name it.
    """
    try:
        chunk, file = (int(row[f"videos/{key}/{part}_index"]) for part in ("chunk", "file"))
    except (KeyError, TypeError, ValueError, OverflowError):
        raise DamagedDatasetError(
            f"{root / EPISODES} does not say where the video {key} of episode "
            f"{row['episode_index']} is"
        ) from None
    name = f"videos/{key}/chunk-{chunk:03d}/file-{file:03d}.mp4"
    return inside(root, name, DamagedDatasetError)


def read_episodes(root: Path) -> list[Row]:
    """Return the rows of the episode table, without the statistics.

    What a row does not have, such as one that LeRobot appended, is None.

    Raises:
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    table = _read_tables(root, EPISODES, lambda name: not name.startswith("stats/"))
    rows: list[Row] = table.to_pylist()
    if not rows:
        raise DamagedDatasetError(f"{root / EPISODES} holds no episode")
    for place, row in enumerate(rows):
        _check_row(row, f"{root / EPISODES}: row {place}")
    return rows


def _check_row(row: Row, where: str) -> None:
    for name in _COUNTED:
        if not _counts(row.get(name)):
            raise DamagedDatasetError(f"{where} has {name} {row.get(name)!r}, which is no number")
    checked(list[str], row.get("tasks"), f"{where}, tasks", DamagedDatasetError)
    if row.get(SEED) is not None and not _counts(row[SEED]):
        raise DamagedDatasetError(f"{where} has {SEED} {row[SEED]!r}, which is no number")
    for name in (*_WORDS, *_JSON):
        if row.get(name) is not None:
            checked(str, row[name], f"{where}, {name}", DamagedDatasetError)
    for name in _JSON:
        if row.get(name) is not None:
            said = parse_json(row[name], f"{where}, {name}", DamagedDatasetError)
            if name == SETTING:
                checked(PlayedIn, said, f"{where}, {name}", DamagedDatasetError)
            elif name == ROUTES:
                checked(Routes | None, said, f"{where}, {name}", DamagedDatasetError)
            elif name == CUT:
                checked(Cut, said, f"{where}, {name}", DamagedDatasetError)


def _counts(value: object) -> bool:
    return type(value) is int and 0 <= value < _LARGEST_NUMBER


def read_episode_statistics(root: Path) -> dict[str, NDArray[np.float64]]:
    """Return the statistics of every episode, `feature/statistic` -> shape (episodes, elements).

    Raises:
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    table = _read_tables(root, EPISODES, lambda name: name.startswith("stats/"))
    return {
        name.removeprefix("stats/"): _numbers(table[name])
        for name in table.column_names
        if not table[name].null_count
    }


def read_frames(root: Path) -> pa.Table:
    """Return the table of all frames.

    Raises:
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    return _read_tables(root, "data")


def frames_of_episodes(root: Path, episodes: list[Row]) -> Iterator[tuple[Row, pa.Table]]:
    """Yield episodes with the table of their frames, one row group in memory at a time.

    Args:
        root: Folder of the dataset.
        episodes: Rows of the episode table, in their order.

    Raises:
        DamagedDatasetError: If a file is missing, cannot be read, or lacks frames.
    """
    for (chunk, file), rows in groupby(
        episodes, lambda row: (row["data/chunk_index"], row["data/file_index"])
    ):
        path = data_file(root, {"data/chunk_index": chunk, "data/file_index": file})
        with _reading(path), pq.ParquetFile(path) as table:
            groups = _RowGroups(table)
            first = groups.rows(0, 1)
            before = first["index"][0].as_py() if first.num_rows else 0
            for row in rows:
                frames = groups.rows(max(row["dataset_from_index"] - before, 0), row["length"])
                if frames.num_rows < row["length"]:
                    raise DamagedDatasetError(
                        f"{path} has {frames.num_rows} frames of episode {row['episode_index']}, "
                        f"not {row['length']}"
                    )
                yield row, frames


def column(table: pa.Table, key: str) -> NDArray[Any]:
    """Return a column, shape (frames, elements); of strings shape (frames,).

    A feature of one element may be stored as numbers or as lists of one.
    """
    values = table[key]
    if values.null_count:
        raise DamagedDatasetError(f"Column {printable(key)} lacks {values.null_count} values")
    if pa.types.is_string(values.type) or pa.types.is_large_string(values.type):
        return np.array(values.to_pylist())
    return _numbers(values)


def setting_column(setting: Setting) -> str:
    """Return what the column `SETTING` holds: files of the user's by their content, no folder."""
    public = without_paths(asdict(setting))
    del public[_LOCAL]
    return json.dumps(public)


def episode_setting(row: Row, tasks_dir: str | None = None) -> Setting | None:
    """Return the setting that an episode was recorded in, None where that is not known.

    Options that are new since then have their defaults. A folder of tasks is never taken from a
    dataset: it holds Python, which would run.

    Args:
        row: Of the episode table.
        tasks_dir: A further folder of tasks, which the user trusts.

    Raises:
        UnknownTaskError: If its task is not there.
        DamagedDatasetError: If there cannot be such a setting.
    """
    if row.get(SETTING) is None:
        return None
    where = f"{SETTING} of episode {row['episode_index']}"
    stored = json.loads(row[SETTING])
    known = {option.name for option in fields(Setting)} - {_LOCAL}
    chosen = {name: value for name, value in stored.items() if name in known}
    try:
        setting = Setting(**chosen, tasks_dir=tasks_dir)
        OwnFiles(setting.room, setting.reasoner).read()  # they must be known here
    except UnknownTaskError as error:
        raise UnknownTaskError(
            f"{error}. If {where} was recorded with a task of somebody's own, and you trust its "
            "file, name its folder with --tasks-dir"
        ) from None
    except (UserError, TypeError, ValueError) as error:
        raise DamagedDatasetError(f"{where} cannot be: {error}") from None
    return setting


def cut_of(row: Row) -> Cut | None:
    """Return which piece of a whole episode an episode is, None if it is whole."""
    cut: Cut | None = json.loads(row.get(CUT) or "null")
    return cut


def _numbers(values: pa.ChunkedArray) -> NDArray[Any]:
    flat = values.combine_chunks()
    while pa.types.is_list(flat.type) or pa.types.is_fixed_size_list(flat.type):
        flat = flat.flatten()
    numbers = np.asarray(flat.to_numpy(zero_copy_only=False))
    if len(values) == 0 or numbers.size % len(values):
        raise DamagedDatasetError(f"A column of {len(values)} rows has {numbers.size} numbers")
    return numbers.reshape(len(values), -1)


class _RowGroups:
    """The rows of a file, of which only the row groups last asked for are in memory.

    Args:
        table: The file.
    """

    def __init__(self, table: pq.ParquetFile) -> None:
        self._table = table
        counts = [table.metadata.row_group(n).num_rows for n in range(table.num_row_groups)]
        self._starts = np.cumsum([0, *counts])
        self._groups: list[int] | None = None
        self._held: pa.Table

    def rows(self, first: int, count: int) -> pa.Table:
        """Return rows; fewer where the file ends."""
        last = min(first + count, self._starts[-1])
        groups = np.flatnonzero((self._starts[:-1] < last) & (self._starts[1:] > first)).tolist()
        if groups != self._groups:
            held = self._table.read_row_groups(groups)
            self._held = held.rename_columns([present_name(name) for name in held.column_names])
            self._groups = groups
        return self._held.slice(first - self._starts[groups[0]] if groups else 0, count)


def _read_tables(
    root: Path, folder: str, wanted: Callable[[str], bool] = lambda column: True
) -> pa.Table:
    """Return the tables of a folder as one, those columns of them whose names are wanted."""
    paths = [
        inside(root, path.relative_to(root), DamagedDatasetError)
        for path in sorted((root / folder).glob("chunk-*/file-*.parquet"))
    ]
    if not paths:
        raise DamagedDatasetError(f"{root / folder} holds no chunk-*/file-*.parquet")
    tables = []
    for path in paths:
        with _reading(path), pq.ParquetFile(path) as table:
            names = table.schema_arrow.names
            tables.append(table.read([name for name in names if wanted(name)]))
    try:
        return pa.concat_tables(tables, promote_options="permissive")
    except pa.ArrowException as error:
        raise DamagedDatasetError(f"{root / folder}: files that do not fit: {error}") from None


@contextmanager
def _reading(path: Path) -> Iterator[None]:
    """Name the file that cannot be read.

    Raises:
        DamagedDatasetError: If it cannot be read.
    """
    try:
        if path.exists() and not path.is_file():
            raise DamagedDatasetError(f"{path} cannot be read: it is no file")
        yield
    except (OSError, LookupError, ValueError, pa.ArrowException) as error:
        raise DamagedDatasetError(f"{path} cannot be read: {error}") from None
