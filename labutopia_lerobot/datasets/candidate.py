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
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.runtime.video import VideoWriter
from labutopia_lerobot.runtime.workers import become_worker
from labutopia_lerobot.scenario.draw import Value
from labutopia_lerobot.sim.renderer import opengl_renderer_name
from labutopia_lerobot.task import SUCCESS

SUMMARY = "candidate.json"
COLUMNS = "columns.npz"
HISTOGRAM = "histogram."
"""Prefix of the colour histograms in `COLUMNS`; the camera follows."""

UNFINISHED = ".tmp"
"""Suffix of the folder of a candidate that is still being played."""


@dataclass(frozen=True)
class Candidate:
    """What became of one candidate.

    Attributes:
        index: Its place in the order of trial.
        seed: What the environment was reset with.
        outcome: "success", another outcome of the environment, or "expert failed".
        cause: Why it is no success, or None.
        frames: Number of frames played.
        phases: Label of each phase of the expert and the frame in which it began.
        renderer: What drew the pictures, or None.
        drawn: Axis -> what the episode drew on it.
        instruction: What was to be done, as the episode says it.
    """

    index: int
    seed: int
    outcome: str
    cause: str | None
    frames: int
    phases: tuple[tuple[str, int], ...]
    renderer: str | None
    drawn: dict[str, Value]
    instruction: str

    @property
    def success(self) -> bool:
        """Whether its frames are stored."""
        return self.outcome == SUCCESS


def candidate_folder(work: Path, index: int) -> Path:
    """Return the folder of a candidate, which exists once it is finished."""
    return work / f"candidate_{index:06d}"


def finished_candidates(work: Path) -> list[Candidate]:
    """Return every finished candidate, in index order; forget those that were being played."""
    for folder in work.glob(f"*{UNFINISHED}"):
        shutil.rmtree(folder)
    found = [json.loads(path.read_text()) for path in work.glob(f"candidate_*/{SUMMARY}")]
    phases = [tuple((label, start) for label, start in fields.pop("phases")) for fields in found]
    candidates = [Candidate(**fields, phases=p) for fields, p in zip(found, phases, strict=True)]
    return sorted(candidates, key=lambda candidate: candidate.index)


_environment: LabEnv
"""The environment of this worker process: a scene is compiled once, not once per candidate."""


def start_worker(config: RecordingConfig) -> None:
    """Prepare a worker process."""
    global _environment
    become_worker(signal.SIG_IGN)
    _environment = config.make_environment()


def play_candidate(config: RecordingConfig, work: Path, index: int) -> Candidate:
    """Play a candidate in a worker process; its folder appears whole or not at all.

    Raises:
        OSError: If it cannot be written, for example because the disk is full.
    """
    unfinished = Path(tempfile.mkdtemp(dir=work, suffix=UNFINISHED))
    try:
        candidate = _play_into(unfinished, config, index)
    except av.FFmpegError as error:
        raise OSError(error.errno, error.strerror, str(unfinished)) from None
    unfinished.rename(candidate_folder(work, index))
    return candidate


def _play_into(folder: Path, config: RecordingConfig, index: int) -> Candidate:
    env = _environment
    with ExitStack() as stack:
        videos = {
            camera: stack.enter_context(
                VideoWriter(folder / f"{camera}.mp4", env.setting.width, env.setting.height)
            )
            for camera in (env.setting.cameras if env.setting.obs == "pixels" else ())
        }

        def film(pictures: Pictures) -> None:
            for camera, video in videos.items():
                video.add(pictures[camera])

        demonstration = demonstrate(env, config.seed + index, film)
    if demonstration.outcome == SUCCESS:
        arrays: dict[str, Any] = dict(demonstration.columns)
        arrays |= {f"{HISTOGRAM}{camera}": video.histogram for camera, video in videos.items()}
        np.savez(folder / COLUMNS, **arrays)
    else:
        for camera in videos:
            (folder / f"{camera}.mp4").unlink()
    candidate = _summary(env, config.seed + index, index, demonstration)
    (folder / SUMMARY).write_text(json.dumps(asdict(candidate)))
    return candidate


def _summary(env: LabEnv, seed: int, index: int, demonstration: Demonstration) -> Candidate:
    return Candidate(
        index=index,
        seed=seed,
        outcome=demonstration.outcome,
        cause=demonstration.cause,
        frames=demonstration.frames,
        phases=demonstration.phases,
        renderer=opengl_renderer_name() if env.setting.obs == "pixels" else None,
        drawn=demonstration.drawn,
        instruction=env.task,
    )
