"""Looking at a recorded episode: it is played again from its seed, and shown on the way."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Any, Protocol, Self

import numpy as np
import pyarrow as pa

from labutopia_lerobot.datasets.playback import Playback, Player
from labutopia_lerobot.datasets.replay import ForeignDatasetError
from labutopia_lerobot.datasets.tables import (
    SETTING,
    Row,
    episode_setting,
    frames_of_episodes,
    read_episodes,
    setting_column,
)
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.video import VideoWriter, require_filmable


class UnknownEpisodeError(UserError):
    """An episode that the dataset does not have; the message says which it has."""


class Look(Protocol):
    """Is shown every frame of an episode before its action."""

    def __call__(self, number: int, env: LabEnv) -> None:
        """Look at a frame.

        Args:
            number: Of the frame.
            env: As it is in that frame.
        """
        ...


def find_episode(root: Path, episode: int, tasks_dir: str | None = None) -> tuple[Row, pa.Table]:
    """Return the row of an episode and the table of its frames.

    Args:
        root: Folder of the dataset.
        episode: Its number.
        tasks_dir: A further folder of tasks.

    Raises:
        UnknownEpisodeError: If the dataset has none of this number.
        ForeignDatasetError: If its seed is not known.
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    rows = {row["episode_index"]: row for row in read_episodes(root)}
    if episode not in rows:
        raise UnknownEpisodeError(f"--episode {episode} is none of {root}: it has 0 to {max(rows)}")
    if episode_setting(rows[episode], tasks_dir) is None:
        raise ForeignDatasetError(
            f"Episode {episode} of {root} has no seed and setting, so that it cannot be played "
            "again: labutopia-record did not make it, or LeRobot's delete or split dropped them"
        )
    (frames,) = frames_of_episodes(root, [rows[episode]])
    return frames


def look_at(
    row: Row, frames: pa.Table, look: Look, width: int, height: int, tasks_dir: str | None = None
) -> Playback:
    """Play an episode again and show it.

    Args:
        row: Of the episode.
        frames: Its frames.
        look: Is shown every frame.
        width: Width of pictures that are drawn on the way [pixels].
        height: Their height [pixels].
        tasks_dir: A further folder of tasks.
    """
    player = Player(tasks_dir)
    try:
        sized = drawn_with(row, tasks_dir, width=width, height=height)
        playback = player.play(sized, frames, look)
    finally:
        player.close()
    assert playback is not None
    return playback


def drawn_with(row: Row, tasks_dir: str | None, **chosen: Any) -> Row:
    """Return an episode whose pictures are drawn otherwise.

    Args:
        row: Of the episode.
        tasks_dir: A further folder of tasks.
        **chosen: Fields of its setting that take other values, such as `width`.

    Raises:
        UnknownOptionError: If a value is impossible.
    """
    setting = episode_setting(row, tasks_dir)
    if setting is None:
        return row
    return row | {SETTING: setting_column(replace(setting, **chosen))}


class Film:
    """A `Look` that films what some cameras see, side by side; a context manager.

    Args:
        file: MP4 to write.
        cameras: Which.
        width: Width of the picture of a camera [pixels].
        height: Its height [pixels].
    """

    def __init__(self, file: Path, cameras: Sequence[str], width: int, height: int) -> None:
        require_filmable(width, height)
        file.parent.mkdir(parents=True, exist_ok=True)
        self._cameras = cameras
        self._video = VideoWriter(file, width * len(cameras), height)

    def __call__(self, number: int, env: LabEnv) -> None:
        """Film a frame."""
        self._video.add(np.hstack(list(env.workcell.pictures(self._cameras).values())))

    def __enter__(self) -> Self:
        self._video.__enter__()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._video.__exit__(kind, error, trace)
