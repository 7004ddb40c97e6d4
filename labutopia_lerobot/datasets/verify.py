"""Checks of a finished dataset: every file there, readable, and consistent with the others."""

from collections.abc import Callable, Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa

from labutopia_lerobot.datasets.tables import (
    INFO,
    OUTCOME,
    RECORDING,
    SEED,
    STATISTICS,
    TASKS,
    DamagedDatasetError,
    column,
    read_episodes,
    read_frames,
    read_json,
)
from labutopia_lerobot.runtime.video import video_size_and_frames
from labutopia_lerobot.task import SUCCESS

_FORMAT = "v3.0"

Rows = list[dict[str, Any]]


def require_intact(root: Path) -> None:
    """Check a dataset.

    Raises:
        DamagedDatasetError: If anything is wrong with it; the message lists every problem.
    """
    problems = find_problems(root)
    if problems:
        raise DamagedDatasetError(f"{root} is damaged:\n" + "\n".join(f"  {p}" for p in problems))


def find_problems(root: Path) -> list[str]:
    """Return everything that is wrong with a LeRobotDataset v3; an intact one gives nothing."""
    try:
        info = read_json(root, INFO)
        episodes = read_episodes(root)
    except DamagedDatasetError as error:
        return [str(error)]
    checks: list[Callable[[Path, dict[str, Any], Rows], Iterator[str]]] = [
        _check_info,
        _check_episodes,
        _check_frames,
        _check_videos,
    ]
    if (root / RECORDING).exists():
        checks.append(_check_recording)
    return [problem for check in checks for problem in check(root, info, episodes)]


def _check_info(root: Path, info: dict[str, Any], episodes: Rows) -> Iterator[str]:
    if info["codebase_version"] != _FORMAT:
        yield f"{INFO}: format {info['codebase_version']}, not {_FORMAT}"
    if not (root / TASKS).exists():
        yield f"{TASKS} is missing"
    try:
        statistics = read_json(root, STATISTICS)
    except DamagedDatasetError as error:
        yield str(error)
    else:
        for key in info["features"].keys() - statistics.keys():
            yield f"{STATISTICS}: no statistics of {key}"


def _check_episodes(root: Path, info: dict[str, Any], episodes: Rows) -> Iterator[str]:
    if [row["episode_index"] for row in episodes] != list(range(info["total_episodes"])):
        yield f"meta/episodes: not the episodes 0 to {info['total_episodes'] - 1} in order"
    first = 0
    for row in episodes:
        last = first + row["length"]
        if (row["dataset_from_index"], row["dataset_to_index"]) != (first, last):
            yield f"meta/episodes: episode {row['episode_index']} should be rows {first} to {last}"
        first = last
    if first != info["total_frames"]:
        yield f"meta/episodes: {first} frames, but {INFO} has {info['total_frames']}"


def _check_frames(root: Path, info: dict[str, Any], episodes: Rows) -> Iterator[str]:
    try:
        table = read_frames(root)
    except (DamagedDatasetError, pa.ArrowInvalid) as error:
        yield str(error)
        return
    lengths = [row["length"] for row in episodes]
    if table.num_rows != sum(lengths):
        yield f"data: {table.num_rows} frames, but meta/episodes has {sum(lengths)}"
        return
    frame_index = np.concatenate([np.arange(length) for length in lengths])
    expected = {
        "index": np.arange(len(frame_index)),
        "frame_index": frame_index,
        "episode_index": np.repeat(np.arange(len(lengths)), lengths),
        "timestamp": (frame_index / info["fps"]).astype(np.float32),
    }
    for key, feature in info["features"].items():
        if feature["dtype"] == "video":
            continue
        if key not in table.column_names:
            yield f"data: no column {key}"
        elif key in expected:
            if not np.array_equal(table[key].to_numpy(), expected[key]):
                yield f"data: {key} does not count the frames of the episodes"
        elif feature["dtype"].startswith("float"):
            values = column(table, key)
            if values.shape[1:] != tuple(feature["shape"]):
                yield f"data: {key} has shape {values.shape[1:]}, not {tuple(feature['shape'])}"
            elif not np.isfinite(values).all():
                yield f"data: {key} holds numbers that are not finite"


def _check_videos(root: Path, info: dict[str, Any], episodes: Rows) -> Iterator[str]:
    for key, feature in info["features"].items():
        if feature["dtype"] != "video":
            continue

        def place(row: dict[str, Any], key: str = key) -> tuple[int, int]:
            return row[f"videos/{key}/chunk_index"], row[f"videos/{key}/file_index"]

        for (chunk, file), rows in groupby(episodes, place):
            path = Path(
                info["video_path"].format(video_key=key, chunk_index=chunk, file_index=file)
            )
            yield from _check_video(root, path, feature["shape"], list(rows), key, info["fps"])


def _check_video(
    root: Path, path: Path, shape: list[int], rows: Rows, key: str, fps: int
) -> Iterator[str]:
    try:
        width, height, frames = video_size_and_frames(root / path)
    except (OSError, ValueError) as error:
        yield f"{path} cannot be read: {error}"
        return
    expected = sum(row["length"] for row in rows)
    if frames != expected:
        yield f"{path}: {frames} frames, but the table has {expected}"
    if [height, width, 3] != list(shape):
        yield f"{path}: pictures of {width} x {height}, but {INFO} has {shape[1]} x {shape[0]}"
    first = 0
    for row in rows:
        span = (row[f"videos/{key}/from_timestamp"], row[f"videos/{key}/to_timestamp"])
        last = first + row["length"]
        if not np.allclose(span, (first / fps, last / fps), atol=0.1 / fps, rtol=0.0):
            yield f"{path}: episode {row['episode_index']} should be frames {first} to {last}"
        first = last


def _check_recording(root: Path, info: dict[str, Any], episodes: Rows) -> Iterator[str]:
    if any(name not in row for row in episodes for name in (SEED, OUTCOME)):
        yield f"meta/episodes: no columns {SEED} and {OUTCOME}"
        return
    if len({row[SEED] for row in episodes}) < len(episodes):
        yield f"meta/episodes: a seed occurs twice in {SEED}"
    for row in episodes:
        if row[OUTCOME] != SUCCESS:
            yield f"meta/episodes: episode {row['episode_index']} ended by {row[OUTCOME]}"
