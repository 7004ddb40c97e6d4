"""`labutopia-doctor`: everything has a line, what is wrong has a cure, the exit status says it."""

import json
import os
import subprocess
import sys

import pytest

from labutopia_lerobot.cli import findings as look

DOCTOR = "from labutopia_lerobot.cli.doctor import main; main()"


def doctor(*arguments: str, **environment: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-c", DOCTOR, *arguments],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_machine_that_draws_is_well_and_each_finding_that_is_not_good_has_a_cure():
    done = doctor("--json")
    assert done.returncode == 0, done.stderr
    report = json.loads(done.stdout)
    assert report["works"]
    by_name = {each["about"]: each for each in report["findings"]}
    assert set(by_name) >= {"packages", "OpenGL", "Vulkan", "threads", "kernels", "video", "disk"}
    assert "mujoco " in by_name["packages"]["found"]
    for each in report["findings"]:
        assert each["found"]
        assert (each["state"] == "good") == (each["cure"] == "")


@pytest.mark.slow
def test_without_opengl_it_says_how_to_get_it_and_exits_with_1():
    done = doctor(MUJOCO_GL="disable", DISPLAY="", WAYLAND_DISPLAY="")
    assert done.returncode == 1
    assert "MISSING  OpenGL" in done.stdout
    assert "apt-get install libegl1 libgl1 libgl1-mesa-dri" in done.stdout
    assert done.stdout.splitlines()[-1] == "Missing: OpenGL"
    assert "Traceback" not in done.stderr


IDLE, PASSIVE = 0.1, {"OMP_WAIT_POLICY": "passive"}


@pytest.mark.parametrize(
    ("environment", "granted", "load", "cure"),
    [
        ({}, 2.0, IDLE, ""),
        ({"LP_NUM_THREADS": "1"}, 8.0, IDLE, ""),
        ({}, 1.5, IDLE, "set OMP_NUM_THREADS=1 and workers=1"),
        ({"LP_NUM_THREADS": "8"}, 8.0, IDLE, "unset it"),
        ({}, 8.0, 20.0, "export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=PASSIVE"),
        (PASSIVE, 8.0, 20.0, "nothing measured now is worth much"),
    ],
)
def test_threads_that_get_in_each_others_way_are_found(environment, granted, load, cure):
    seen = 2 if granted == 2.0 else 8
    found = look.threads(environment, seen, granted, load)
    assert found.cure.endswith(cure)
    assert found.state == (look.SLOW if cure else look.GOOD)


def test_a_container_is_granted_what_linux_says(tmp_path):
    file = tmp_path / "cpu.max"
    file.write_text("150000 100000\n")
    assert look.granted_cores(file) == 1.5
    file.write_text("max 100000\n")
    assert look.granted_cores(file) == look.cores()
    assert look.granted_cores(tmp_path / "none") == look.cores()


@pytest.mark.parametrize(
    ("found", "state"),
    [
        (look.shared_memory(64), look.SLOW),
        (look.shared_memory(4000), look.GOOD),
        (look.disk(1), look.SLOW),
        (look.disk(80), look.GOOD),
    ],
)
def test_little_room_is_found(found, state):
    assert found.state == state


def test_a_cache_that_cannot_be_written_is_found(monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert "set XDG_CACHE_HOME" in look.kernels().cure
