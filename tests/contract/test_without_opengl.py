"""Where OpenGL is missing, what needs none works, and the rest says what to install."""

import os
import subprocess
import sys
from pathlib import Path

import pytest


def record(obs: str, root: Path, backend: str) -> subprocess.CompletedProcess[str]:
    program = Path(sys.executable).parent / "labutopia-record"
    options = ["task=level1/pick", "episodes=1", "workers=1", f"obs={obs}", f"root={root}"]
    environment = {**os.environ, "MUJOCO_GL": backend}
    command = [str(program), *options]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("backend", ["disable", "osmesa"])
@pytest.mark.slow
def test_state_is_recorded_without_opengl(tmp_path, backend):
    done = record("state", tmp_path / "pick", backend)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_pixels_without_opengl_are_a_clear_error(tmp_path):
    done = record("pixels", tmp_path / "pick", "disable")
    assert done.returncode == 2
    assert "apt-get install libegl1" in done.stderr
    assert "Traceback" not in done.stderr
