"""The part that trains a policy on a recording, by `lerobot-train` and a recipe of `policies/`."""

import json
import math
import re
import shutil
import sys
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import Any

from labutopia_lerobot.datasets.disk_space import expected_frames
from labutopia_lerobot.evaluation.find_checkpoint import adapted, checkpoint_files
from labutopia_lerobot.evaluation.origin import training_step, weight_hashes
from labutopia_lerobot.experiments.parts.cutting_part import CuttingPart
from labutopia_lerobot.experiments.parts.experiment_part import ExperimentPart, digest_of, log_of
from labutopia_lerobot.experiments.parts.recording_part import RecordingPart, VerificationPart
from labutopia_lerobot.experiments.recipe import (
    RecipeError,
    recipe_file,
    require_options,
    training_command,
)
from labutopia_lerobot.experiments.study import Budget, ExperimentOptionError
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.runtime import provenance

_LEARNING = ("python", "lerobot", "torch", "torchvision", "diffusers", "transformers")
"""Packages whose version decides what a training makes."""

_OWN_NETWORK = Path(__file__).parents[2] / "behaviour_cloning"

_BAR = re.compile(r"Training: .*?\| *(\d+)/(\d+) \[")
"""LeRobot's progress bar: steps since it was started, and how many it began with."""

_TAIL = 4_000
"""Bytes at the end of a log in which the bar stands."""

_SEED = 1000
"""LeRobot's seed of a training, where a recipe says none."""

_LAST = Path("checkpoints/last/pretrained_model")


