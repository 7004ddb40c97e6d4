"""A kit: all that the trainings of an experiment need on a machine with a GPU and no network.

    labutopia-experiment experiment=results_gpu kit=KIT     # records and verifies here, fills KIT
    bash KIT/train.sh 600                                   # there, again and again; KIT may move
    cp -r KIT/train outputs/experiments/results_gpu/        # and back
    labutopia-experiment experiment=results_gpu device=cpu  # evaluates, here without a GPU

The kit holds the recordings, the recipes, the commands, and the packages of this environment as
wheels; Python and torch are those of the other machine. `train.sh SECONDS AT_ONCE` trains so many
at once, stops in time, and goes on from the last checkpoint of each when it is called again: let
`save_freq` be shorter than a call.
"""

import json
import shutil
import subprocess
import sys
from collections.abc import Sequence
from importlib.metadata import Distribution, distribution
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.experiments import kit_trainer
from labutopia_lerobot.experiments.parts.training_part import TrainingPart

_OWN = "lerobot_env_labutopia"
_EXTRAS = frozenset({"vla"})
"""What vision-language-action models need, if it is installed."""

_THEIRS = ("torch", "torchvision")
"""Packages that fit the GPU of the other machine: it has them, with what they need."""

_SCRIPT = """#!/usr/bin/env bash
# bash train.sh [SECONDS [AT_ONCE]]: train what is not finished, and go on where it was stopped.
# Needs a python3 that has torch; no network. Trainings lie in train/, what they said in logs/.
set -eu
cd "$(dirname "$0")"
if ! [ -d packages ]; then
    rm -rf packages.half
    python3 -m pip install --quiet --no-index --no-deps --target packages.half wheels/*.whl
    mv packages.half packages
fi
export PYTHONPATH="$PWD/packages" HF_HUB_OFFLINE=1 OMP_NUM_THREADS=1 OMP_WAIT_POLICY=PASSIVE
exec python3 train.py "$@"
"""


class TrainingKitError(UserError):
    """A kit that cannot be filled; the message says why."""


def require_no_trainings(folder: Path) -> None:
    """Refuse to fill a kit that has trained, maybe from other recordings or recipes.

    Raises:
        TrainingKitError: If it holds trainings.
    """
    if (folder / "train").exists():
        raise TrainingKitError(
            f"kit={folder} holds trainings, which may be of other recordings or recipes. Copy "
            f"{folder / 'train'} below out= if they are wanted, and name another folder"
        )


def fill_kit(trainings: Sequence[TrainingPart], folder: Path) -> None:
    """Write the kit of trainings whose recordings are there.

    Args:
        trainings: The trainings; those of one experiment.
        folder: Where it is written; what is there of an earlier one is replaced.
    """
    folder.mkdir(parents=True, exist_ok=True)
    listed: list[dict[str, Any]] = []
    for training in trainings:
        dataset = training.dataset.place.relative_to(training.out)
        place = training.place.relative_to(training.out)
        recipe = Path("recipes", training.policy, training.recipe.name)
        shutil.copytree(training.dataset.place, folder / dataset, dirs_exist_ok=True)
        (folder / recipe).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(training.recipe, folder / recipe)
        moved = {
            f"--config_path={training.recipe}": f"--config_path={recipe}",
            f"--dataset.root={training.dataset.place}": f"--dataset.root={dataset}",
            f"--output_dir={training.place}": f"--output_dir={place}",
        }
        words = [moved.get(word, word) for word in training.first_words()]
        listed.append({"place": str(place), "steps": training.steps, "words": words})
    (folder / "kit.json").write_text(json.dumps(listed, indent=1) + "\n")
    (folder / "train.sh").write_text(_SCRIPT)
    shutil.copyfile(kit_trainer.__file__, folder / "train.py")


def fetch_wheels(folder: Path) -> None:
    """Fetch the packages of this environment that ours needs, in their very versions.

    Args:
        folder: Where the wheels are written. Those of before, and what was installed of them beside
            it, are deleted.

    Raises:
        TrainingKitError: If pip cannot fetch them.
    """
    for before in (folder, folder.with_name("packages")):
        shutil.rmtree(before, ignore_errors=True)
    named = [_source(each) or f"{each.name}=={each.version}" for each in packages_needed()]
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "-w", str(folder)]
    if subprocess.run([*command, *named], check=False).returncode:
        raise TrainingKitError(
            f"pip could not fetch the packages into {folder}; what it said stands above. "
            "It needs the network, or a cache that has them: try again"
        )


def packages_needed() -> list[Distribution]:
    """Return our package and all that it needs, as they are installed here, without torch."""
    return _needed(_OWN, _EXTRAS if find_spec("transformers") else frozenset(), {})


def _needed(
    name: str, extras: frozenset[str], seen: dict[tuple[str, frozenset[str]], Distribution]
) -> list[Distribution]:
    key = name.lower().replace("_", "-"), extras
    if key[0] not in _THEIRS and key not in seen:
        seen[key] = distribution(name)
        for need in map(Requirement, seen[key].requires or []):
            if _asked(need, extras):
                _needed(need.name, frozenset(need.extras), seen)
    return list({package.name: package for package in seen.values()}.values())


def _asked(need: Requirement, extras: frozenset[str]) -> bool:
    """Return whether this environment, with extras of the package, needs it."""
    marker = need.marker
    return marker is None or any(marker.evaluate({"extra": each}) for each in ("", *extras))


def _source(package: Distribution) -> str | None:
    """Return the folder that a package was installed from, or None if from an index."""
    origin = json.loads(package.read_text("direct_url.json") or "{}")
    address = str(origin.get("url", ""))
    return address.removeprefix("file://") if address.startswith("file://") else None
