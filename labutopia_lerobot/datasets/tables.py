"""Where things are in a dataset of ours, beyond what every LeRobotDataset v3 has; reading tables.

Reads the files directly, so that a look at a dataset costs neither torch nor a cache folder.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from labutopia_lerobot.errors import UserError

RECORDING = "meta/labutopia.json"
"""Configuration, versions, renderers and failures of the recording."""

INFO = "meta/info.json"
TASKS = "meta/tasks.parquet"
STATISTICS = "meta/stats.json"

SEED = "labutopia/seed"
OUTCOME = "labutopia/outcome"
PHASES = "labutopia/phases"
DRAWN = "labutopia/drawn"
"""Columns of the episode table: seed, outcome, JSON of [label, first frame] of each phase, JSON of
axis -> what the episode drew on it."""


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


def read_episodes(root: Path) -> list[dict[str, Any]]:
    """Return the rows of the episode table, without the statistics.

    Raises:
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    table = _read_tables(root, "meta/episodes")
    plain = [name for name in table.column_names if not name.startswith("stats/")]
    rows: list[dict[str, Any]] = table.select(plain).to_pylist()
    return rows


def read_frames(root: Path) -> pa.Table:
    """Return the table of frames.

    Raises:
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    return _read_tables(root, "data")


def column(table: pa.Table, key: str) -> NDArray[np.float32]:
    """Return a column of vectors, shape (frames, elements)."""
    values = table[key].combine_chunks()
    flat = values.flatten().to_numpy(zero_copy_only=False)
    shaped: NDArray[np.float32] = flat.reshape(len(values), -1)
    return shaped


def _read_tables(root: Path, folder: str) -> pa.Table:
    paths = sorted((root / folder).glob("chunk-*/file-*.parquet"))
    if not paths:
        raise DamagedDatasetError(f"{root / folder} holds no chunk-*/file-*.parquet")
    tables = []
    for path in paths:
        try:
            tables.append(pq.read_table(path, partitioning=None))
        except (OSError, pa.ArrowException) as error:
            raise DamagedDatasetError(f"{path} cannot be read: {error}") from None
    return pa.concat_tables(tables)
