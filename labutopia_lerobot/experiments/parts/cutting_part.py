"""The part that cuts a step out of a recording, for the policy that plays it alone."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.description import RECORDING
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, sources
from labutopia_lerobot.experiments.parts.recording_part import (
    RecordingPart,
    VerificationPart,
    dataset_digest,
)


@dataclass(frozen=True)
class CuttingPart:
    """The demonstrations of one step of a task.

    Attributes:
        out: Folder of the experiment.
        recording: What it is cut out of.
        step: Name of the step.
    """

    out: Path
    recording: RecordingPart
    step: str

    @property
    def subject(self) -> str:
        """The task and the step, in words and as a path."""
        return f"{self.recording.task}-{self.step}"

    @property
    def name(self) -> str:
        recorded = self.recording
        return f"cut {self.subject} {recorded.variety} {recorded.demonstrations}"

    @property
    def rate_key(self) -> str:
        return f"cut {self.recording.obs}"

    @property
    def size(self) -> float:
        return self.recording.size

    @property
    def volume(self) -> float:
        return self.size

    @property
    def place(self) -> Path:
        recorded = self.recording
        kind = Path(recorded.variety, str(recorded.demonstrations))
        return self.out / "datasets" / self.subject / kind

    @property
    def cores(self) -> int:
        return 1

    @property
    def gpus(self) -> int:
        return 0

    @property
    def needs(self) -> tuple[ExperimentPart, ...]:
        return (self.recording, VerificationPart(self.out, self.recording))

    @property
    def peak_bytes(self) -> None:
        return None

    def check(self) -> None:
        """Check nothing: what can be recorded can be cut, and the steps are the task's own."""

    def inputs(self) -> dict[str, Any]:
        """Return the content of the dataset, the step, the code and the versions."""
        tasks_dir = self.recording.config.tasks_dir
        code = sources(self.recording.task, tasks_dir=tasks_dir)
        return {"dataset": self.recording.digest(), "step": self.step, **code}

    def prepare(self) -> None:
        """Do nothing: what was killed has left nothing."""

    def command(self) -> list[str]:
        """Return the command that cuts."""
        program = [sys.executable, "-m", "labutopia_lerobot.cli.cut", str(self.recording.place)]
        tasks_dir = self.recording.config.tasks_dir
        own = [] if tasks_dir is None else [f"--tasks-dir={tasks_dir}"]
        return [*program, f"--step={self.step}", f"--out={self.place}", *own]

    def progress(self) -> float:
        """Return nothing: it takes seconds."""
        return 0.0

    def finished(self) -> bool:
        """Return whether the dataset is there, which it is whole or not at all."""
        return (self.place / RECORDING).is_file()

    def digest(self) -> str:
        """Return a hash of tables and videos."""
        return dataset_digest(self.place)
