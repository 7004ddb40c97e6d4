"""Putting the stored demonstrations together: one LeRobotDataset, episodes in index order.

All of it in one process and in one order, so that nothing depends on how many workers played.
"""

import json
import os
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

from labutopia_lerobot.datasets.annotations import annotations
from labutopia_lerobot.datasets.candidate import COLORS, COLUMNS, Candidate, candidate_folder
from labutopia_lerobot.datasets.declaration import IMAGES, dataset_features
from labutopia_lerobot.datasets.description import RECORDING
from labutopia_lerobot.datasets.frames import Columns
from labutopia_lerobot.datasets.language import add_language_columns
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import began_with
from labutopia_lerobot.datasets.writer import EncodedDatasetWriter
from labutopia_lerobot.pictures import picture_names


class DatasetAssembler:
    """Writes a LeRobotDataset from folders of candidates.

    Args:
        config: Options of the recording.
        work: Folder of the candidates.
        root: Folder of the dataset; must not exist.
    """

    def __init__(self, config: RecordingConfig, work: Path, root: Path) -> None:
        self._config, self._work, self._root = config, work, root
        self._settings = {task: config.setting(task) for task in config.tasks}
        setting = self._settings[config.tasks[0]]
        self._pictures = picture_names(setting)
        self._writer = EncodedDatasetWriter(
            config.repo_id, dataset_features(setting), setting.robot, root
        )

    def add(self, candidate: Candidate) -> None:
        """Append a candidate as the next episode."""
        folder = candidate_folder(self._work, candidate.task, candidate.index)
        with np.load(folder / COLUMNS) as stored:
            columns = dict(stored)
        videos = {
            f"{IMAGES}{name}": (folder / f"{name}.mp4", _take_statistics(columns, name))
            for name in self._pictures
        }
        noted = annotations(candidate, self._settings[candidate.task])
        self._writer.add(candidate.instruction, columns, videos, noted)

    def finish(self, candidates: Sequence[Candidate]) -> None:
        """Close every file and write down how the recording was made, failures included."""
        self._writer.finish()
        if self._config.language:
            add_language_columns(self._root)
        recording = began_with(self._work) | {
            "machines": sorted({candidate.machine for candidate in candidates}),
            "renderers": sorted({c.renderer for c in candidates} - {""}),
            "failures": [asdict(replace(c, routes=None)) for c in candidates if not c.success],
        }
        (self._root / RECORDING).write_text(json.dumps(recording, indent=2) + "\n")
        open_to_group(self._root)


def _take_statistics(columns: Columns, picture: str) -> Columns:
    """Take the statistics of a picture out of what a candidate has stored."""
    prefix = f"{COLORS}{picture}."
    return {
        key.removeprefix(prefix): columns.pop(key)
        for key in list(columns)
        if key.startswith(prefix)
    }


def open_to_group(root: Path) -> None:
    """Give all files the usual mode: LeRobot makes some of them for their owner alone."""
    mask = os.umask(0)
    os.umask(mask)
    for path in (root, *root.rglob("*")):
        path.chmod((0o777 if path.is_dir() else 0o666) & ~mask)
