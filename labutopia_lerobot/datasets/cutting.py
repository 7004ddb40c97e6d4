"""Cutting whole demonstrations into those of their steps, for policies that play a step each.

A step begins in the moment in which the one before is done, and there it is cut. So one recording
serves both a policy that plays the whole task and one per step; recorded by itself, a step has the
expert play all those before it again. An episode that was cut is replayed from its seed too: what
comes before its first frame the expert plays as it did.
"""

import json
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.datasets.assembler import open_to_group
from labutopia_lerobot.datasets.candidate import FEWEST_FRAMES
from labutopia_lerobot.datasets.declaration import IMAGES, STEP, dataset_features
from labutopia_lerobot.datasets.description import RECORDING, read_info, read_recording
from labutopia_lerobot.datasets.language import add_language_columns
from labutopia_lerobot.datasets.replay import ForeignDatasetError
from labutopia_lerobot.datasets.restoring import recorded_columns
from labutopia_lerobot.datasets.tables import (
    CUT,
    OURS,
    OUTCOME,
    ROUTES,
    VOLUMES,
    Cut,
    Row,
    episode_setting,
    frames_of_episodes,
    read_episodes,
    video_file,
)
from labutopia_lerobot.datasets.verify import require_intact
from labutopia_lerobot.datasets.writer import EncodedDatasetWriter, Video
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.pictures import camera_and_kind
from labutopia_lerobot.runtime.video import KEYFRAME_INTERVAL, copy_frames, statistics_of_video
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import require_choices
from labutopia_lerobot.task import SUCCESS

_OF_THE_WHOLE = (VOLUMES, ROUTES)
"""Columns of the episode table that say how a whole episode ends, or which ways it goes."""


class CuttingError(UserError):
    """A dataset or a step that cannot be cut; the message says why."""


class NothingOfStepError(CuttingError):
    """A step that takes no time in any demonstration: it is done as soon as the one before."""


