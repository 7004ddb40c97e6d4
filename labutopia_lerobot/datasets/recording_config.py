"""What to record: the schema and the defaults of `labutopia-record`."""

import os
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.declaration import same_features
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.registry import choose_tasks, listed
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.runtime.video import require_filmable
from labutopia_lerobot.scenario.own_files import without_paths
from labutopia_lerobot.setting import (
    Setting,
    SettingOptions,
    option,
    require_choices,
    setting_of,
)

LARGEST_SEED = 2**62
"""Beyond, tables have no numbers."""

SLOWEST = 0.2
"""Least `pace`; ours: no task leaves the time for less."""

KEEP = ("successes", "failures")
LAUNCHERS = ("local", "ray")

_UNRECORDED = ("level", "workers", "launcher", "root", "tasks_dir")
"""Options on which the dataset does not depend, or not once its tasks are listed and the digests of
their files are named."""


class RecordingOptionError(UserError, ValueError):
    """An option with an impossible value; the message says which values are possible."""


@dataclass
class RecordingConfig(SettingOptions):
    """Options of a recording, beside those of every program that plays."""

    task: Any = option(
        None, "Task id such as `level1/pick`, the bare name of a task of the level, or a list."
    )
    level: Any = option(None, "1 to 5, a list of these, or `all`: the paper's tasks.")
    together: bool = option(
        False, "Whether several tasks become one dataset, for which obs=pixels is needed."
    )
    split: str = option(
        "train", "`train`, from which policies are to learn, or another for measurements."
    )
    episodes: int = option(
        100,
        "How many successful demonstrations of each task to store; more than a finished recording"
        " has extend it.",
    )
    keep: str = option(
        "successes", "`successes`, or `failures`: those that fail on the way are stored beside."
    )
    pace: float = option(
        1.0, "How fast the expert's hand moves, as a share of its usual speeds; at most 1."
    )
    language: bool = option(
        False,
        "Whether to write LeRobot's language columns too: paraphrases, steps, substeps and phases.",
    )
    workers: int = field(
        default_factory=lambda: len(os.sched_getaffinity(0)),
        metadata={"help": "Processes that play candidates; the dataset does not depend on it."},
    )
    launcher: str = option(
        "local", "`local`, or `ray`: on every machine of a Ray cluster, whatever `workers` says."
    )
    seed: int = option(0, "Candidate i resets with `seed + i`.")
    root: str = option(
        "",
        "Folder of the dataset, or of those of several tasks; `outputs/datasets/<task>` when "
        "empty, and `outputs/datasets/level<level>` for several tasks together; of a step "
        "`<task>-<step>`.",
    )
    repo_id: str = option(
        "", "Name of the dataset on the Hub; `local/<name of the task or level>` when empty."
    )

    @property
    def tasks(self) -> list[str]:
        """Ids of the tasks to record.

        Raises:
            UnknownTaskError: If none is named, or one that does not exist.
        """
        return choose_tasks(self.task, self.level, self.tasks_dir)

    def datasets(self) -> "Iterator[RecordingConfig]":
        """Yield the options of each dataset, with its tasks, folder and name filled in.

        Raises:
            RecordingOptionError: If one folder or name is given for several datasets.
            UnknownTaskError: If no task is named, or one that does not exist.
        """
        tasks, step = self.tasks, self.step
        only = "" if step is None else f"-{step}"
        if len(tasks) == 1 or self.together:
            task = tasks if len(tasks) > 1 else tasks[0]
            name = "+".join(f"level{level}" for level in listed(self.level)) if self.level else ""
            name = (tasks[0] if len(tasks) == 1 else name or "together") + only
            yield self._one(task, self.root or f"outputs/datasets/{name}", name)
            return
        if self.repo_id:
            raise RecordingOptionError(
                f"repo_id={self.repo_id} names one dataset, but there are {len(tasks)} tasks: "
                "leave it out, or record them with together=true"
            )
        for task in tasks:
            name = task + only
            yield self._one(task, f"{self.root or 'outputs/datasets'}/{name}", name)

    def setting(self, task: str) -> Setting:
        """Return what is played and observed of a task.

        Raises:
            UnknownOptionError: If a value is impossible.
            UnknownTaskError: If there is no such task.
        """
        return setting_of(self, task=task)

    def check(self) -> None:
        """Check every value.

        Raises:
            RecordingOptionError: If a number is out of its range, or tasks cannot be together.
            UserError: If a task cannot be played in this setting.
        """
        for name, least in {"episodes": 1, "workers": 1, "seed": 0}.items():
            if getattr(self, name) < least:
                raise RecordingOptionError(
                    f"{name}={getattr(self, name)} is too small: {name} is at least {least}"
                )
        if self.seed + self.episodes >= LARGEST_SEED:
            raise RecordingOptionError(
                f"seed={self.seed} is too large: seeds are below {LARGEST_SEED}"
            )
        if not SLOWEST <= self.pace <= 1.0:
            raise RecordingOptionError(
                f"pace={self.pace} is impossible: it is from {SLOWEST:g} to 1, the usual"
            )
        require_choices("keep", [self.keep], KEEP)
        require_choices("launcher", [self.launcher], LAUNCHERS)
        if self.repo_id.count("/") != 1:
            raise RecordingOptionError(
                f"repo_id={self.repo_id} must have one slash, such as local/pick"
            )
        settings = [self.setting(task) for task in self.tasks]
        for setting in settings:
            require_filmable(setting.width, setting.height)
            LabEnv(setting)  # compiles nothing
        if not same_features(settings):
            raise RecordingOptionError(
                "obs=state cannot be recorded together: every task has another "
                "observation.environment_state. Use obs=pixels, or leave together=true out"
            )

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
        options = self.chosen
        for name in _UNRECORDED:
            del options[name]
        return {
            "config": without_paths(options),
            "code": provenance.code(self.tasks, self.tasks_dir),
            "versions": provenance.versions(),
        }

    def _one(self, task: Any, root: str, name: str) -> "RecordingConfig":
        repo_id = self.repo_id or f"local/{name.rpartition('/')[2]}"
        return replace(self, task=task, level=None, root=root, repo_id=repo_id)