@dataclass(frozen=True)
class TrainingPart:
    """A policy trained on a recording, or on one step of it.

    Attributes:
        out: Folder of the experiment.
        recording: What it learns from.
        step: The step that is cut out of it and learned alone, or None.
        policy: A recipe of `policies/`.
        label: What tables and folders call it.
        budget: What it may use.
        repeat: How many trainings that differ in their seed alone are before it.
        evaluate_at: Steps at which its weights are kept, beside those of the recipe.
        device: Device of torch, or None for the recipe's.
    """

    out: Path
    recording: RecordingPart
    step: str | None
    policy: str
    label: str
    budget: Budget
    repeat: int
    evaluate_at: tuple[int, ...]
    device: str | None

    @property
    def name(self) -> str:
        return " ".join(["train", self.label, self.dataset.subject, *self.variety])

    @property
    def variety(self) -> list[str]:
        """What it has learned from, how many, and its seed if that is not the recipe's: words."""
        reseeded = [f"seed{self._seed}"] if self.repeat else []
        return [self.recording.variety, str(self.recording.demonstrations), *reseeded]

    @property
    def rate_key(self) -> str:
        size = self.budget.batch_size or ""
        return f"train {self.label} {self.recording.obs} {size}{self.device or ''}".rstrip()

    @property
    def size(self) -> float:
        """Steps."""
        return self.steps

    @property
    def volume(self) -> float:
        """Checkpoints."""
        return math.ceil(self.steps / (math.gcd(*self.evaluate_at) or self._recipe["save_freq"]))

    @property
    def place(self) -> Path:
        return self.root / self.recording.task / (self.step or self.recording.step or "")

    @property
    def root(self) -> Path:
        """Where `policy.path=` finds it by its task, or by its task and step."""
        recorded = self.recording
        kind = "whole" if self.step is None and recorded.step is None else "steps"
        return self.out / "train" / self.label / "-".join(self.variety) / kind

    @property
    def dataset(self) -> RecordingPart | CuttingPart:
        """What it reads."""
        if self.step is None:
            return self.recording
        return CuttingPart(self.out, self.recording, self.step)

    @property
    def cores(self) -> int:
        return 1

    @property
    def gpus(self) -> int:
        return int((self.device or "").startswith("cuda"))

    @property
    def needs(self) -> tuple[ExperimentPart, ...]:
        recorded = (self.recording, VerificationPart(self.out, self.recording))
        return recorded if self.step is None else (*recorded, self.dataset)

    @property
    def recipe(self) -> Path:
        """The configuration of `lerobot-train`.

        Raises:
            RecipeError: If there is none for what is observed.
        """
        return recipe_file(self.policy, self.recording.obs)

    @property
    def steps(self) -> int:
        """Steps; of epochs, until the demonstrations are there, those to be expected."""
        if self.budget.epochs is None:
            steps: int = self.budget.steps or self._recipe["steps"]
            return steps
        if self.dataset.finished():
            (said,) = (word for word in self._made() if word.startswith("--steps="))
            return int(said.partition("=")[2])
        batch = self.budget.batch_size or self._recipe["batch_size"]
        config = self.recording.config
        frames = expected_frames(config.setting(self.recording.task), config.episodes)
        return math.ceil(self.budget.epochs * frames / batch)

    @property
    def peak_bytes(self) -> None:
        return None

    def check(self) -> None:
        """Check that there is a recipe, that it has enough demonstrations, and what is said beside.

        Raises:
            RecipeError: If there is no recipe for what is observed, or LeRobot refuses an option.
            ExperimentOptionError: If numbers do not fit the recipe.
        """
        split = self._recipe.get("dataset", {}).get("eval_split", 0.0)
        count = self.recording.demonstrations
        if count <= math.ceil(count * split):
            raise ExperimentOptionError(
                f"demonstrations={count} is too few for {self.recipe.name} of {self.policy}, which "
                f"holds {split:.0%} of them out, at least one: take 2 or more"
            )
        beyond = [step for step in self.evaluate_at if step > self.steps]
        if beyond and self.budget.epochs is None:
            raise ExperimentOptionError(
                f"evaluate_at={beyond[0]} comes after the training of {self.label}, which has "
                f"{self.steps} steps"
            )
        if self.budget.arguments:
            require_options(self.recipe, self.budget.arguments)

    def inputs(self) -> dict[str, Any]:
        """Return the content of the dataset, the recipe, what is asked beside it, the versions.

        The device is none of them: a kit's trainings come back from a GPU to a machine without.
        """
        versions = provenance.versions()
        return {
            "dataset": self.dataset.digest(),
            "recipe": provenance.sha256(self.recipe),
            "budget": [self.steps, self.budget.batch_size, *self._said()],
            "versions": {name: versions.get(name) for name in _LEARNING},
            "network": self._own_network(),
        }

    def prepare(self) -> None:
        """Delete what a training has left that was killed before its first checkpoint."""
        if self.place.exists() and not (self.place / _LAST).exists():
            shutil.rmtree(self.place)

    def command(self) -> list[str]:
        """Return what `labutopia-recipe` prints, or what goes on with the last checkpoint."""
        program = [sys.executable, "-m", "lerobot.scripts.lerobot_train"]
        if (self.place / _LAST).exists():
            config = self.place / _LAST / "train_config.json"
            return [*program, f"--config_path={config}", "--resume=true"]
        return [*program, *self.first_words()]

    def first_words(self) -> list[str]:
        """Return what is said to `lerobot-train` to begin."""
        device = [] if self.device is None else [f"--policy.device={self.device}"]
        return [*self._made()[1:], *device, *self._said()]

    def progress(self) -> float:
        """Return what LeRobot's progress bar shows."""
        try:
            with log_of(self).open("rb") as log:
                log.seek(max(0, log.seek(0, 2) - _TAIL))
                bars = _BAR.findall(log.read().decode(errors="replace"))
        except OSError:
            return 0.0
        if not bars:
            return 0.0
        done, began_with = map(int, bars[-1])
        return max(0.0, 1.0 - (began_with - done) / self.steps)

    def finished(self) -> bool:
        """Return whether the last checkpoint has all steps."""
        last = self.place / _LAST
        return last.exists() and (training_step(last.resolve()) or 0) >= self.steps

    def made_otherwise(self) -> str:
        """Return what the last checkpoint was made with that is not asked for, or nothing.

        Of a checkpoint from elsewhere nothing else is known: it may be of another experiment.
        """
        made = read_json_object(self.place / _LAST / "train_config.json", RecipeError)
        recipe, words = self._recipe, [word.removeprefix("--") for word in self.budget.arguments]
        asked = {
            "policy.type": recipe["policy"]["type"],
            "batch_size": self.budget.batch_size or recipe["batch_size"],
            "seed": self._seed,
            **{name: json.loads(value) for name, _, value in (w.partition("=") for w in words)},
        }
        for name, value in asked.items():
            there = reduce(_within, name.split("."), made)
            if value is not None and there not in ({}, value):  # LeRobot fills in for a null
                return f"{self.place} was trained with {name}={there}, not {value}: move it away"
        return ""

    def digest(self) -> str:
        """Return the hash of the weights and of all that decides what they do."""
        return self.weights(None)

    def checkpoint(self, step: int | None) -> Path:
        """Return the folder of the weights after a step, or of the last."""
        if step is None or step == self.steps:
            return (self.place / _LAST).resolve()
        return self.place / "checkpoints" / f"{step:0{max(6, len(str(self.steps)))}d}" / _LAST.name

    def weights(self, step: int | None) -> str:
        """Return the hash of a checkpoint.

        Raises:
            CheckpointError: If it is not there, whole.
        """
        folder = self.checkpoint(step)
        checkpoint_files(folder)
        hashes, of_base = weight_hashes(folder, adapted(folder))
        return " ".join([*hashes.values(), *of_base.values()])

    @property
    def _recipe(self) -> dict[str, Any]:
        return read_json_object(self.recipe, RecipeError)

    @property
    def _seed(self) -> int:
        seed: int = self._recipe.get("seed", _SEED) + self.repeat
        return seed

    def _own_network(self) -> str | None:
        """Return the hash of a network that is not LeRobot's but ours, or None."""
        files = {file.name: file for file in _OWN_NETWORK.glob("*.py")}
        ours = f"modeling_{self._recipe['policy'].get('type')}.py" in files
        return digest_of(files) if ours else None

    def _made(self) -> list[str]:
        budget = self.budget
        return training_command(
            self.policy, self.dataset.place, budget.epochs, budget.batch_size, self.place
        )

    def _said(self) -> list[str]:
        """Return what the study says beside what `labutopia-recipe` prints."""
        words = {
            "steps": self.budget.steps,
            "save_freq": math.gcd(*self.evaluate_at) or None,
            "seed": self._seed if self.repeat else None,
        }
        said = [f"--{name}={value}" for name, value in words.items() if value is not None]
        return [*said, *self.budget.arguments]


def _within(made: Any, name: str) -> Any:
    """Return an entry of a configuration; an empty one where there is none."""
    return made.get(name, {}) if isinstance(made, dict) else {}
