"""The part that records demonstrations of a task, and the one that verifies them."""

import shutil
import sys
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.description import RECORDING, read_recording
from labutopia_lerobot.datasets.disk_space import needed_bytes
from labutopia_lerobot.datasets.recording_config import RecordingConfig
from labutopia_lerobot.datasets.recording_folder import unfinished
from labutopia_lerobot.experiments.parts.experiment_part import (
    ExperimentPart,
    digest_of,
    log_of,
    sources,
)
from labutopia_lerobot.experiments.study import words_of
from labutopia_lerobot.runtime.claim import differences
from labutopia_lerobot.scenario import canonical_task


@dataclass(frozen=True)
class RecordingPart:
    """Demonstrations of a task, or of a step of it.

    Attributes:
        out: Folder of the experiment.
        task: Task id.
        step: The step that is recorded alone, or None.
        demonstrations: How many.
        obs: `pixels` or `state`.
        options: Other options that are not at their defaults, by name.
        workers: Processes that play.
    """

    out: Path
    task: str
    step: str | None
    demonstrations: int
    obs: str
    options: tuple[tuple[str, Any], ...]
    workers: int

    @property
    def subject(self) -> str:
        """The task, or the task and its step, in words and as a path."""
        return self.task if self.step is None else f"{self.task}-{self.step}"

    @property
    def variety(self) -> str:
        """Kind of observation, and the options that are unusual."""
        return "-".join([self.obs, *(f"{name}={_plain(value)}" for name, value in self.options)])

    @property
    def name(self) -> str:
        return f"record {self.subject} {self.variety} {self.demonstrations}"

    @property
    def rate_key(self) -> str:
        return f"record {self.obs}"

    @property
    def size(self) -> float:
        """Seconds of the time limits of all demonstrations [s]."""
        return self.demonstrations * canonical_task(self.config.setting(self.task)).time_limit_s

    @property
    def volume(self) -> float:
        return self.size

    @property
    def place(self) -> Path:
        return self.out / "datasets" / self.subject / self.variety / str(self.demonstrations)

    @property
    def cores(self) -> int:
        return self.workers

    @property
    def gpus(self) -> int:
        return 0

    @property
    def needs(self) -> tuple[ExperimentPart, ...]:
        return ()

    @cached_property
    def config(self) -> RecordingConfig:
        """The options of `labutopia-record`."""
        chosen: dict[str, Any] = {
            "task": self.task,
            "step": self.step,
            "obs": self.obs,
            "episodes": self.demonstrations,
            "workers": self.workers,
            "root": str(self.place),
            **dict(self.options),
        }
        (config,) = RecordingConfig(split="train", **chosen).datasets()
        return config

    @property
    def peak_bytes(self) -> int:
        """About how many bytes it takes on the disk at its peak."""
        return needed_bytes(self.config, {self.task: self.demonstrations})

    def check(self) -> None:
        """Check that the task can be played so."""
        self.config.check()

    def inputs(self) -> dict[str, Any]:
        """Return its options, the code and the versions."""
        options = self.config.provenance["config"]
        return {"config": options, **sources(self.task, tasks_dir=self.config.tasks_dir)}

    def prepare(self) -> None:
        """Begin with a copy of a shorter recording, if there is one: extended it is the same."""
        shorter = self._shorter()
        if self.place.exists() or shorter is None:
            return
        draft = self.place.with_name(f"{self.place.name}.copied")
        shutil.rmtree(draft, ignore_errors=True)
        shutil.copytree(shorter, draft)
        draft.rename(self.place)

    def command(self) -> list[str]:
        """Return the command of the recorder."""
        words = {
            "task": self.task,
            "step": self.step,
            "obs": self.obs,
            "episodes": self.demonstrations,
            "workers": self.workers,
            "root": self.place,
            **dict(self.options),
        }
        return [sys.executable, "-m", "labutopia_lerobot.cli.record", *words_of(words)]

    def progress(self) -> float:
        """Return the share of the demonstrations that are played."""
        played = len(list((self.place / ".recording").glob("candidate_*")))
        return min(played / self.demonstrations, 1.0)

    def finished(self) -> bool:
        """Return whether the recording is published, as long as it is to be."""
        if unfinished(self.place) or not (self.place / RECORDING).is_file():
            return False
        recorded = read_recording(self.place)
        return recorded is not None and recorded["config"].get("episodes") == self.demonstrations

    def digest(self) -> str:
        """Return a hash of tables and videos, whatever code of the same effect recorded them."""
        return dataset_digest(self.place)

    def foreign(self) -> list[str]:
        """Return in what the recording that is there differs from what would be recorded now."""
        there, here = read_recording(self.place) or {}, self.inputs()
        code = {name: there.get("code", {}).get(name) for name in here["code"]}
        return differences({**there, "code": code}, here)

    def _shorter(self) -> Path | None:
        """Return the longest finished recording by the same code that has fewer demonstrations."""
        counts = (int(f.name) for f in self.place.parent.glob("*") if f.name.isdigit())
        for count in sorted(counts, reverse=True):
            shorter = replace(self, demonstrations=count)
            if count < self.demonstrations and shorter.finished() and not shorter.foreign():
                return shorter.place
        return None


