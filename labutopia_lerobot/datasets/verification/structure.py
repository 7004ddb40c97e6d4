"""Is every file there, whole, and does it count as the others do?"""

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

import numpy as np
import pyarrow as pa

from labutopia_lerobot.datasets.description import (
    INFO,
    STATISTICS,
    DamagedDatasetError,
    read_statistics,
)
from labutopia_lerobot.datasets.tables import EPISODES, Row, column, frames_of_episodes
from labutopia_lerobot.datasets.verification.finding import Fault, Finding
from labutopia_lerobot.datasets.verification.verified_dataset import VerifiedDataset
from labutopia_lerobot.runtime.video import video_size_and_frames

FORMAT = "v3.0"

WITHOUT_STATISTICS = ("string", "language")
"""Types of which LeRobot keeps no statistics."""


def check_info(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield what is wrong with format, tasks and the keys of the statistics."""
    if subject.info["codebase_version"] != FORMAT:
        yield Fault(f"{INFO}: format {subject.info['codebase_version']}, not {FORMAT}")
    try:
        known = subject.tasks.values()
        said = {task for row in subject.episodes for task in row["tasks"]}
        for task in sorted(said - set(known)):
            yield Fault(f"meta/tasks: '{task}' of an episode is not there")
        statistics = read_statistics(subject.root)
    except DamagedDatasetError as error:
        yield Fault(str(error))
        return
    for key, feature in subject.features.items():
        if feature["dtype"] not in WITHOUT_STATISTICS and key not in statistics:
            yield Fault(f"{STATISTICS}: no statistics of {key}")


def check_episodes(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield what is wrong with the counting of the episode table."""
    total, rows = subject.info["total_episodes"], subject.episodes
    if [row["episode_index"] for row in rows] != list(range(total)):
        yield Fault(f"{EPISODES}: not the episodes 0 to {total - 1} in order")
    first = 0
    for row in rows:
        last = first + row["length"]
        if (row["dataset_from_index"], row["dataset_to_index"]) != (first, last):
            yield Fault(
                f"{EPISODES}: episode {row['episode_index']} should be rows {first} to {last}"
            )
        first = last
    if first != subject.info["total_frames"]:
        yield Fault(f"{EPISODES}: {first} frames, but {INFO} has {subject.info['total_frames']}")


def check_frames(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield what is wrong with the table of frames: counters, shapes, numbers."""
    count = 0
    try:
        for row, frames in frames_of_episodes(subject.root, subject.episodes):
            yield from _check_frames_of(subject, row, frames)
            count += frames.num_rows
    except (DamagedDatasetError, pa.ArrowInvalid) as error:
        yield Fault(str(error))
        return
    if count != subject.info["total_frames"]:
        yield Fault(f"data: {count} frames, but {INFO} has {subject.info['total_frames']}")


def _check_frames_of(subject: VerifiedDataset, row: Row, frames: pa.Table) -> Iterator[Finding]:
    where = f"data: episode {row['episode_index']}"
    frame_index = np.arange(row["length"])
    counters = {
        "index": row["dataset_from_index"] + frame_index,
        "frame_index": frame_index,
        "episode_index": np.full(row["length"], row["episode_index"]),
        "timestamp": (frame_index / subject.info["fps"]).astype(np.float32),
    }
    for key, feature in subject.features.items():
        if feature["dtype"] == "video":
            continue
        if key not in frames.column_names:
            yield Fault(f"{where}: no column {key}")
            continue
        if feature["dtype"] in ("language", "image"):
            continue
        values = column(frames, key)
        if key in counters:
            if not np.array_equal(values[:, 0], counters[key]):
                yield Fault(f"{where}: {key} does not count its frames")
        elif feature["dtype"].startswith("float"):
            size = int(np.prod(feature["shape"]))
            if values.shape[1] != size:
                yield Fault(f"{where}: {key} has {values.shape[1]} elements, not {size}")
            elif not np.isfinite(values).all():
                yield Fault(f"{where}: {key} holds numbers that are not finite")
    said = {subject.tasks.get(int(index)) for index in np.unique(column(frames, "task_index"))}
    if said != set(row["tasks"]):
        yield Fault(f"{where}: task_index says {sorted(map(str, said))}, not {row['tasks']}")


def check_videos(subject: VerifiedDataset) -> Iterator[Finding]:
    """Yield what is wrong with the videos: readable, of the right size, as many frames as rows."""
    for key in subject.cameras:

        def file(row: Row, key: str = key) -> Path:
            return subject.video(row, key)

        for path, rows in groupby(subject.episodes, file):
            yield from _check_video(subject, path, key, list(rows))


def _check_video(
    subject: VerifiedDataset, path: Path, key: str, rows: list[Row]
) -> Iterator[Finding]:
    where, shape = path.relative_to(subject.root), subject.features[key]["shape"]
    fps = subject.info["fps"]
    try:
        width, height, frames = video_size_and_frames(path)
    except (OSError, ValueError) as error:
        yield Fault(f"{where} cannot be read: {error}")
        return
    expected = sum(row["length"] for row in rows)
    if frames != expected:
        yield Fault(f"{where}: {frames} frames, but the table has {expected}")
    if [height, width] != list(shape)[:2]:
        yield Fault(
            f"{where}: pictures of {width} x {height}, but {INFO} has {shape[1]} x {shape[0]}"
        )
    first = 0
    for row in rows:
        span = (row[f"videos/{key}/from_timestamp"], row[f"videos/{key}/to_timestamp"])
        last = first + row["length"]
        if not np.allclose(span, (first / fps, last / fps), atol=0.1 / fps, rtol=0.0):
            yield Fault(
                f"{where}: episode {row['episode_index']} should be frames {first} to {last}"
            )
        first = last
