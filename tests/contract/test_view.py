"""`labutopia-view` without a display: files, and why an expert has failed."""

import os
import re
import subprocess
import sys
from pathlib import Path

import av
import pytest
from PIL import Image

SMALL = ("--headless", "--width", "32", "--height", "32")
VIEW = "from labutopia_lerobot.cli.view import main; main()"


def view(*arguments: str, **environment: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-c", VIEW, *arguments],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture
def hasty(tmp_path: Path) -> Path:
    """A folder with a task whose time limit is too short for its expert."""
    file = tmp_path / "tasks" / "level1" / "hasty.py"
    file.parent.mkdir(parents=True)
    file.write_text(
        "from dataclasses import replace\n"
        "from labutopia_lerobot.tasks.level1.pick import pick\n\n\n"
        "def hasty():\n"
        "    return replace(pick(), instruction='Hurry.', time_limit_s=1.0)\n"
    )
    return tmp_path / "tasks"


def test_a_success_is_reported_in_a_line_and_leaves_a_picture_and_a_film(tmp_path):
    done = view("level1/pick", *SMALL, "--out", str(tmp_path / "here"))
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("level1/pick, seed 0: success. Wrote ")
    assert len(done.stdout.splitlines()) == 1
    assert "Playing level1/pick, seed 0 ..." in done.stderr
    assert Image.open(tmp_path / "here" / "level1-pick.png").size == (96, 64)
    with av.open(str(tmp_path / "here" / "level1-pick.mp4")) as film:
        assert sum(1 for _ in film.decode(video=0)) > 100


@pytest.mark.slow
def test_a_failure_is_reported_with_step_phase_substeps_and_what_did_not_hold(tmp_path, hasty):
    out = ("--out", str(tmp_path), "--tasks-dir", str(hasty))
    done = view("level1/hasty", *SMALL, *out)
    assert done.returncode == 0, done.stderr
    assert "level1/hasty, seed 0: timeout" in done.stdout
    assert "step 'pick': the time limit of 1 s ran out" in done.stdout
    assert "Expert: was in phase pick/hover" in done.stdout
    assert re.search(r"Hand: \d+ mm and \d+ deg from the target of pick/hover", done.stdout)
    assert "Substeps not reached: gripped, lifted" in done.stdout
    assert "Did not hold at the end, for 'gripped': flask gripped" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "environment", "cure"),
    [
        (("--seed", "-4"), {}, "--seed -4 is too small: seeds begin at 0"),
        (("--out", "/proc/x"), {}, "--out /proc/x cannot be made a folder"),
        ((), {"MUJOCO_GL": "bla"}, "MUJOCO_GL=bla is unknown. Choose from: egl, osmesa, glfw"),
    ],
)
def test_a_mistake_is_reported_in_one_line(tmp_path, arguments, environment, cure):
    done = view("level1/pick", *SMALL, "--out", str(tmp_path), *arguments, **environment)
    assert done.returncode == 2
    assert cure in done.stderr
    assert "Traceback" not in done.stderr
