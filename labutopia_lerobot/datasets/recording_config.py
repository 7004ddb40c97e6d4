"""What to record: the schema and the defaults of `labutopia-record`."""

import os
from dataclasses import asdict, dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

from omegaconf import MISSING

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.features import CAMERAS, IMAGE_SIZE

SPLIT = "train"
"""Demonstrations are drawn from the training values with the training seeds, always."""

_PACKAGES = ("lerobot_env_labutopia", "mujoco", "mink", "daqp", "numba", "numpy", "av", "lerobot")
"""Another version of any of these may give another dataset."""


class RecordingOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which values are possible."""


@dataclass
class RecordingConfig:
    """Options of a recording.

    Attributes:
        task: Task id, such as `level1/pick`.
        episodes: How many successful demonstrations to store.
        obs: `pixels` or `state`.
        workers: Processes that play candidates; the dataset does not depend on it.
        seed: Candidate i resets with `seed + i`.
        root: Folder of the dataset; `outputs/datasets/<task>` when empty.
        repo_id: Name of the dataset on the Hub; `local/<name of the task>` when empty.
        tasks_dir: A further folder of tasks.
        cameras: Which cameras to film with `obs=pixels`.
        width: Width of the pictures [pixels].
        height: Height of the pictures [pixels].
        liquid: `on`, or `off` for empty vessels.
    """

    task: str = MISSING
    episodes: int = 100
    obs: str = "pixels"
    workers: int = field(default_factory=lambda: len(os.sched_getaffinity(0)))
    seed: int = 0
    root: str = ""
    repo_id: str = ""
    tasks_dir: str | None = None
    cameras: list[str] = field(default_factory=lambda: list(CAMERAS))
    width: int = IMAGE_SIZE
    height: int = IMAGE_SIZE
    liquid: str = "on"

    def __post_init__(self) -> None:
        self.root = self.root or f"outputs/datasets/{self.task}"
        self.repo_id = self.repo_id or f"local/{self.task.rpartition('/')[2]}"

    def check(self) -> None:
        """Check every value.

        Raises:
            RecordingOptionError: If a number is out of its range, or a camera is named twice.
            UnknownOptionError: If a word is not one of its choices.
            UnknownTaskError: If there is no such task.
        """
        for name, least in {"episodes": 1, "workers": 1, "seed": 0}.items():
            if getattr(self, name) < least:
                raise RecordingOptionError(
                    f"{name}={getattr(self, name)} is too small: {name} is at least {least}"
                )
        for name in ("width", "height"):
            if getattr(self, name) < 16 or getattr(self, name) % 2:
                raise RecordingOptionError(
                    f"{name}={getattr(self, name)} cannot be filmed: H.264 takes even numbers "
                    "from 16 pixels"
                )
        if len(set(self.cameras)) < len(self.cameras):
            raise RecordingOptionError(
                f"cameras={self.cameras} names one twice. Choose from: {', '.join(CAMERAS)}"
            )
        if self.repo_id.count("/") != 1:
            raise RecordingOptionError(
                f"repo_id={self.repo_id} must have one slash, such as local/pick"
            )
        self.make_environment()

    def make_environment(self) -> LabEnv:
        """Return the environment to record in; nothing is compiled yet."""
        return LabEnv(
            self.task,
            obs=self.obs,
            cameras=tuple(self.cameras),
            width=self.width,
            height=self.height,
            split=SPLIT,
            tasks_dir=self.tasks_dir,
            liquid=self.liquid,
        )

    @property
    def folder(self) -> Path:
        """Folder of the dataset."""
        return Path(self.root)

    @property
    def provenance(self) -> dict[str, dict[str, Any]]:
        """Everything that decides what the dataset holds: options and versions of packages."""
        options = asdict(self)
        del options["workers"], options["root"]
        return {
            "config": options | {"split": SPLIT},
            "versions": {package: version(package) for package in _PACKAGES},
        }
