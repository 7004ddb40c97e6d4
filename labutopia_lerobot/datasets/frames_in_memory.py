"""Frames of our state recordings, read from memory while a policy is trained.

For every frame of a batch LeRobot reads tables four times, which takes longer than a step of a
small policy. A recording of states is a few megabytes, so its columns are kept as tensors. What a
training is given stays the same, to the bit. Processes that load for it (`num_workers`) read tables
as ever; the recipes of `policies/` for states have none.
"""

from collections.abc import Callable
from typing import Any

import datasets
import numpy as np
import pyarrow as pa
import torch
from lerobot.datasets.dataset_reader import DatasetReader
from torch import Tensor

_OURS = "annotation.substep"
"""Column that our recordings have and no others."""
_KEPT = "frames_in_memory"

_read_from_tables: Callable[[DatasetReader, int], dict[str, Any]] = DatasetReader.get_item


def keep_frames_in_memory() -> None:
    """Let LeRobot read our recordings of states from memory; others as it always did."""
    DatasetReader.get_item = _get_item


def _get_item(reader: DatasetReader, idx: int) -> dict[str, Any]:
    """Return a frame and what a policy asks for around it, as LeRobot's own function does."""
    if _OURS not in reader._meta.features or reader._meta.camera_keys:
        return _read_from_tables(reader, idx)
    table, kept = reader.hf_dataset, vars(reader).get(_KEPT)
    if kept is None or kept.table is not table:
        kept = vars(reader)[_KEPT] = FramesInMemory(table, reader._meta.tasks.index)
    frames: FramesInMemory = kept
    return frames.item(idx, reader.delta_indices or {})


class FramesInMemory:
    """The columns of a recording, each as a tensor, or as a list of words.

    Args:
        table: Its frames; those of an episode one after the other.
        tasks: Instructions, by `task_index`.
    """

    def __init__(self, table: datasets.Dataset, tasks: Any) -> None:
        self.table, self._tasks = table, list(tasks)
        rows = table.with_format("arrow")[:]
        self._columns = {name: _column(rows.column(name)) for name in rows.column_names}
        episodes = np.asarray(self._columns["episode_index"])
        self._first = np.searchsorted(episodes, episodes, side="left")
        self._behind = np.searchsorted(episodes, episodes, side="right")

    def item(self, index: int, around: dict[str, list[int]]) -> dict[str, Any]:
        """Return a frame.

        Args:
            index: Which of the table.
            around: What else is asked for: columns, with rows counted from this one.
        """
        first, behind = int(self._first[index]), int(self._behind[index])
        frame = {
            name: column[index].clone() if isinstance(column, Tensor) else column[index]
            for name, column in self._columns.items()
        }
        for name, steps in around.items():
            rows = torch.tensor(steps) + index
            frame[f"{name}_is_pad"] = (rows < first) | (rows >= behind)
            frame[name] = self._columns[name][rows.clamp(first, behind - 1)]
        frame["task"] = self._tasks[frame["task_index"]]
        return frame


def _column(column: pa.ChunkedArray) -> Any:
    if pa.types.is_string(column.type):
        return column.to_pylist()
    values = column.combine_chunks()
    if pa.types.is_list(values.type) or pa.types.is_fixed_size_list(values.type):
        numbers = values.flatten().to_numpy(zero_copy_only=False)
        return torch.tensor(numbers.reshape(len(values), -1))
    return torch.tensor(values.to_numpy(zero_copy_only=False))