def dataset_digest(root: Path) -> str:
    """Return a hash of the tables and videos of a dataset."""
    files = {file.relative_to(root).as_posix(): file for file in root.rglob("*") if file.is_file()}
    files.pop(RECORDING, None)
    return digest_of(files)


_VERDICTS = (" is intact: ", " has no fault in what was checked: ")
"""What `labutopia-verify` says of datasets without faults."""


@dataclass(frozen=True)
class VerificationPart:
    """The verdict of `labutopia-verify` on a recording.

    Attributes:
        out: Folder of the experiment.
        recording: The recording that is verified.
    """

    out: Path
    recording: RecordingPart

    @property
    def name(self) -> str:
        return self.recording.name.replace("record", "verify", 1)

    @property
    def rate_key(self) -> str:
        return f"verify {self.recording.obs}"

    @property
    def size(self) -> float:
        return self.recording.size

    @property
    def volume(self) -> float:
        return self.size

    @property
    def place(self) -> Path:
        """The log, which has its verdict."""
        return log_of(self)

    @property
    def cores(self) -> int:
        return self.recording.workers

    @property
    def gpus(self) -> int:
        return 0

    @property
    def needs(self) -> tuple[ExperimentPart, ...]:
        return (self.recording,)

    def check(self) -> None:
        """Check nothing: what can be recorded can be verified."""

    @property
    def peak_bytes(self) -> int:
        return 0

    def prepare(self) -> None:
        """Do nothing: a verification that was killed begins anew."""

    def inputs(self) -> dict[str, Any]:
        """Return the content of the dataset, and the code."""
        tasks_dir = self.recording.config.tasks_dir
        code = sources(self.recording.task, tasks_dir=tasks_dir)
        return {"dataset": self.recording.digest(), **code}

    def command(self) -> list[str]:
        """Return the command of the verifier."""
        command = [sys.executable, "-m", "labutopia_lerobot.cli.verify", str(self.recording.place)]
        command.append(f"--workers={self.recording.workers}")
        tasks_dir = self.recording.config.tasks_dir
        return command if tasks_dir is None else [*command, f"--tasks-dir={tasks_dir}"]

    def progress(self) -> float:
        """Return nothing: only its end shows how far it was."""
        return 0.0

    def finished(self) -> bool:
        """Return whether the log ends with a verdict, and that is no fault."""
        said = self.place.read_text(errors="replace") if self.place.is_file() else ""
        last = ["", *filter(str.strip, said.splitlines())][-1]  # an earlier try may have failed
        return any(word in last for word in _VERDICTS)

    def digest(self) -> str:
        """Return nothing: nothing is made of a verdict."""
        return ""


def _plain(value: object) -> str:
    """Return a value as a part of a file's name."""
    words = ",".join(map(str, value)) if isinstance(value, tuple) else str(value)
    return "".join(letter if letter.isalnum() or letter in ",._" else "_" for letter in words)
