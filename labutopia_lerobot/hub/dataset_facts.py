"""Facts about a dataset for its card, read from its files: a value that JSON can hold."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.description import (
    INFO,
    RECORDING,
    STATISTICS,
    DamagedDatasetError,
    read_info,
    read_recording,
    read_statistics,
)
from labutopia_lerobot.datasets.tables import OUTCOME, SEED, TASKS, read_episodes
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import inside, read_json_object

_FILES = (
    INFO,
    STATISTICS,
    TASKS,
    RECORDING,
    "meta/episodes/chunk-*/file-*.parquet",
    "data/chunk-*/file-*.parquet",
    "videos/*/chunk-*/file-*.mp4",
)
"""Files of a dataset that are sent, and nothing else that lies beside them."""

_STATISTICS = ("min", "max", "mean", "std")
"""The statistics that a card shows; LeRobot stores more."""


class UntoldDatasetError(UserError):
    """A dataset that does not say how it was recorded: no card can be made of it."""


@dataclass(frozen=True)
class DatasetFacts:
    """Facts about a dataset.

    Attributes:
        info: LeRobot's description of it: features, frame rate, totals.
        statistics: Feature -> statistic -> values.
        recording: How it was recorded: options, code, versions, failures.
        columns: What the table of episodes has beyond LeRobot's own columns.
        episodes: Per episode its seed, length [frames], outcome and instructions.
        size_bytes: Of all of its files.
    """

    info: dict[str, Any]
    statistics: dict[str, dict[str, Any]]
    recording: dict[str, Any]
    columns: list[str]
    episodes: list[dict[str, Any]]
    size_bytes: int

    @classmethod
    def read(cls, root: Path) -> "DatasetFacts":
        """Read them from a dataset that `labutopia-record` made.

        Raises:
            UntoldDatasetError: If something else made it, or it was edited since.
            DamagedDatasetError: If a file is missing or cannot be read.
        """
        recording = read_recording(root)
        if recording is None:
            raise UntoldDatasetError(
                f"{root} has no {RECORDING}: labutopia-record did not make it, or a tool of "
                "LeRobot has edited it. Publish it with LeRobot's push_to_hub"
            )
        statistics, episodes = read_statistics(root), read_episodes(root)
        return cls(
            info=read_info(root),
            statistics={
                key: {name: values[name] for name in _STATISTICS if name in values}
                for key, values in statistics.items()
            },
            recording=recording,
            columns=[name for name in episodes[0] if name.startswith("labutopia/")],
            episodes=[_episode_facts(row) for row in episodes],
            size_bytes=sum(file.stat().st_size for file in dataset_files(root).values()),
        )

    @classmethod
    def load(cls, file: Path) -> "DatasetFacts":
        """Read them from the JSON that `save` wrote.

        Raises:
            DamagedDatasetError: If it cannot be read.
        """
        return cls(**read_json_object(file, DamagedDatasetError))

    def save(self, file: Path) -> None:
        """Write them as JSON, so that the card can be made again without the dataset."""
        file.write_text(json.dumps(asdict(self), indent=1) + "\n")

    @property
    def config(self) -> dict[str, Any]:
        """The options of the recording."""
        config: dict[str, Any] = self.recording["config"]
        return config

    @property
    def tasks(self) -> list[str]:
        """Ids of the tasks."""
        task = self.config["task"]
        return [task] if isinstance(task, str) else list(task)


def dataset_files(root: Path) -> dict[str, Path]:
    """Return path in the dataset -> file, for everything that belongs to a LeRobotDataset v3.

    Raises:
        DamagedDatasetError: If there is none, or one is a link that leads out of the dataset.
    """
    files = {
        path.relative_to(root).as_posix(): inside(root, path.relative_to(root), DamagedDatasetError)
        for pattern in _FILES
        for path in sorted(root.glob(pattern))
    }
    if INFO not in files:
        raise DamagedDatasetError(f"{root} has no {INFO}: it is no LeRobotDataset")
    return files


def _episode_facts(row: dict[str, Any]) -> dict[str, Any]:
    return {
        "seed": row.get(SEED),
        "frames": row["length"],
        "outcome": row.get(OUTCOME),
        "tasks": row["tasks"],
    }
