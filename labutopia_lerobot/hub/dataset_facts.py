"""What a card tells of a dataset, read from its files: a value that JSON can hold."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.tables import (
    INFO,
    OUTCOME,
    RECORDING,
    SEED,
    STATISTICS,
    DamagedDatasetError,
    read_episodes,
    read_json,
)
from labutopia_lerobot.errors import UserError

_TOLD = ("min", "max", "mean", "std")
"""The statistics that a card tells; LeRobot stores more."""


class UntoldDatasetError(UserError):
    """A dataset that does not say how it was recorded: no card can be made of it."""


@dataclass(frozen=True)
class DatasetFacts:
    """What a dataset is.

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
        if not (root / RECORDING).exists():
            raise UntoldDatasetError(
                f"{root} has no {RECORDING}: labutopia-record did not make it, or a tool of "
                "LeRobot has edited it. Publish it with LeRobot's push_to_hub"
            )
        statistics, episodes = read_json(root, STATISTICS), read_episodes(root)
        return cls(
            info=read_json(root, INFO),
            statistics={
                key: {name: values[name] for name in _TOLD} for key, values in statistics.items()
            },
            recording=read_json(root, RECORDING),
            columns=[name for name in episodes[0] if name.startswith("labutopia/")],
            episodes=[_told(row) for row in episodes],
            size_bytes=sum(file.stat().st_size for file in dataset_files(root).values()),
        )

    @classmethod
    def load(cls, file: Path) -> "DatasetFacts":
        """Read them from the JSON that `save` wrote.

        Raises:
            DamagedDatasetError: If it cannot be read.
        """
        return cls(**read_json(file.parent, file.name))

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
        DamagedDatasetError: If there is none.
    """
    patterns = ("meta/**/*.json", "meta/**/*.parquet", "data/**/*.parquet", "videos/**/*.mp4")
    files = {
        path.relative_to(root).as_posix(): path
        for pattern in patterns
        for path in sorted(root.glob(pattern))
    }
    if INFO not in files:
        raise DamagedDatasetError(f"{root} has no {INFO}: it is no LeRobotDataset")
    return files


def _told(row: dict[str, Any]) -> dict[str, Any]:
    return {
        "seed": row.get(SEED),
        "frames": row["length"],
        "outcome": row.get(OUTCOME),
        "tasks": row["tasks"],
    }
