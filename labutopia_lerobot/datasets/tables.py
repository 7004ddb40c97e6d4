"""Where things are in a dataset of ours, beyond what every LeRobotDataset v3 has; reading tables.

Reads the files directly, so that a look at a dataset costs neither torch nor a cache folder, and
frames a row group at a time, an episode of ours, so that memory does not grow with the dataset.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import Setting

RECORDING = "meta/labutopia.json"
"""Configuration, code, versions, machines, renderers and failures of the recording."""

INFO = "meta/info.json"
TASKS = "meta/tasks.parquet"
STATISTICS = "meta/stats.json"
EPISODES = "meta/episodes"

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
"""Columns of the episode table. JSON: every field of `Setting`; axis -> what was drawn on it; where
the liquid was at the end [ml]; other ways to say the instruction; what the elements of the
privileged state are called; what the numbers of a segmentation, if there is one, mean. Plain: seed,
outcome, cause of a failure (empty for a success), what it was played on, what drew the pictures
(empty where there are none)."""

Row = dict[str, Any]
"""An episode: column of the episode table -> value."""


class DamagedDatasetError(UserError):
    """A file of a dataset is missing or cannot be read; the message names it."""


def read_json(root: Path, name: str) -> dict[str, Any]:
    """Return a JSON file of the dataset.

    Raises:
        DamagedDatasetError: If it is missing or no JSON.
    """
    try:
        content: dict[str, Any] = json.loads((root / name).read_text())
    except (OSError, ValueError) as error:
        raise DamagedDatasetError(f"{root / name} cannot be read: {error}") from None
    return content


def read_episodes(root: Path) -> list[Row]:
    """Return the rows of the episode table, without the statistics.

    What a row does not have, such as one that LeRobot appended, is None.

    Raises:
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    table = _read_tables(root, EPISODES, lambda name: not name.startswith("stats/"))
    rows: list[Row] = table.to_pylist()
    return rows


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


def frames_of_episodes(
    root: Path, info: Mapping[str, Any], episodes: list[Row]
) -> Iterator[tuple[Row, pa.Table]]:
    """Yield episodes with the table of their frames, one row group in memory at a time.

    Args:
        root: Folder of the dataset.
        info: Its `meta/info.json`.
        episodes: Rows of the episode table, in their order.

    Raises:
        DamagedDatasetError: If a file is missing, cannot be read, or lacks frames.
    """
    for (chunk, file), rows in groupby(
        episodes, lambda row: (row["data/chunk_index"], row["data/file_index"])
    ):
        path = root / info["data_path"].format(chunk_index=chunk, file_index=file)
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
    if pa.types.is_string(values.type) or pa.types.is_large_string(values.type):
        return np.array(values.to_pylist())
    return _numbers(values)


def episode_setting(row: Row) -> Setting | None:
    """Return the setting that an episode was recorded in, None where that is not known.

    Options that are new since then have their defaults.

    Raises:
        UnknownTaskError: If its task is no longer there.
    """
    if row.get(SETTING) is None:
        return None
    stored = json.loads(row[SETTING])
    known = {option.name for option in fields(Setting)}
    return Setting(**{name: value for name, value in stored.items() if name in known})


def _numbers(values: pa.ChunkedArray) -> NDArray[Any]:
    flat = values.combine_chunks()
    while pa.types.is_list(flat.type) or pa.types.is_fixed_size_list(flat.type):
        flat = flat.flatten()
    return np.asarray(flat.to_numpy(zero_copy_only=False)).reshape(len(values), -1)


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
            self._held = self._table.read_row_groups(groups)
            self._groups = groups
        return self._held.slice(first - self._starts[groups[0]] if groups else 0, count)


def _read_tables(
    root: Path, folder: str, wanted: Callable[[str], bool] = lambda column: True
) -> pa.Table:
    """Return the tables of a folder as one, those columns of them whose names are wanted."""
    paths = sorted((root / folder).glob("chunk-*/file-*.parquet"))
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
        yield
    except (OSError, pa.ArrowException) as error:
        raise DamagedDatasetError(f"{path} cannot be read: {error}") from None
