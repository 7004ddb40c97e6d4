"""Drawing a whole dataset anew: other cameras or sizes, the same episodes.

A recording holds no full states: those of 1,000 particles would be larger than the videos. So each
episode is played again from its seed and commands, without its expert, and drawn on the way; that
it goes through the recorded states bit for bit is checked, so that tables and pictures agree.
"""

import json
import shutil
import tempfile
from contextlib import ExitStack
from dataclasses import asdict, fields, replace
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from labutopia_lerobot.datasets.annotations import annotated_candidate
from labutopia_lerobot.datasets.candidate import (
    COLORS,
    COLUMNS,
    SUMMARY,
    UNFINISHED,
    Candidate,
    candidate_folder,
    finished_candidates,
    read_candidate,
)
from labutopia_lerobot.datasets.dataset_assembly import Assembly
from labutopia_lerobot.datasets.declaration import (
    ENVIRONMENT_STATE,
    PRIVILEGED_STATE,
    privileged_state,
)
from labutopia_lerobot.datasets.description import RECORDING, read_recording
from labutopia_lerobot.datasets.frames import Columns
from labutopia_lerobot.datasets.looking import drawn_with
from labutopia_lerobot.datasets.playback import Playback, Player
from labutopia_lerobot.datasets.recorder import Watcher
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import claim, publish
from labutopia_lerobot.datasets.replay import ForeignDatasetError
from labutopia_lerobot.datasets.restoring import restore_candidates
from labutopia_lerobot.datasets.tables import Row, frames_of_episodes, read_episodes
from labutopia_lerobot.datasets.verify import require_intact
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.pictures import camera_and_kind, picture_names
from labutopia_lerobot.runtime.provenance import machine
from labutopia_lerobot.runtime.video import VideoWriter
from labutopia_lerobot.setting import NUMBERS
from labutopia_lerobot.sim.renderers import renderer_name

_SOURCE = "source"
"""Folder of the episodes as they are, beside those that are drawn anew."""


class UnfaithfulReplayError(UserError):
    """An episode that does not go as it was recorded; the message says from where on."""


def render(
    root: Path, out: Path, watcher: Watcher, tasks_dir: str | None = None, **chosen: Any
) -> list[Candidate]:
    """Draw a dataset anew; interrupted, the same call goes on.

    Args:
        root: Folder of the dataset; it is not changed.
        out: Folder of the new one.
        watcher: Notified of the progress.
        tasks_dir: A further folder of tasks, which the user trusts.
        **chosen: Fields of `Setting` that pictures depend on, such as `cameras`.

    Returns:
        Every candidate of the new dataset, as the old one has them.

    Raises:
        ForeignDatasetError: If the dataset does not say how it was recorded.
        UnfaithfulReplayError: If an episode does not go as it was recorded.
        UserError: If the setting is impossible, or the folder in other use.
    """
    config = _config(root, out, chosen | {"tasks_dir": tasks_dir})
    config.check()
    chosen |= {"obs": "pixels", "extras": config.setting(config.tasks[0]).extras}
    with claim(out, config.provenance) as work:
        source = work / _SOURCE
        source.mkdir(exist_ok=True)
        restore_candidates(root, source)
        watcher.resumed(finished_candidates(work))
        _draw_all(root, source, work, config, watcher, chosen)
        shutil.rmtree(source)
        order = {task: number for number, task in enumerate(config.tasks)}
        candidates = sorted(finished_candidates(work), key=lambda c: (order[c.task], c.index))
        dataset = Assembly(config, work, watcher.assembled).finish(candidates)
        require_intact(dataset)
        publish(out, dataset)
    return candidates


