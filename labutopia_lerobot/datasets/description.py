"""A dataset's own description in JSON: its features, its statistics, how it was recorded."""

import re
from pathlib import Path
from typing import Any, NotRequired, TypedDict

import numpy as np

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import inside, printable, read_json

INFO = "meta/info.json"
STATISTICS = "meta/stats.json"

RECORDING = "meta/labutopia.json"
"""Configuration, code, versions, machines, renderers and failures of the recording."""

VIDEO = "video"
"""Type of a feature of pictures."""

_KEY = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.\-]{0,199}")
_LARGEST_RATE = 10_000
_LARGEST_SIZE = 1_000_000


_FORMER_NAMES = {"annotation.milestone": "annotation.substep"}
"""Feature name in datasets of earlier versions -> its name now."""


class DamagedDatasetError(UserError):
    """A file of a dataset is missing or cannot be read; the message names it."""


class FeatureDescription(TypedDict):
    """LeRobot's description of a feature; of videos `info` says more."""

    dtype: str
    shape: list[int]
    names: NotRequired[list[str] | dict[str, Any] | None]
    info: NotRequired[dict[str, Any] | None]


class Info(TypedDict):
    """The part of `meta/info.json` that is read."""

    codebase_version: str
    robot_type: NotRequired[str | None]
    fps: int
    total_episodes: int
    total_frames: int
    features: dict[str, FeatureDescription]


class RecordedWith(TypedDict):
    """The part of the options in `meta/labutopia.json` that is read."""

    task: str | list[str]
    episodes: int
    seed: int
    keep: str


class Recording(TypedDict):
    """The part of `meta/labutopia.json` that is read."""

    config: RecordedWith
    code: dict[str, Any]
    versions: dict[str, str | None]
    failures: list[dict[str, Any]]


def present_name(key: str) -> str:
    """Return what a feature is called now that an earlier version may have called otherwise."""
    return _FORMER_NAMES.get(key, key)


def read_info(root: Path) -> dict[str, Any]:
    """Return `meta/info.json`.

    Raises:
        DamagedDatasetError: If it is missing, or does not describe a LeRobotDataset.
    """
    info: dict[str, Any] = dict(_read(root, INFO, Info))
    info["features"] = {present_name(key): feature for key, feature in info["features"].items()}
    if not 1 <= info["fps"] <= _LARGEST_RATE:
        raise DamagedDatasetError(f"{root / INFO}: fps is {info['fps']}, not 1 to {_LARGEST_RATE}")
    for key, feature in info["features"].items():
        if not _KEY.fullmatch(key) or ".." in key:
            raise DamagedDatasetError(
                f"{root / INFO}: a feature is called '{printable(key)[:80]}'; names have letters, "
                "digits, underscores, dots and hyphens"
            )
        if not all(1 <= size <= _LARGEST_SIZE for size in feature["shape"]):
            raise DamagedDatasetError(f"{root / INFO}: {key} has the shape {feature['shape']}")
        if feature["dtype"] == VIDEO and len(feature["shape"]) != 3:
            raise DamagedDatasetError(
                f"{root / INFO}: {key} has the shape {feature['shape']}; pictures have three sizes"
            )
    return info


def read_recording(root: Path) -> dict[str, Any] | None:
    """Return `meta/labutopia.json`, or None where there is none.

    Raises:
        DamagedDatasetError: If it lacks what recordings have.
    """
    return dict(_read(root, RECORDING, Recording)) if (root / RECORDING).exists() else None


def read_statistics(root: Path) -> dict[str, dict[str, Any]]:
    """Return `meta/stats.json`: feature -> statistic -> numbers.

    Raises:
        DamagedDatasetError: If it is missing or holds something else.
    """
    said = _read(root, STATISTICS, dict[str, dict[str, Any]])
    by_name = {present_name(key): statistics for key, statistics in said.items()}
    for key, statistics in by_name.items():
        for name, values in statistics.items():
            try:
                np.array(values, dtype=float)
            except (OverflowError, TypeError, ValueError):
                where = printable(f"{name} of {key}")
                raise DamagedDatasetError(f"{root / STATISTICS}: {where} is no numbers") from None
    return by_name


def _read[Kind](root: Path, name: str, kind: type[Kind]) -> Kind:
    return read_json(inside(root, name, DamagedDatasetError), kind, DamagedDatasetError)
