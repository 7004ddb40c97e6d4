"""Cost of datasets on this machine: recording, assembling, verifying, reading.

    python scripts/dataset_speed.py task=level1/pick episodes=40

takes the options of `labutopia-record` but `root`, and prints one JSON object: frames per second of
a recording with all that belongs to it, of the same episodes played and drawn and thrown away by as
many processes, and the first over the second; how many times longer the second half of the episodes
took to be put together than the first, in processor time; for how many seconds of robot a second of
verifying without pictures is enough; the largest resident memory of any process [MB]; and how much
longer a frame takes to be read at random than one of a set of the same pictures that LeRobot's own
writer wrote.
"""

import json
import resource
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.record import parse
from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.demonstration import demonstrate
from labutopia_lerobot.datasets.recorder import record
from labutopia_lerobot.datasets.verify import verify
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.runtime.workers import in_processes
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import CONTROL_HZ

if TYPE_CHECKING:  # workers import this file too, and torch is none of a recording's memory
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

_READ = 200
"""Frames that are read of each set."""

_FILLED = ("timestamp", "frame_index", "episode_index", "index", "task_index", "task")
"""Columns that LeRobot's writer fills itself."""


@clear_errors
def main() -> None:
    """Measure what the command line asks for."""
    with tempfile.TemporaryDirectory() as folder:
        (config,) = parse([*sys.argv[1:], f"root={folder}/ours"]).datasets()
        (task,) = config.tasks
        watch = _Watch()
        begun = time.perf_counter()
        candidates = record(config, watch)
        recorded = watch.frames / (time.perf_counter() - begun)
        memory = max(
            resource.getrusage(who).ru_maxrss
            for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
        )
        begun = time.perf_counter()
        seeds = [candidate.seed for candidate in candidates]
        shares = [
            (config.setting(task), seeds[one :: config.workers]) for one in range(config.workers)
        ]
        played = sum(in_processes(play, shares, config.workers)) / (time.perf_counter() - begun)
        begun = time.perf_counter()
        faults = verify(config.folder, 0).faults
        verified = watch.frames / CONTROL_HZ / (time.perf_counter() - begun)
        from lerobot.datasets.lerobot_dataset import LeRobotDataset

        ours = LeRobotDataset("local/ours", root=config.folder)
        theirs = write_with_lerobot(ours, Path(folder) / "theirs")
        figures = {
            "frames": watch.frames,
            "faults": len(faults),
            "record_fps": round(recorded, 1),
            "play_and_draw_fps": round(played, 1),
            "record_over_play": round(recorded / played, 3),
            "second_half_over_first": round(watch.second_half_over_first, 2),
            "verified_over_real_time": round(verified, 1),
            "memory_mb": round(memory / 1024),
            "read_over_lerobots": round(read_ratio(ours, theirs), 3) if theirs else None,
        }
    sys.stdout.write(json.dumps(figures) + "\n")


class _Watch:
    """Notes how much of this process's time each episode took to be put into the dataset."""

    def __init__(self) -> None:
        self.frames = 0
        self._moments: list[float] = []

    def resumed(self, candidates: Sequence[Candidate]) -> None:
        """Ignore it: nothing is resumed."""

    def played(self, candidate: Candidate) -> None:
        """Ignore it: others play."""

    def assembled(self, candidate: Candidate) -> None:
        """Note when it was in the dataset."""
        self.frames += candidate.frames
        self._moments.append(time.process_time())

    @property
    def second_half_over_first(self) -> float:
        """Time of the second half of the episodes over the first half, the very first left out."""
        took = np.diff(self._moments)[1:]
        half = len(took) // 2
        return float(took[-half:].sum() / took[:half].sum())


def play(setting: Setting, seeds: Sequence[int]) -> int:
    """Play demonstrations, look at them and keep nothing; return their number of frames."""
    env = LabEnv(setting)
    frames = sum(demonstrate(env, seed, lambda pictures: None).frames for seed in seeds)
    env.close()
    return frames


def write_with_lerobot(ours: "LeRobotDataset", root: Path) -> "LeRobotDataset | None":
    """Return a copy that LeRobot's own writer made, by its own defaults; None without pictures."""
    if not ours.meta.video_keys:
        return None
    features = {key: f for key, f in ours.features.items() if key not in _FILLED}
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    theirs = LeRobotDataset.create("local/theirs", CONTROL_HZ, features, root, use_videos=True)
    for index in range(min(len(ours), 4 * _READ)):
        item = ours[index]
        if index and item["episode_index"] != ours.hf_dataset[index - 1]["episode_index"]:
            theirs.save_episode()
        theirs.add_frame(
            {key: _as_written(item[key], features[key]) for key in features}
            | {"task": item["task"]}
        )
    theirs.save_episode()
    theirs.finalize()
    return LeRobotDataset("local/theirs", root=root)


def _as_written(value: Any, feature: dict[str, Any]) -> Any:
    """Return a value that was read in the form in which it is written."""
    if feature["dtype"] == "video":
        return (value.permute(1, 2, 0).numpy() * 255).round().astype(np.uint8)
    if feature["dtype"] == "string":
        return value
    return np.asarray(value, dtype=feature["dtype"]).reshape(feature["shape"])


def read_ratio(ours: "LeRobotDataset", theirs: "LeRobotDataset") -> float:
    """Return how much longer a frame of ours takes to be read, median of alternating reads."""
    indices = np.random.default_rng(0).integers(len(theirs), size=_READ).tolist()
    took: list[list[float]] = [[], []]
    for index in indices:
        for times, dataset in zip(took, (ours, theirs), strict=True):
            begun = time.process_time()
            dataset[index]
            times.append(time.process_time() - begun)
    return float(np.median(took[0]) / np.median(took[1]))


if __name__ == "__main__":
    main()
