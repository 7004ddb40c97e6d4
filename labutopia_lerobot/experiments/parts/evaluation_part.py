"""The part that evaluates a policy: one task, one shift, one way of playing."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from labutopia_lerobot.evaluation.condition import REFERENCES, STAGED
from labutopia_lerobot.evaluation.config import EvaluationConfig, PolicyConfig
from labutopia_lerobot.evaluation.result_folder import RESULT, ROWS
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, digest_of, sources
from labutopia_lerobot.experiments.parts.training_part import TrainingPart
from labutopia_lerobot.experiments.study import ExperimentOptionError, Shift, words_of
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting, setting_of


@dataclass(frozen=True)
class EvaluationPart:
    """Episodes of one policy.

    Attributes:
        out: Folder of the experiment.
        policy: Its recipe, or a reference policy.
        label: What tables and folders call it.
        control: What tables call the policy that it is compared with, or None.
        task: Task id.
        shift: What the episodes draw.
        play: `single` or `staged`.
        trainings: Who plays: none for a reference policy, one per step if `staged`.
        at: Step of the training whose weights play, or None for the last.
        episodes: How many.
        obs: `pixels` or `state`.
        options: Other options that are not at their defaults, by name.
        workers: Processes that play.
        device: Device of torch, or None.
        videos: How many successes and how many failures to film.
    """

    out: Path
    policy: str
    label: str
    control: str | None
    task: str
    shift: Shift
    play: str
    trainings: tuple[TrainingPart, ...]
    at: int | None
    episodes: int
    obs: str
    options: tuple[tuple[str, Any], ...]
    workers: int
    device: str | None
    videos: int

    @property
    def name(self) -> str:
        return " ".join(["evaluate", self.label, self.task, *self._variety, self._how])

    @property
    def demonstrations(self) -> int | None:
        """How many demonstrations the policy has learned from; None for a reference policy."""
        return self.trainings[0].recording.demonstrations if self.trainings else None

    @property
    def repeat(self) -> int:
        """How many trainings that differ in their seed alone are before the one that plays."""
        return self.trainings[0].repeat if self.trainings else 0

    @property
    def rate_key(self) -> str:
        return f"evaluate {self.label} {self.obs}"

    @property
    def size(self) -> float:
        """Seconds of the time limits of all episodes [s]."""
        return self.episodes * canonical_task(self._setting).time_limit_s

    @property
    def volume(self) -> float:
        return self.size

    @property
    def place(self) -> Path:
        return self.out / "eval" / self.label / "-".join(self._variety) / self.task / self._how

    @property
    def cores(self) -> int:
        return self.workers

    @property
    def gpus(self) -> int:
        return int(bool(self.trainings) and (self.device or "").startswith("cuda"))

    @property
    def needs(self) -> tuple[ExperimentPart, ...]:
        return self.trainings

    @property
    def peak_bytes(self) -> None:
        return None

    def check(self) -> None:
        """Check that the task has what is shifted, and the steps that are played.

        Raises:
            ExperimentOptionError: If there is nothing to be switched between.
            UserError: If the task cannot be played so.
        """
        self._config.check()
        task = canonical_task(self._setting)
        if self.play == STAGED and len(task.steps) == 1:
            raise ExperimentOptionError(
                f"play=staged needs several steps, and {self.task} has one: there is nothing to be "
                "switched. Leave play= out for it"
            )

    def inputs(self) -> dict[str, Any]:
        """Return the weights, the options, the code and the versions."""
        tasks_dir = dict(self.options).get("tasks_dir")
        return {
            "weights": [training.weights(self.at) for training in self.trainings],
            "options": {
                "task": self.task,
                "policy": self.policy,
                "split": self.shift.split,
                "axes": list(self.shift.axes),
                "play": self.play,
                "episodes": self.episodes,
                "obs": self.obs,
                "device": self.device,
                **dict(self.options),
            },
            **sources(self.task, tasks_dir=tasks_dir),
        }

    def prepare(self) -> None:
        """Do nothing: the evaluator goes on with its own folder."""

    def command(self) -> list[str]:
        """Return the command of the evaluator."""
        learned: dict[str, Any] = {"policy": self.policy}
        if self.trainings:
            first = self.trainings[0]
            path = first.root if self.play == STAGED else first.checkpoint(self.at)
            learned = {"policy.path": path, "policy.device": self.device, "obs": self.obs}
        words = {
            "task": self.task,
            **learned,
            "split": self.shift.split,
            "axes": self.shift.axes or None,
            "play": self.play,
            "episodes": self.episodes,
            "workers": self.workers,
            "videos": self.videos,
            "out": self.place,
            **dict(self.options),
        }
        return [sys.executable, "-m", "labutopia_lerobot.cli.evaluate", *words_of(words)]

    def progress(self) -> float:
        """Return the share of the episodes that have a row."""
        try:
            rows = (self.place / ROWS).read_bytes().count(b"\n")
        except OSError:
            return 0.0
        return rows / self.episodes

    def finished(self) -> bool:
        """Return whether there is a result."""
        return (self.place / RESULT).is_file()

    def digest(self) -> str:
        """Return the hash of the rows."""
        return digest_of({ROWS: self.place / ROWS})

    @property
    def _variety(self) -> list[str]:
        return self.trainings[0].variety if self.trainings else [self.obs]

    @property
    def _how(self) -> str:
        """Shift, way of playing and step of the training, as far as they are unusual."""
        staged = [self.play] if self.play == STAGED else []
        at = [] if self.at is None else [f"step{self.at}"]
        return "-".join([self.shift.name, *staged, *at])

    @property
    def _config(self) -> EvaluationConfig:
        return EvaluationConfig(
            policy=PolicyConfig(self.policy if self.policy in REFERENCES else None),
            task=self.task,
            split=self.shift.split,
            axes=self.shift.axes,
            play=self.play,
            episodes=self.episodes,
            obs=self.obs,
            workers=self.workers,
            videos=self.videos,
            out=str(self.place),
            **dict(self.options),
        )

    @property
    def _setting(self) -> Setting:
        return setting_of(self._config)
