"""Putting the stored demonstrations together: one LeRobotDataset, episodes in index order.

LeRobot's own writer makes every table, statistic and index, in one process and in one order, so
that nothing depends on how many workers played.
"""

import json
import os
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import av
import numpy as np
from datasets import disable_progress_bars
from lerobot.configs import RGBEncoderConfig
from lerobot.datasets.dataset_metadata import LeRobotDatasetMetadata
from lerobot.datasets.dataset_writer import DatasetWriter
from numpy.typing import NDArray

from labutopia_lerobot.datasets.annotations import annotations
from labutopia_lerobot.datasets.candidate import COLORS, COLUMNS, Candidate, candidate_folder
from labutopia_lerobot.datasets.declaration import IMAGES, dataset_features
from labutopia_lerobot.datasets.frames import Columns
from labutopia_lerobot.datasets.language import add_language_columns
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import began_with
from labutopia_lerobot.datasets.tables import RECORDING
from labutopia_lerobot.runtime.video import (
    CODEC,
    KEYFRAME_INTERVAL,
    PIXEL_FORMAT,
    PRESET,
    QUALITY,
    TUNE,
)
from labutopia_lerobot.world import CONTROL_HZ

_VIDEO_FILE_MB = 10
"""LeRobot appends an episode by copying the whole file: a small file keeps that cheap."""

_DATA_FILE_MB = 20
"""Files are read and rewritten whole, here and in `tables`: this bounds the memory."""


class DatasetAssembler:
    """Writes a LeRobotDataset from folders of candidates.

    Args:
        config: What was recorded.
        work: Folder of the candidates.
        root: Folder of the dataset; must not exist.
    """

    def __init__(self, config: RecordingConfig, work: Path, root: Path) -> None:
        disable_progress_bars()  # LeRobot maps every episode through `datasets`, one bar each
        av.logging.set_libav_level(av.logging.ERROR)  # LeRobot lets FFmpeg chat on the terminal
        self._config, self._work, self._root = config, work, root
        setting = config.setting(config.tasks[0])
        self._cameras = setting.cameras if setting.obs == "pixels" else ()
        self._meta = _AnnotatedMetadata.create(
            repo_id=config.repo_id,
            fps=CONTROL_HZ,
            features=dataset_features(setting),
            robot_type=setting.robot,
            root=root,
            data_files_size_in_mb=_DATA_FILE_MB,
            video_files_size_in_mb=_VIDEO_FILE_MB,
        )
        self._videos = _EncodedVideos(root)
        self._writer = DatasetWriter(
            meta=self._meta,
            root=root,
            rgb_encoder=RGBEncoderConfig(
                vcodec=CODEC,
                pix_fmt=PIXEL_FORMAT,
                preset=PRESET,
                crf=QUALITY,
                g=KEYFRAME_INTERVAL,
                extra_options={"tune": TUNE},
            ),
            depth_encoder=None,
            encoder_threads=None,
            batch_encoding_size=1,
            streaming_encoder=self._videos if self._cameras else None,
        )

    def add(self, candidate: Candidate) -> None:
        """Append a candidate as the next episode."""
        folder = candidate_folder(self._work, candidate.task, candidate.index)
        with np.load(folder / COLUMNS) as stored:
            columns = dict(stored)
        self._videos.next_episode = {
            f"{IMAGES}{camera}": (folder / f"{camera}.mp4", _take_colors(columns, camera))
            for camera in self._cameras
        }
        setting = self._config.setting(candidate.task)
        self._meta.next_annotations = annotations(candidate, setting)
        frame_index = np.arange(candidate.frames)
        filled_by_lerobot = {"index", "task_index"}
        self._writer.save_episode(
            {
                **dict.fromkeys([*self._videos.next_episode, *filled_by_lerobot]),
                **columns,
                "frame_index": frame_index,
                "timestamp": frame_index / CONTROL_HZ,
                "episode_index": self._meta.total_episodes,
                "task": [candidate.instruction] * candidate.frames,
                "size": candidate.frames,
            }
        )

    def finish(self, candidates: Sequence[Candidate]) -> None:
        """Close every file and write down how the recording was made, failures included."""
        self._writer.finalize()
        if self._config.language:
            add_language_columns(self._root)
        recording = began_with(self._work) | {
            "machines": sorted({candidate.machine for candidate in candidates}),
            "renderers": sorted({c.renderer for c in candidates} - {""}),
            "failures": [asdict(candidate) for candidate in candidates if not candidate.success],
        }
        (self._root / RECORDING).write_text(json.dumps(recording, indent=2) + "\n")
        _open_to_group(self._root)


def _take_colors(columns: Columns, camera: str) -> Columns:
    """Take the colour statistics of a camera out of what a candidate has stored."""
    prefix = f"{COLORS}{camera}."
    return {
        key.removeprefix(prefix): columns.pop(key)
        for key in list(columns)
        if key.startswith(prefix)
    }


def _open_to_group(root: Path) -> None:
    """Give all files the usual mode: LeRobot makes some of them for their owner alone."""
    mask = os.umask(0)
    os.umask(mask)
    for path in (root, *root.rglob("*")):
        path.chmod((0o777 if path.is_dir() else 0o666) & ~mask)


class _AnnotatedMetadata(LeRobotDatasetMetadata):  # type: ignore[misc]  # LeRobot is untyped
    """Episode table with columns of our own, for which LeRobot has no public way in.

    Attributes:
        next_annotations: Column -> value for the next episode.
    """

    next_annotations: dict[str, int | str]

    def save_episode(
        self,
        episode_index: int,
        episode_length: int,
        episode_tasks: list[str],
        episode_stats: dict[str, dict[str, NDArray[Any]]],
        episode_metadata: dict[str, Any],
    ) -> None:
        """Add the columns to the row of the episode."""
        super().save_episode(
            episode_index,
            episode_length,
            episode_tasks,
            episode_stats,
            episode_metadata | self.next_annotations,
        )


class _EncodedVideos:
    """Takes the place of LeRobot's streaming encoder: the videos are there already.

    Attributes:
        next_episode: Feature key -> file and colour statistics, for the next episode.

    Args:
        root: Folder of the dataset.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        self.next_episode: dict[str, tuple[Path, dict[str, NDArray[Any]]]] = {}

    def finish_episode(self) -> dict[str, tuple[Path, dict[str, NDArray[Any]]]]:
        """Return copies of the videos, which the caller consumes with the folder around them."""
        copies = {}
        for key, (path, statistics) in self.next_episode.items():
            copy = Path(tempfile.mkdtemp(dir=self._root)) / path.name
            copies[key] = (Path(shutil.copyfile(path, copy)), statistics)
        return copies

    def close(self) -> None:
        """Release nothing: no encoder runs."""