def _config(root: Path, out: Path, chosen: dict[str, Any]) -> RecordingConfig:
    recording = read_recording(root)
    if recording is None:
        raise ForeignDatasetError(
            f"{root} has no {RECORDING}: labutopia-record did not make it, or a tool of LeRobot "
            "has edited it. Draw what it was made of anew, and edit that"
        )
    if recording["config"].get("cut"):
        raise ForeignDatasetError(f"{root} was cut: draw the whole recording anew, and cut that")
    known = {option.name for option in fields(RecordingConfig)}
    recorded = {name: v for name, v in recording["config"].items() if name in known}
    if recorded.get("hidden"):
        raise UserError(
            f"{root} was recorded with hidden={list(recorded['hidden'])}, and beside pictures the "
            "whole privileged state is kept: record it anew, with obs=pixels and the same seed="
        )
    numbers = set(NUMBERS) & set(recorded.get("extras", ()))  # are in the tables, or are not
    missing = sorted(set(NUMBERS) & set(chosen.get("extras", ())) - numbers)
    if missing:
        raise UserError(
            f"{root} has no {' and no '.join(missing)}, which no picture shows: record them"
        )
    extras = sorted({*chosen.get("extras", ()), *numbers})
    changed = chosen | {"obs": "pixels", "extras": extras, "root": str(out)}
    return RecordingConfig(**(recorded | changed))


def _draw_all(
    root: Path,
    source: Path,
    work: Path,
    config: RecordingConfig,
    watcher: Watcher,
    chosen: dict[str, Any],
) -> None:
    """Put every candidate into `work`, those with frames with new pictures."""
    for folder in source.glob("candidate_*"):
        if not read_candidate(folder).stored(config.keep) and not (work / folder.name).exists():
            shutil.copytree(folder, work / folder.name)
    tasks_dir = config.setting(config.tasks[0]).tasks_dir
    player = Player(tasks_dir)
    try:
        for row, frames in frames_of_episodes(root, read_episodes(root)):
            before = annotated_candidate(row, config.seed)
            place = candidate_folder(work, before.task, before.index)
            if place.exists():  # drawn before an interruption
                continue
            unfinished = Path(tempfile.mkdtemp(dir=work, suffix=UNFINISHED))
            with _Encoding(unfinished, config) as drawing:
                played = player.play(drawn_with(row, tasks_dir, **chosen), frames, drawing)
            _require_faithful(root, row, played)
            arrays: dict[str, Any] = _columns(source / place.name / COLUMNS)
            np.savez(unfinished / COLUMNS, **(arrays | drawing.statistics()))
            drawn_by = renderer_name(config.setting(before.task).renderer)
            candidate = replace(before, machine=machine(), renderer=drawn_by)
            (unfinished / SUMMARY).write_text(json.dumps(asdict(candidate)))
            unfinished.rename(place)
            watcher.played(candidate)
    finally:
        player.close()


def _require_faithful(root: Path, row: Row, played: Playback | None) -> None:
    if played is None or played.difference is not None:
        where = (
            ""
            if played is None or played.difference is None
            else (f" from frame {played.difference.frame} on, first in {played.difference.key}")
        )
        raise UnfaithfulReplayError(
            f"Episode {row['episode_index']} of {root}, played again, is another one{where}: its "
            f"pictures would not show what its tables say. {RECORDING} says with which versions "
            "it was recorded: render with those"
        )


def _columns(file: Path) -> Columns:
    """Return the columns of a candidate, in the form of a dataset with pictures."""
    with np.load(file) as stored:
        columns = {key: stored[key] for key in stored if not key.startswith(COLORS)}
    if ENVIRONMENT_STATE in columns:
        states = columns.pop(ENVIRONMENT_STATE)
        rows = [privileged_state(state, "pixels")[1] for state in states]
        columns[PRIVILEGED_STATE] = np.array(rows)
    return columns


class _Encoding:
    """A `Look` that encodes what every camera sees; a context manager.

    Args:
        folder: Where the videos go.
        config: Of the new dataset.
    """

    def __init__(self, folder: Path, config: RecordingConfig) -> None:
        setting = config.setting(config.tasks[0])
        size = setting.width, setting.height
        self._videos = {
            name: VideoWriter(folder / f"{name}.mp4", *size, camera_and_kind(name)[1])
            for name in picture_names(setting)
        }
        self._open = ExitStack()

    def __call__(self, number: int, env: LabEnv) -> None:
        """Encode a frame."""
        for name, picture in env.workcell.pictures(list(self._videos)).items():
            self._videos[name].add(picture)

    def statistics(self) -> Columns:
        """Return the statistics of the pictures, as a candidate keeps them."""
        return {
            f"{COLORS}{name}.{statistic}": values
            for name, video in self._videos.items()
            for statistic, values in video.statistics().items()
        }

    def __enter__(self) -> Self:
        for video in self._videos.values():
            self._open.enter_context(video)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._open.__exit__(kind, error, trace)
