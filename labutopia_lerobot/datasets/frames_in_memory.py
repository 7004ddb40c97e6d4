"""Frames of our recordings, read from memory while a policy is trained.

For every frame of a batch LeRobot reads tables four times and opens a video per camera, which takes
longer than a step of a small policy. The columns of a recording are a few megabytes, so they are
kept as tensors; its pictures are kept as bytes where half of the free memory holds them. What a
training is given stays the same, to the bit. Processes that load for it (`num_workers`) read files
as ever; the recipes of `policies/` for states have none.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import datasets
import numpy as np
import pyarrow as pa
import torch
from lerobot.datasets.dataset_reader import DatasetReader
from lerobot.datasets.video_utils import decode_video_frames
from torch import Tensor
from torch.utils.data import get_worker_info

from labutopia_lerobot.runtime.memory import free_memory_bytes

_OURS = "annotation.substep"
"""Column that our recordings have and no others."""
_KEPT = "frames_in_memory"

_read_from_files: Callable[[DatasetReader, int], dict[str, Any]] = DatasetReader.get_item


def keep_frames_in_memory() -> None:
    """Let LeRobot read our recordings from memory; others as it always did."""
    DatasetReader.get_item = _get_item


def _get_item(reader: DatasetReader, idx: int) -> dict[str, Any]:
    """Return a frame and what a policy asks for around it, as LeRobot's own function does."""
    table, kept = reader.hf_dataset, vars(reader).get(_KEPT)
    if kept is None or kept.table is not table:
        if _OURS not in reader._meta.features or not (_fits(reader) and _plain(table)):
            return _read_from_files(reader, idx)
        kept = vars(reader)[_KEPT] = FramesInMemory(
            table, reader._meta.tasks.index, _pictures_of(reader)
        )
    frames: FramesInMemory = kept
    frame = frames.item(idx, reader.delta_indices or {})
    for camera in reader._meta.camera_keys:
        if not reader._return_uint8:
            frame[camera] = frame[camera].type(torch.float32) / 255
        if reader._image_transforms is not None:
            frame[camera] = reader._image_transforms(frame[camera])
    return frame


def _plain(table: datasets.Dataset) -> bool:
    """Return whether columns are words, numbers and lists of numbers: those of language are not."""
    types = table.data.schema.types  # `features` would be copied, frame by frame
    inner = [getattr(each, "value_type", each) for each in types]
    return not any(pa.types.is_nested(each) for each in inner)


def _fits(reader: DatasetReader) -> bool:
    """Return whether the pictures are colours in videos, read here, for which there is room."""
    meta = reader._meta
    if not meta.camera_keys:
        return True
    if get_worker_info() or meta.depth_keys or meta.image_keys:
        return False
    pixels = sum(np.prod(meta.features[camera]["shape"]) for camera in meta.camera_keys)
    return bool(len(reader.hf_dataset) * pixels < free_memory_bytes() / 2)


def _pictures_of(reader: DatasetReader) -> dict[str, Tensor]:
    """Return all pictures, by camera, as bytes; cameras have a file of their own and a thread."""
    cameras = reader._meta.camera_keys
    if not cameras:
        return {}
    with ThreadPoolExecutor(len(cameras)) as threads:
        filmed = threads.map(lambda camera: _filmed(reader, camera), cameras)
        return dict(zip(cameras, filmed, strict=True))


def _filmed(reader: DatasetReader, camera: str) -> Tensor:
    """Return the pictures of a camera, one per row of the table; shape (rows, 3, height, width)."""
    rows = reader.hf_dataset.with_format("numpy", ["episode_index", "timestamp"])[:]
    episodes, times_s = rows["episode_index"], rows["timestamp"].astype(float)
    height, width, _ = reader._meta.features[camera]["shape"]
    pictures = torch.empty((len(episodes), 3, height, width), dtype=torch.uint8)
    for episode in np.unique(episodes):
        of_it = np.flatnonzero(episodes == episode)
        begin_s = reader._meta.episodes[int(episode)][f"videos/{camera}/from_timestamp"]
        pictures[of_it] = decode_video_frames(
            reader.root / reader._meta.get_video_file_path(int(episode), camera),
            (begin_s + times_s[of_it]).tolist(),
            reader._tolerance_s,
            reader._video_backend,
            return_uint8=True,
        )
    return pictures


class FramesInMemory:
    """The columns of a recording, each as a tensor, or as a list of words.

    Args:
        table: Its frames; those of an episode one after the other.
        tasks: Instructions, by `task_index`.
        pictures: One per frame, by camera.
    """

    def __init__(
        self, table: datasets.Dataset, tasks: Sequence[str], pictures: dict[str, Tensor]
    ) -> None:
        self.table, self._tasks = table, list(tasks)
        rows = table.with_format("arrow")[:]
        columns = {name: _column(rows.column(name)) for name in rows.column_names}
        self._columns = {**pictures, **columns}
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
