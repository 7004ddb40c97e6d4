"""Taking a finished dataset apart: its episodes become the candidates that they were.

Recording more episodes then goes on as if the recording had been interrupted before its end.
"""

import json
import shutil
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from labutopia_lerobot.datasets.annotations import annotated_candidate
from labutopia_lerobot.datasets.candidate import (
    COLORS,
    COLUMNS,
    SUMMARY,
    UNFINISHED,
    Candidate,
    candidate_folder,
    candidate_of,
)
from labutopia_lerobot.datasets.declaration import IMAGES
from labutopia_lerobot.datasets.description import (
    RECORDING,
    DamagedDatasetError,
    read_info,
    read_recording,
)
from labutopia_lerobot.datasets.frames import Columns
from labutopia_lerobot.datasets.tables import (
    Row,
    column,
    frames_of_episodes,
    read_episode_statistics,
    read_episodes,
    video_file,
)
from labutopia_lerobot.pictures import camera_and_kind
from labutopia_lerobot.runtime.video import copy_frames
from labutopia_lerobot.setting import DEPTH

_MADE_BY_LEROBOT = ("timestamp", "frame_index", "episode_index", "index", "task_index")


def restore_candidates(root: Path, work: Path) -> None:
    """Put the folder of every candidate of a finished recording back; those there are left alone.

    Args:
        root: Folder of the dataset, which is not changed.
        work: Where the folders go.

    Raises:
        DamagedDatasetError: If a file of the dataset is missing or cannot be read.
    """
    info, recording = read_info(root), read_recording(root)
    if recording is None:
        raise DamagedDatasetError(f"{root} has no {RECORDING}")
    episodes, statistics = read_episodes(root), read_episode_statistics(root)
    for fields in recording["failures"]:
        candidate = candidate_of(fields)
        if not candidate.stored(recording["config"]["keep"]):
            _keep(work, candidate, lambda folder: None)
    for row, frames in frames_of_episodes(root, episodes):
        columns = recorded_columns(info, frames)
        colors = {name: values[row["episode_index"]] for name, values in statistics.items()}

        def fill(
            folder: Path, row: Row = row, columns: Any = columns, colors: Any = colors
        ) -> None:
            _fill(folder, root, info, row, columns, colors)

        _keep(work, annotated_candidate(row, recording["config"]["seed"]), fill)


def recorded_columns(info: dict[str, Any], frames: pa.Table) -> Columns:
    """Return the columns of an episode as they were recorded, without those that LeRobot adds.

    Args:
        info: `meta/info.json` of the dataset.
        frames: Table of the frames.
    """
    columns = {
        key: column(frames, key)
        for key, feature in info["features"].items()
        if feature["dtype"] in ("float32", "bool", "string") and key not in _MADE_BY_LEROBOT
    }
    return {key: v[:, 0] if v.shape[1:] == (1,) else v for key, v in columns.items()}


def _keep(work: Path, candidate: Candidate, fill: Callable[[Path], None]) -> None:
    folder = candidate_folder(work, candidate.task, candidate.index)
    if folder.exists():  # restored before a kill
        return
    unfinished = folder.with_suffix(UNFINISHED)
    shutil.rmtree(unfinished, ignore_errors=True)
    unfinished.mkdir()
    fill(unfinished)
    (unfinished / SUMMARY).write_text(json.dumps(asdict(candidate)))
    unfinished.rename(folder)


def _fill(
    folder: Path,
    root: Path,
    info: dict[str, Any],
    row: Row,
    columns: dict[str, NDArray[Any]],
    statistics: dict[str, NDArray[np.float64]],
) -> None:
    """Put the frames of an episode into a folder, as its player did."""
    arrays: dict[str, Any] = dict(columns)
    for key, feature in info["features"].items():
        if feature["dtype"] != "video":
            continue
        name = key.removeprefix(IMAGES)
        depth = camera_and_kind(name)[1] == DEPTH  # LeRobot divides the others by 255
        first = round(row[f"videos/{key}/from_timestamp"] * info["fps"])
        copy_frames(video_file(root, row, key), folder / f"{name}.mp4", first, row["length"])
        for of, values in statistics.items():
            if of.rpartition("/")[0] == key:
                statistic = of.rpartition("/")[2]
                restored = values if depth or statistic == "count" else _levels(values)
                arrays[f"{COLORS}{name}.{statistic}"] = restored
    np.savez(folder / COLUMNS, **arrays)


def _levels(shares: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the numbers that give these when they are divided by 255, bit for bit."""
    levels = shares * 255.0
    for neighbour in (-np.inf, np.inf):
        shifted = np.nextafter(shares * 255.0, neighbour)
        levels = np.where((levels / 255.0 != shares) & (shifted / 255.0 == shares), shifted, levels)
    return levels