def steps_of(root: Path, tasks_dir: str | None = None) -> list[str]:
    """Return the names of the steps that a dataset can be cut into, in the task's order.

    Raises:
        CuttingError: If it is no recording of one whole task of several steps.
        ForeignDatasetError: If it does not say how it was recorded.
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    config = _recording(root)["config"]
    setting = episode_setting(read_episodes(root)[0], tasks_dir)
    if isinstance(config["task"], list) or config.get("step") is not None or setting is None:
        raise CuttingError(f"{root} is no recording of one whole task: cut such a one")
    names = [step.name for step in canonical_task(setting).steps]
    if len(names) == 1:
        raise CuttingError(f"{root} is of {setting.task}, which has one step: nothing to cut")
    return names


def cut(root: Path, step: str, out: Path, tasks_dir: str | None = None) -> int:
    """Cut a step out of every demonstration, and return how many episodes that makes.

    A demonstration in which the step takes no time is left out: it is done as soon as the one
    before, and nothing can be learned from it.

    Args:
        root: Folder of the dataset, which is not changed.
        step: Name of the step, such as `3_place`.
        out: Folder of the new dataset; must not exist. It appears whole or not at all.
        tasks_dir: A further folder of tasks, which the user trusts.

    Raises:
        CuttingError: If the dataset is no recording of one whole task of several steps, or `out`
            exists.
        NothingOfStepError: If nothing is left.
        UnknownOptionError: If there is no such step.
        ForeignDatasetError: If the dataset does not say how it was recorded.
        DamagedDatasetError: If a file is missing or cannot be read.
    """
    require_choices("step", [step], steps_of(root, tasks_dir))
    if out.exists():
        raise CuttingError(f"{out} is there already: delete it, or choose another folder")
    recording = _recording(root)
    config = recording["config"]
    config |= {"step": step, "cut": True, "repo_id": f"{config['repo_id']}-{step}", "episodes": 0}
    rows = read_episodes(root)
    episodes = [row for row in rows if row.get(OUTCOME) == SUCCESS]
    setting = episode_setting(rows[0], tasks_dir)
    assert setting is not None  # `steps_of` refuses those that have none
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent) as place:
        draft = Path(place) / "dataset"
        cutter = _Cutter(root, step, config.get("pace", 1.0), Path(place))
        declared = dataset_features(setting)
        features = {key: each for key, each in declared.items() if key in cutter.info["features"]}
        writer = EncodedDatasetWriter(config["repo_id"], features, setting.robot, draft)
        for row, frames in frames_of_episodes(root, episodes):
            columns = recorded_columns(cutter.info, frames)
            piece = cutter.piece(columns[STEP])
            if piece.stop - piece.start < FEWEST_FRAMES:
                continue
            config["episodes"] += 1
            writer.add(
                row["tasks"][0],
                {key: values[piece] for key, values in columns.items() if key in features},
                cutter.videos(row, piece),
                cutter.annotations(row, piece),
            )
        if not config["episodes"]:
            raise NothingOfStepError(
                f"No demonstration of {root} has {FEWEST_FRAMES} frames of {step}: it is done as "
                "soon as the step before, and nothing can be learned from it"
            )
        writer.finish()
        if config.get("language"):
            add_language_columns(draft)
        (draft / RECORDING).write_text(json.dumps(recording, indent=2) + "\n")
        open_to_group(draft)
        require_intact(draft)
        draft.rename(out)
    return int(config["episodes"])


def _recording(root: Path) -> dict[str, Any]:
    recording = read_recording(root)
    if recording is None:
        raise ForeignDatasetError(
            f"{root} has no {RECORDING}: labutopia-record did not make it, or a tool of LeRobot "
            "has edited it. Cut what it was made of, and edit that"
        )
    return recording


class _Cutter:
    """Cuts one step out of episodes.

    Args:
        root: Folder of the dataset.
        step: Name of the step.
        pace: How fast the expert's hand moved.
        place: Folder for videos that are cut.
    """

    def __init__(self, root: Path, step: str, pace: float, place: Path) -> None:
        self.info = read_info(root)
        self._root, self._step, self._pace, self._place = root, step, pace, place
        features = self.info["features"].items()
        self._videos = [key for key, feature in features if feature["dtype"] == "video"]

    def piece(self, steps: NDArray[np.str_]) -> slice:
        """Return which frames of an episode are the step's, maybe none.

        What comes behind the last step, until the goal has held, is the last one's. Videos are cut
        without being encoded anew, and so at key frames: the first frame may be left out.

        Args:
            steps: Which step is being done in every frame, shape (frames,).
        """
        frames = np.flatnonzero(steps == self._step)
        if not frames.size:
            return slice(0, 0)
        first, end = int(frames[0]), int(frames[-1]) + 1
        end = len(steps) if not any(steps[end:]) else end
        if self._videos:
            first = -(-first // KEYFRAME_INTERVAL) * KEYFRAME_INTERVAL
        return slice(first, end)

    def videos(self, row: Row, piece: slice) -> dict[str, Video]:
        """Return the pictures of a piece of an episode: feature key -> file and statistics."""
        cut_videos: dict[str, Video] = {}
        for key in self._videos:
            kind = camera_and_kind(key.removeprefix(IMAGES))[1]
            before = round(row[f"videos/{key}/from_timestamp"] * self.info["fps"])
            file = self._place / f"{key}.mp4"
            copy_frames(
                video_file(self._root, row, key),
                file,
                before + piece.start,
                piece.stop - piece.start,
            )
            cut_videos[key] = (file, statistics_of_video(file, kind))
        return cut_videos

    def annotations(self, row: Row, piece: slice) -> dict[str, int | str]:
        """Return the columns of our own in the episode table, for a piece of an episode."""
        kept = {name: row[name] for name in row if name.startswith(OURS) and row[name] is not None}
        for name in _OF_THE_WHOLE:
            kept.pop(name, None)
        whole = piece.stop == row["length"]
        cut_of = Cut(step=self._step, first=piece.start, pace=self._pace, last=whole)
        return kept | {CUT: json.dumps(cut_of)}
