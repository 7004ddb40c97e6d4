"""A dataset that is verified: what every check looks at."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq

from labutopia_lerobot.datasets.tables import (
    EPISODES,
    INFO,
    RECORDING,
    SEED,
    SETTING,
    TASKS,
    DamagedDatasetError,
    Row,
    read_episodes,
    read_json,
)


@dataclass(frozen=True)
class Subject:
    """A dataset, as far as it can be read.

    Attributes:
        root: Its folder.
        info: `meta/info.json`.
        episodes: The rows of its episode table, without the statistics.
    """

    root: Path
    info: dict[str, Any]
    episodes: list[Row]

    @classmethod
    def of(cls, root: Path) -> "Subject":
        """Read a dataset.

        Raises:
            DamagedDatasetError: If a file is missing or cannot be read.
        """
        return cls(root, read_json(root, INFO), read_episodes(root))

    @property
    def features(self) -> dict[str, dict[str, Any]]:
        """Key -> dtype, shape and names."""
        features: dict[str, dict[str, Any]] = self.info["features"]
        return features

    @property
    def cameras(self) -> list[str]:
        """Keys of the videos."""
        return [key for key, feature in self.features.items() if feature["dtype"] == "video"]

    @cached_property
    def recording(self) -> dict[str, Any] | None:
        """`meta/labutopia.json`, or None where there is none.

        Raises:
            DamagedDatasetError: If it cannot be read.
        """
        return read_json(self.root, RECORDING) if (self.root / RECORDING).exists() else None

    @cached_property
    def tasks(self) -> dict[int, str]:
        """The task table: index -> instruction.

        Raises:
            DamagedDatasetError: If it cannot be read.
        """
        try:
            columns = pq.read_table(self.root / TASKS).to_pydict()
        except Exception as error:
            raise DamagedDatasetError(f"{TASKS} cannot be read: {error}") from None
        words = columns.get("task", columns.get("__index_level_0__"))
        if words is None:
            raise DamagedDatasetError(f"{TASKS} has no column of instructions")
        return dict(zip(columns["task_index"], words, strict=True))

    @property
    def edited(self) -> str | None:
        """What another tool has changed since the recording, in words; None if nothing.

        LeRobot's merge drops `meta/labutopia.json`; its delete and split drop our columns too; its
        resume appends episodes that have none. Older versions of ours did not write `SETTING`.
        """
        for column in (SEED, SETTING):
            without = sum(row.get(column) is None for row in self.episodes)
            if without == len(self.episodes):
                return f"{EPISODES} has no column {column}"
            if without:
                return f"{without} of {len(self.episodes)} episodes have no {column}"
        return None if self.recording is not None else f"{RECORDING} is missing"

    def video(self, row: Row, key: str) -> Path:
        """Return the file in which an episode's video is."""
        chunk, file = row[f"videos/{key}/chunk_index"], row[f"videos/{key}/file_index"]
        path: str = self.info["video_path"].format(
            video_key=key, chunk_index=chunk, file_index=file
        )
        return self.root / path

    def first_frame(self, row: Row, key: str) -> int:
        """Return at which frame of its video file an episode begins."""
        return round(float(row[f"videos/{key}/from_timestamp"]) * int(self.info["fps"]))
