"""Frames of a dataset are read as they are asked for, however they are stored."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from labutopia_lerobot.datasets.description import DamagedDatasetError
from labutopia_lerobot.datasets.tables import Row, column, frames_of_episodes

INFO = {"data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"}
LENGTHS = (7, 1, 12, 5, 9)


def stored(
    root: Path, rows_of_a_group: int, lengths: Sequence[int] = LENGTHS, width: int = 1
) -> list[Row]:
    """Write a file with row groups of a size; return the rows of its episodes."""
    count = sum(lengths)
    numbers = np.arange(count * width, dtype=np.float64).reshape(count, width)
    wide = pa.FixedSizeListArray.from_arrays(pa.array(numbers.ravel()), width)
    table = pa.table({"index": pa.array(np.arange(count)), "state": wide})
    path = root / INFO["data_path"].format(chunk_index=0, file_index=0)
    path.parent.mkdir(parents=True)
    pq.write_table(table, path, row_group_size=rows_of_a_group)
    firsts = np.cumsum([0, *lengths[:-1]]).tolist()
    place: dict[str, Any] = {"data/chunk_index": 0, "data/file_index": 0}
    return [
        place | {"episode_index": number, "dataset_from_index": first, "length": length}
        for number, (first, length) in enumerate(zip(firsts, lengths, strict=True))
    ]


@pytest.mark.parametrize("rows_of_a_group", [1, 3, 7, 34, 1000])
def test_every_episode_gets_its_frames_whatever_the_row_groups(
    tmp_path: Path, rows_of_a_group: int
) -> None:
    rows = stored(tmp_path, rows_of_a_group)
    for row, frames in frames_of_episodes(tmp_path, rows):
        first = row["dataset_from_index"]
        assert column(frames, "state")[:, 0].tolist() == list(range(first, first + row["length"]))


def test_episodes_are_found_in_any_order(tmp_path: Path) -> None:
    rows = stored(tmp_path, 4)[::-1]
    firsts = [frames["index"][0].as_py() for _, frames in frames_of_episodes(tmp_path, rows)]
    assert firsts == [row["dataset_from_index"] for row in rows]


def test_one_row_group_is_in_memory_and_not_the_file(tmp_path: Path) -> None:
    groups = 40
    rows = stored(tmp_path, 10, [10] * groups, width=10_000)
    before, most = pa.total_allocated_bytes(), 0
    for _ in frames_of_episodes(tmp_path, rows):
        most = max(most, pa.total_allocated_bytes() - before)
    group = 10 * 10_000 * 8
    assert group <= most < groups / 2 * group  # Arrow's threads keep a few more on a busy machine


def test_frames_that_a_file_lacks_are_named(tmp_path: Path) -> None:
    rows = stored(tmp_path, 4)
    rows[-1]["length"] += 1
    with pytest.raises(DamagedDatasetError, match="9 frames of episode 4, not 10"):
        list(frames_of_episodes(tmp_path, rows))
