"""A dataset that is verified: what every check looks at."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from labutopia_lerobot.datasets.description import (
    RECORDING,
    VIDEO,
    DamagedDatasetError,
    read_info,
    read_recording,
)
from labutopia_lerobot.datasets.tables import (
    EPISODES,
    SEED,
    SETTING,
    TASKS,
    Row,
    read_episodes,
    video_file,
)
from labutopia_lerobot.foreign_files import inside
from labutopia_lerobot.scenario.own_files import NO_FILES, OwnFiles


@dataclass(frozen=True)
class VerifiedDataset:
    """A dataset, as far as it can be read.

    Attributes:
        root: Its folder.
        info: `meta/info.json`.
        episodes: The rows of its episode table, without the statistics.
        tasks_dir: A further folder of tasks, which the user trusts.
        own_files: Those of its room and of the answers that decided what reacts, if any.
    """

    root: Path
    info: dict[str, Any]
    episodes: list[Row]
    tasks_dir: str | None = None
    own_files: OwnFiles = NO_FILES

    @classmethod
    def of(
        cls, root: Path, tasks_dir: str | None = None, own_files: OwnFiles = NO_FILES
    ) -> "VerifiedDataset":
        """Read a dataset.

        Raises:
            DamagedDatasetError: If a file is missing or cannot be read.
        """
        return cls(root, read_info(root), read_episodes(root), tasks_dir, own_files)

    @property
    def features(self) -> dict[str, dict[str, Any]]:
        """Key -> dtype, shape and names."""
        features: dict[str, dict[str, Any]] = self.info["features"]
        return features

    @property
    def cameras(self) -> list[str]:
        """Keys of the videos."""
        return [key for key, feature in self.features.items() if feature["dtype"] == VIDEO]

    @cached_property
    def recording(self) -> dict[str, Any] | None:
        """`meta/labutopia.json`, or None where there is none.

        Raises:
            DamagedDatasetError: If it cannot be read.
        """
        return read_recording(self.root)

    @cached_property
    def tasks(self) -> dict[int, str]:
        """The task table: index -> instruction.

        Raises:
            DamagedDatasetError: If it cannot be read.
        """
        try:
            file = inside(self.root, TASKS, DamagedDatasetError)
            columns = pq.read_table(file).to_pydict()
        except (OSError, pa.ArrowException) as error:
            raise DamagedDatasetError(f"{TASKS} cannot be read: {error}") from None
        words = columns.get("task", columns.get("__index_level_0__"))
        if words is None or "task_index" not in columns:
            raise DamagedDatasetError(f"{TASKS} has no column of instructions")
        return dict(zip(columns["task_index"], words, strict=True))

    @property
    def edited(self) -> str | None:
        """Changes by another tool since the recording, in words; None if there are none.

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
        return video_file(self.root, row, key)

    def first_frame(self, row: Row, key: str) -> int:
        """Return at which frame of its video file an episode begins."""
        return round(float(row[f"videos/{key}/from_timestamp"]) * int(self.info["fps"]))
