"""A kit trains in another folder what comes back as if it had been trained here."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import torch
from rich.console import Console

from labutopia_lerobot.cli.experiment import parse
from labutopia_lerobot.experiments import runner
from labutopia_lerobot.experiments.experiment import Experiment
from labutopia_lerobot.experiments.part_record import PartRecords
from labutopia_lerobot.experiments.parts.experiment_part import log_of
from labutopia_lerobot.experiments.parts.training_part import TrainingPart
from labutopia_lerobot.experiments.planning import parts_of
from labutopia_lerobot.experiments.requirements import NoGpuError, outdated, stands
from labutopia_lerobot.experiments.runner import run_experiment
from labutopia_lerobot.experiments.training_kit import TrainingKitError, packages_needed

STEPS = 2
SOURCES = Path(__file__).parents[2]


def experiment(out: Path, *words: str) -> Experiment:
    small = ["level1/press", "obs=state", "policy=mlp", "demonstrations=2", f"steps={STEPS}"]
    kept = ["training={save_freq: 1, eval_steps: 0}", "episodes=1", "workers=1", "warm_up=false"]
    return parse([*small, *kept, f"out={out}", *words])


def trained(folder: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "train.py", *words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(SOURCES), "HF_HUB_OFFLINE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_what_a_kit_has_trained_elsewhere_is_taken_for_what_was_begun_here(
    tmp_path, monkeypatch
) -> None:
    monkeypatch.setattr(runner, "fetch_wheels", lambda folder: None)  # needs the network
    out, kit, moved = tmp_path / "out", tmp_path / "kit", tmp_path / "elsewhere" / "kit"
    console = Console(quiet=True)
    for_a_gpu = experiment(out, "device=cuda", f"kit={kit}")
    assert run_experiment(for_a_gpu, console, lambda parts: None) == {}
    here = parts_of(experiment(out, "device=cpu"))
    (training,) = (part for part in here if isinstance(part, TrainingPart))
    assert not training.finished()

    shutil.move(kit, moved)
    said = (moved / "kit.json").read_text()
    assert str(tmp_path) not in said
    assert "--policy.device=cuda" in said
    (moved / "kit.json").write_text(said.replace("cuda", "cpu"))  # there may be no GPU here
    stopped = trained(moved, "0")
    assert stopped.returncode == 1
    assert "not begun" in stopped.stdout
    ended = trained(moved)
    assert (ended.returncode, "finished" in ended.stdout) == (0, True), ended.stdout

    _take_the_last_step_away(moved, training.place.relative_to(out))
    assert trained(moved).returncode == 0

    shutil.copytree(moved / "train", out / "train", symlinks=True)
    records = PartRecords(out)
    assert training.finished()
    assert not outdated(training, records)
    runner.do_parts([training], records, False, console, lambda: None)
    assert stands(training, records)
    assert not log_of(training).exists()  # nothing was trained here


def _take_the_last_step_away(kit: Path, place: Path) -> None:
    """Leave what a kill between two checkpoints leaves."""
    checkpoints = kit / place / "checkpoints"
    last = checkpoints / "last"
    shutil.rmtree(last.resolve())
    kept = checkpoints / f"{STEPS - 1:06d}" / "pretrained_model" / "model.safetensors"
    assert kept.exists()
    last.unlink()
    last.symlink_to(kept.parents[1].name)


def test_a_kit_that_has_trained_is_not_filled_again(tmp_path) -> None:
    kit = tmp_path / "kit"
    (kit / "train").mkdir(parents=True)
    with pytest.raises(TrainingKitError, match="holds trainings"):
        run_experiment(
            experiment(tmp_path / "out", f"kit={kit}"), Console(quiet=True), lambda parts: None
        )
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_kit_has_every_package_that_ours_needs_but_torch() -> None:
    named = {package.name.lower() for package in packages_needed()}
    assert {"lerobot", "mujoco", "numpy", "av", "lerobot_env_labutopia"} <= named
    assert not {"torch", "torchvision", "triton"} & named


def test_trainings_on_a_gpu_are_refused_without_one_before_anything_is_recorded(
    tmp_path, monkeypatch
) -> None:
    monkeypatch.setattr(torch.cuda, "is_available", lambda: False)
    out = tmp_path / "out"
    with pytest.raises(NoGpuError, match=r"2 parts need a GPU.*kit=KIT"):
        run_experiment(experiment(out, "device=cuda"), Console(quiet=True), lambda parts: None)
    assert not (out / "datasets").exists()
