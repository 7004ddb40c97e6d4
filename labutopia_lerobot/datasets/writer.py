"""Writing a LeRobotDataset whose videos are encoded already, with LeRobot's own writer.

LeRobot makes every table, statistic and index, in one process and in one order.
"""

import shutil
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import av
import numpy as np
from datasets import Dataset, Image, disable_progress_bars
from lerobot.configs import DepthEncoderConfig, RGBEncoderConfig, VideoEncoderConfig
from lerobot.datasets import dataset_writer
from lerobot.datasets.dataset_metadata import LeRobotDatasetMetadata
from lerobot.datasets.dataset_writer import DatasetWriter
from lerobot.datasets.io_utils import embed_images, write_stats
from numpy.typing import NDArray

from labutopia_lerobot.datasets.declaration import IMAGES
from labutopia_lerobot.datasets.scaling import SCALED, widened
from labutopia_lerobot.pictures import FARTHEST_M, camera_and_kind
from labutopia_lerobot.runtime.video import ENCODINGS, KEYFRAME_INTERVAL
from labutopia_lerobot.setting import DEPTH
from labutopia_lerobot.world import CONTROL_HZ

_VIDEO_FILE_MB = 5
"""LeRobot appends an episode by copying the whole file: a small file keeps that cheap."""

_DATA_FILE_MB = 20
"""LeRobot's tools read and rewrite files whole: this bounds their memory."""

_EPISODES_AT_ONCE = 100
"""Rows of the episode table that are written together. Of every row group a writer and a reader
keep a note of each of its 130 columns: LeRobot's 10 rows make that 40 MB in 2,400 episodes."""

Video = tuple[Path, dict[str, NDArray[Any]]]
"""A file and the statistics of its pictures."""


class EncodedDatasetWriter:
    """Writes a LeRobotDataset, an episode at a time.

    Args:
        repo_id: Its name on the Hub.
        features: LeRobot's declaration: key -> dtype, shape and names.
        robot: What played.
        root: Folder of the dataset; must not exist.
    """

    def __init__(
        self, repo_id: str, features: dict[str, dict[str, Any]], robot: str, root: Path
    ) -> None:
        disable_progress_bars()  # `datasets` shows one for every episode
        dataset_writer.embed_images = _embed_images
        av.logging.set_libav_level(av.logging.ERROR)  # LeRobot lets FFmpeg chat on the terminal
        self._meta = _AnnotatedMetadata.create(
            repo_id=repo_id,
            fps=CONTROL_HZ,
            features=features,
            robot_type=robot,
            root=root,
            metadata_buffer_size=_EPISODES_AT_ONCE,
            data_files_size_in_mb=_DATA_FILE_MB,
            video_files_size_in_mb=_VIDEO_FILE_MB,
        )
        self._videos = _EncodedVideos(root)
        filmed = any(feature["dtype"] == "video" for feature in features.values())
        self._writer = DatasetWriter(
            meta=self._meta,
            root=root,
            rgb_encoder=None,
            depth_encoder=None,
            encoder_threads=None,
            batch_encoding_size=1,
            streaming_encoder=self._videos if filmed else None,
        )

    def add(
        self,
        instruction: str,
        columns: Mapping[str, NDArray[Any]],
        videos: Mapping[str, Video],
        annotations: Mapping[str, int | str],
    ) -> None:
        """Append an episode.

        Args:
            instruction: Instruction of the episode.
            columns: Feature key -> values, as many as there are frames.
            videos: Feature key -> its video, which is left where it is.
            annotations: Columns of our own in the table of episodes.
        """
        frames = len(next(iter(columns.values())))
        frame_index = np.arange(frames)
        self._videos.next_episode = dict(videos)
        self._meta.next_annotations = dict(annotations)
        filled_by_lerobot = ("index", "task_index")
        self._writer.save_episode(
            {
                **dict.fromkeys([*videos, *filled_by_lerobot]),
                **columns,
                "frame_index": frame_index,
                "timestamp": frame_index / CONTROL_HZ,
                "episode_index": self._meta.total_episodes,
                "task": [instruction] * frames,
                "size": frames,
            }
        )

    def finish(self) -> None:
        """Close every file."""
        self._writer.finalize()
        statistics = _in_order(self._meta.stats, self._meta.features)
        for key in SCALED:
            if key in statistics:
                statistics[key] = widened(statistics[key], self._meta.features[key]["names"])
        write_stats(statistics, self._meta.root)


class _AnnotatedMetadata(LeRobotDatasetMetadata):  # type: ignore[misc]  # LeRobot is untyped
    """Episode table with columns of our own, for which LeRobot has no public way in.

    Attributes:
        next_annotations: Column -> value for the next episode.
    """

    next_annotations: dict[str, int | str]

    def update_video_info(self, video_key: str, video_encoder: VideoEncoderConfig) -> None:
        """Note how the pictures of a feature are encoded, which LeRobot takes as it is given.

        It knows two encoders, one for depth and one for everything else.
        """
        super().update_video_info(
            video_key, _encoder(camera_and_kind(video_key.removeprefix(IMAGES))[1])
        )

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
            _in_order(episode_stats, self.features),
            episode_metadata | self.next_annotations,
        )


def _in_order[Value](statistics: Mapping[str, Value], features: Iterable[str]) -> dict[str, Value]:
    """Return statistics in the order of the features: LeRobot keeps the keys in sets."""
    return {key: statistics[key] for key in features if key in statistics}


def _embed_images(table: Dataset) -> Dataset:
    """Do what LeRobot's function of this name does, but leave a table without images alone.

    LeRobot rewrites it row by row, two thirds of the time that an episode takes to be saved.
    """
    pictures = any(isinstance(feature, Image) for feature in table.features.values())
    return embed_images(table) if pictures else table


def _encoder(kind: str) -> VideoEncoderConfig:
    """Return how pictures of a kind are encoded, in LeRobot's words.

    Its tools go by this when they encode anew (delete, split), and its readers when they make
    depths of levels.
    """
    encoding = ENCODINGS[kind]
    options = dict(encoding.options)
    arguments: dict[str, Any] = {
        "vcodec": encoding.codec,
        "pix_fmt": encoding.pixel_format,
        "g": KEYFRAME_INTERVAL,
        "preset": options.pop("preset"),
        "crf": int(options.pop("crf")) if "crf" in options else None,
        "extra_options": options,
    }
    if kind == DEPTH:
        return DepthEncoderConfig(**arguments, depth_min=0.0, depth_max=FARTHEST_M, use_log=False)
    return RGBEncoderConfig(**arguments)


class _EncodedVideos:
    """Takes the place of LeRobot's streaming encoder: the videos are there already.

    Attributes:
        next_episode: Feature key -> file and statistics, for the next episode.

    Args:
        root: Folder of the dataset.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        self.next_episode: dict[str, Video] = {}

    def finish_episode(self) -> dict[str, Video]:
        """Return copies of the videos, which the caller consumes with the folder around them."""
        copies = {}
        for key, (path, statistics) in self.next_episode.items():
            copy = Path(tempfile.mkdtemp(dir=self._root)) / path.name
            copies[key] = (Path(shutil.copyfile(path, copy)), statistics)
        return copies

    def close(self) -> None:
        """Release nothing: no encoder runs."""
