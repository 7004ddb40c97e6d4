"""What to record: the schema and the defaults of `labutopia-record`."""

import os
from dataclasses import asdict, field
from pathlib import Path
from typing import Any

from omegaconf import MISSING

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.video import require_filmable
from labutopia_lerobot.setting import Setting, setting_of, with_setting


class RecordingOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which values are possible."""


@with_setting
class RecordingConfig:
    """Options of a recording; the fields of `Setting` are options too.

    Attributes:
        task: Task id, such as `level1/pick`.
        split: `train`, from which policies are to learn, or another for measurements.
        episodes: How many successful demonstrations to store.
        workers: Processes that play candidates; the dataset does not depend on it.
        seed: Candidate i resets with `seed + i`.
        root: Folder of the dataset; `outputs/datasets/<task>` when empty.
        repo_id: Name of the dataset on the Hub; `local/<name of the task>` when empty.
    """

    task: str = MISSING
    split: str = "train"
    episodes: int = 100
    workers: int = field(default_factory=lambda: len(os.sched_getaffinity(0)))
    seed: int = 0
    root: str = ""
    repo_id: str = ""

    def __post_init__(self) -> None:
        self.root = self.root or f"outputs/datasets/{self.task}"
        self.repo_id = self.repo_id or f"local/{self.task.rpartition('/')[2]}"

    @property
    def setting(self) -> Setting:
        """What is played and observed.

        Raises:
            UnknownOptionError: If a value is impossible.
            UnknownTaskError: If there is no such task.
        """
        return setting_of(self)

    def check(self) -> None:
        """Check every value.

        Raises:
            RecordingOptionError: If a number is out of its range.
            UserError: If the task cannot be played in this setting.
        """
        for name, least in {"episodes": 1, "workers": 1, "seed": 0}.items():
            if getattr(self, name) < least:
                raise RecordingOptionError(
                    f"{name}={getattr(self, name)} is too small: {name} is at least {least}"
                )
        if self.repo_id.count("/") != 1:
            raise RecordingOptionError(
                f"repo_id={self.repo_id} must have one slash, such as local/pick"
            )
        require_filmable(self.setting.width, self.setting.height)
        self.make_environment()

    def make_environment(self) -> LabEnv:
        """Return the environment to record in; nothing is compiled yet."""
        return LabEnv(self.setting)

    @property
    def folder(self) -> Path:
        """Folder of the dataset."""
        return Path(self.root)

    @property
    def provenance(self) -> dict[str, dict[str, Any]]:
        """Everything that decides what the dataset holds: options, code, versions of packages.

        Raises:
            UnknownTaskError: If there is no such task.
        """
        options = asdict(self)
        del options["workers"], options["root"]
        return {
            "config": options,
            "code": provenance.code([self.task], self.setting.tasks_dir),
            "versions": provenance.versions(),
        }
