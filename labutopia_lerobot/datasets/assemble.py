"""Putting the stored demonstrations together: one LeRobotDataset, episodes in index order.

LeRobot's own writer makes every table, statistic and index, in one process and in one order, so
that nothing depends on how many workers played.
"""

import json
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import av
import numpy as np
from datasets import disable_progress_bars
from lerobot.configs import RGBEncoderConfig
from lerobot.datasets.dataset_metadata import LeRobotDatasetMetadata
from lerobot.datasets.dataset_writer import DatasetWriter
from numpy.typing import NDArray

from labutopia_lerobot.datasets.candidate import COLUMNS, HISTOGRAM, Candidate, candidate_folder
from labutopia_lerobot.datasets.declaration import IMAGES, dataset_features
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import began_with
from labutopia_lerobot.datasets.tables import DRAWN, OUTCOME, PHASES, RECORDING, SEED
from labutopia_lerobot.runtime.video import (
    CODEC,
    KEYFRAME_INTERVAL,
    PIXEL_FORMAT,
    PRESET,
    QUALITY,
    color_statistics,
)
from labutopia_lerobot.world import CONTROL_HZ

_VIDEO_FILE_MB = 10
"""LeRobot appends an episode by copying the whole file: a small file keeps that cheap."""


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
        self._setting = setting = config.setting
        self._meta = _AnnotatedMetadata.create(
            repo_id=config.repo_id,
            fps=CONTROL_HZ,
            features=dataset_features(setting),
            robot_type=setting.robot,
            root=root,
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
            ),
            depth_encoder=None,
            encoder_threads=None,
            batch_encoding_size=1,
            streaming_encoder=self._videos if setting.obs == "pixels" else None,
        )

    def add(self, candidate: Candidate) -> None:
        """Append a successful candidate as the next episode."""
        folder = candidate_folder(self._work, candidate.index)
        with np.load(folder / COLUMNS) as stored:
            columns = dict(stored)
        cameras = self._setting.cameras if self._setting.obs == "pixels" else ()
        self._videos.next_episode = {
            f"{IMAGES}{camera}": (
                folder / f"{camera}.mp4",
                color_statistics(columns.pop(f"{HISTOGRAM}{camera}"), candidate.frames),
            )
            for camera in cameras
        }
        self._meta.next_annotations = {
            SEED: candidate.seed,
            OUTCOME: candidate.outcome,
            PHASES: json.dumps(candidate.phases),
            DRAWN: json.dumps(candidate.drawn),
        }
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
        failures = [candidate for candidate in candidates if not candidate.success]
        recording = began_with(self._work) | {
            "renderers": sorted({c.renderer for c in candidates if c.renderer is not None}),
            "failures": [
                {"index": failure.index, "seed": failure.seed, "cause": failure.cause}
                for failure in failures
            ],
        }
        (self._root / RECORDING).write_text(json.dumps(recording, indent=2) + "\n")


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
