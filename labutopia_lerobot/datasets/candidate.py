"""A candidate: one attempt at a demonstration, played by a worker process and kept in a folder."""

import json
import shutil
import signal
import tempfile
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import av
import numpy as np

from labutopia_lerobot.datasets.demonstration import Demonstration, Pictures, demonstrate
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.routes import Routes
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.pictures import camera_and_kind, picture_names
from labutopia_lerobot.runtime.provenance import machine
from labutopia_lerobot.runtime.video import VideoWriter
from labutopia_lerobot.runtime.workers import become_worker
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.renderers import renderer_name
from labutopia_lerobot.task import SUCCESS

SUMMARY = "candidate.json"
COLUMNS = "columns.npz"
COLORS = "colors."
"""Prefix of the statistics of pictures in `COLUMNS`; picture and statistic follow."""

UNFINISHED = ".tmp"
"""Suffix of the folder of a candidate that is still being played."""

FEWEST_FRAMES = 2
"""Frames of an episode that is stored: LeRobot has no statistics of a single one."""


@dataclass(frozen=True)
class Candidate:
    """Result of one candidate.

    Attributes:
        task: Id of its task.
        index: Its place in the order of trial of its task.
        seed: What the environment was reset with.
        outcome: "success", another outcome of the environment, or "expert failed".
        cause: Why it is no success; empty for a success.
        frames: Number of frames played.
        machine: What it was played on.
        renderer: What drew the pictures; empty where there are none.
        drawn: Axis -> what the episode drew on it.
        volumes: Where the liquid was at the end, as in the environment's `info` [ml].
        instruction: Instruction of the episode, as the episode says it.
        paraphrases: Other ways to say it.
        privileged: What the elements of the privileged state are called.
        routes: Map and planned paths; None where nobody drives.
    """

    task: str
    index: int
    seed: int
    outcome: str
    cause: str
    frames: int
    machine: str
    renderer: str
    drawn: dict[str, Value]
    volumes: dict[str, float]
    instruction: str
    paraphrases: tuple[str, ...]
    privileged: tuple[str, ...]
    routes: Routes | None

    @property
    def success(self) -> bool:
        """Whether the demonstration succeeded."""
        return self.outcome == SUCCESS

    def stored(self, keep: str) -> bool:
        """Return whether its frames are stored.

        Args:
            keep: Which candidates are (`RecordingConfig.keep`).
        """
        return self.success or (keep == "failures" and self.frames >= FEWEST_FRAMES)


def candidate_folder(work: Path, task: str, index: int) -> Path:
    """Return the folder of a candidate, which exists once it is finished."""
    return work / f"candidate_{task.replace('/', '_')}_{index:06d}"


def finished_candidates(work: Path) -> list[Candidate]:
    """Return every finished candidate; forget those that were being played."""
    for folder in work.glob(f"*{UNFINISHED}"):
        shutil.rmtree(folder)
    return [read_candidate(folder) for folder in sorted(work.glob("candidate_*"))]


def read_candidate(folder: Path) -> Candidate:
    """Return the candidate that a folder holds."""
    return candidate_of(json.loads((folder / SUMMARY).read_text()))


def candidate_of(fields: dict[str, Any]) -> Candidate:
    """Return the candidate that JSON describes."""
    several = {name: tuple(fields[name]) for name in ("paraphrases", "privileged")}
    return Candidate(**(fields | several))


_environments: dict[Setting, LabEnv] = {}
"""The environment of this worker process, by its setting, compiled once; there is one at most."""


def start_worker() -> None:
    """Prepare a worker process."""
    become_worker(signal.SIG_IGN)


def play_candidate(config: RecordingConfig, work: Path, task: str, index: int) -> Candidate:
    """Play a candidate in a worker process; its folder appears whole or not at all.

    Raises:
        OSError: If it cannot be written, for example because the disk is full.
    """
    unfinished = Path(tempfile.mkdtemp(dir=work, suffix=UNFINISHED))
    try:
        candidate = play_into(unfinished, config, task, index)
    except av.FFmpegError as error:
        raise OSError(error.errno, error.strerror, str(unfinished)) from None
    unfinished.rename(candidate_folder(work, task, index))
    return candidate


def play_into(folder: Path, config: RecordingConfig, task: str, index: int) -> Candidate:
    """Play a candidate and put everything that is kept of it into a folder."""
    env = _environment(config.setting(task))
    names = picture_names(env.setting)
    size = env.setting.width, env.setting.height
    with ExitStack() as stack:
        videos = {
            name: stack.enter_context(
                VideoWriter(folder / f"{name}.mp4", *size, camera_and_kind(name)[1])
            )
            for name in names
        }

        def film(pictures: Pictures) -> None:
            for name, video in videos.items():
                video.add(pictures[name])

        with located_in_play(task, config.tasks_dir):
            demonstration = demonstrate(env, config.seed + index, film, config.pace)
    candidate = _summary(env, config.seed + index, index, demonstration)
    if candidate.stored(config.keep):
        arrays: dict[str, Any] = dict(demonstration.columns)
        for name, video in videos.items():
            statistics = video.statistics().items()
            arrays |= {f"{COLORS}{name}.{statistic}": values for statistic, values in statistics}
        np.savez(folder / COLUMNS, **arrays)
    else:
        for name in names:
            (folder / f"{name}.mp4").unlink()
    (folder / SUMMARY).write_text(json.dumps(asdict(candidate)))
    return candidate


def _environment(setting: Setting) -> LabEnv:
    if setting not in _environments:
        for other in _environments.values():
            other.close()
        _environments.clear()
        _environments[setting] = LabEnv(setting)
    return _environments[setting]


def _summary(env: LabEnv, seed: int, index: int, demonstration: Demonstration) -> Candidate:
    info, played = demonstration.info, env.workcell.task
    return Candidate(
        task=env.setting.task,
        index=index,
        seed=seed,
        outcome=demonstration.outcome,
        cause=demonstration.cause,
        frames=demonstration.frames,
        machine=machine(),
        renderer=renderer_name(env.setting.renderer) if env.setting.obs == "pixels" else "",
        drawn=info["drawn"],
        volumes={name: value for name, value in info.items() if name.startswith("ml_")},
        instruction=env.task,
        paraphrases=played.paraphrases,
        privileged=environment_state_names(played, env.setting.hidden),
        routes=demonstration.routes,
    )
