import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import tiny_act

Saver = Callable[..., Path]
Program = Callable[..., "subprocess.CompletedProcess[str]"]

RUN = Path(__file__).parents[2] / "eval" / "run.py"


@pytest.fixture
def evaluate_program(tmp_path: Path) -> Program:
    """Run `eval/run.py` with these overrides in an empty folder."""

    def run(*overrides: str) -> "subprocess.CompletedProcess[str]":
        command = [sys.executable, str(RUN), *overrides]
        return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)

    return run


@pytest.fixture
def save_checkpoint(tmp_path: Path) -> Saver:
    """Save a tiny ACT with random weights, as `lerobot-train` saves a trained one."""

    def save(
        state: int = 8, action: int = 8, privileged: int = 13, cameras: tuple[str, ...] = ()
    ) -> Path:
        folder = tmp_path / "trained" / "checkpoints" / "last" / "pretrained_model"
        return tiny_act.save(folder, state, action, privileged, cameras)

    return save
