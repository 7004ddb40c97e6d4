"""Ctrl-C and SIGTERM end a program in one line, its workers too, whenever they come."""

import os
import signal
import subprocess
import sys
import time
import tomllib
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

import pytest

from labutopia_lerobot.cli import launch

ROOT = Path(__file__).parents[2]
REPORTED = "Interrupted. What was finished before is intact.\n"

IMPORTING = """
import time
from labutopia_lerobot.cli import launch

def import_module(name):
    print("ready", flush=True)
    time.sleep(60)

launch.import_module = import_module
launch.record()
"""

SWALLOWING = """
import time
from labutopia_lerobot.cli import launch

def import_module(name):
    try:
        print("ready", flush=True)
        time.sleep(60)
    except BaseException:  # as libraries do
        raise ImportError("initialization failed") from None

launch.import_module = import_module
launch.record()
"""

REGISTERING = """
import importlib.metadata
import time

def entry_points(group):
    print("ready", flush=True)
    time.sleep(60)

importlib.metadata.entry_points = entry_points
from labutopia_lerobot.cli import launch
"""

WORKING = """
import time

if __name__ == "__mp_main__" and {importing}:  # in a worker
    print("ready", flush=True)
    time.sleep(4)

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.runtime.workers import in_processes

def work(number):
    print("ready", flush=True)
    time.sleep(60)

@clear_errors
def main():
    list(in_processes(work, [(1,), (2,), (3,)], 1))

if __name__ == "__main__":
    main()
"""


def ended(program: Path, send: Callable[[int], None]) -> tuple[int, str]:
    """Run a program until it says that it is ready; return how it ended, and its last words."""
    process = subprocess.Popen(
        [sys.executable, str(program)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        # What a shell runs in the background would else be deaf to Ctrl-C.
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    send(process.pid)
    try:
        _, reported = process.communicate(timeout=30)
        deadline = time.monotonic() + 10
        while running(process.pid):
            assert time.monotonic() < deadline, "a worker is left"
            time.sleep(0.1)
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    return process.returncode, reported


def running(group: int) -> bool:
    """Return whether a process of a group runs; what nobody has asked for its end does not."""
    for file in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            state, _, its_group = file.read_text().rpartition(")")[2].split()[:3]
            if int(its_group) == group and state != "Z":
                return True
    return False


def interrupt(pid: int) -> None:
    """Do what Ctrl-C in a terminal does."""
    os.killpg(pid, signal.SIGINT)


def terminate(pid: int) -> None:
    """Do what a cluster does, or `kill`."""
    os.kill(pid, signal.SIGTERM)


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [IMPORTING, SWALLOWING, WORKING.format(importing=True), WORKING.format(importing=False)],
    ids=["importing", "swallowing", "workers_importing", "working"],
)
@pytest.mark.parametrize(("send", "status"), [(interrupt, 130), (terminate, 143)])
def test_a_program_that_is_asked_to_end_says_one_line(tmp_path, text, send, status):
    program = tmp_path / "program.py"
    program.write_text(text)
    assert ended(program, send) == (status, REPORTED)


def test_ctrl_c_in_the_import_of_the_package_says_one_line(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(REGISTERING)
    assert ended(program, interrupt) == (-signal.SIGINT, REPORTED)


def test_every_installed_program_is_started_by_the_launcher():
    scripts = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["scripts"]
    started = {f"labutopia-{name.replace('evaluate', 'eval')}": name for name in launch.PROGRAMS}
    assert scripts == {
        script: f"labutopia_lerobot.cli.launch:{name}" for script, name in started.items()
    }
    for name in launch.PROGRAMS:
        assert callable(getattr(launch, name))
    with pytest.raises(AttributeError, match="There is no program 'recrd'"):
        _ = launch.recrd
