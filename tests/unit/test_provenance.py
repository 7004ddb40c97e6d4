"""What a number comes from, the same in a repository and out of a wheel."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.claim import differences, locked
from labutopia_lerobot.runtime.provenance import machine

PACKAGE = Path(__file__).parents[2] / "labutopia_lerobot"

TELL = (
    "import json, labutopia_lerobot\n"
    "from labutopia_lerobot.runtime.provenance import code, versions\n"
    "print(json.dumps({**code(['level1/pick']), **versions()}))"
)


def reported(folder: Path, *before: str) -> dict:
    """Return what the package in a folder says of itself."""
    for command in before:
        subprocess.run(command, shell=True, cwd=folder, check=True, capture_output=True)
    done = subprocess.run(
        [sys.executable, "-c", TELL], cwd=folder, capture_output=True, text=True, check=True
    )
    return json.loads(done.stdout)


@pytest.fixture
def copy(tmp_path) -> Path:
    """The package alone, as a wheel installs it."""
    shutil.copytree(
        PACKAGE, tmp_path / "labutopia_lerobot", ignore=shutil.ignore_patterns("__pycache__")
    )
    return tmp_path


COMMIT = "git -c user.name=n -c user.email=n@n commit -qam x"


def test_without_a_repository_the_sources_say_which_code_it_is(copy):
    whole = reported(copy)
    assert whole["commit"] is None
    assert whole["uncommitted_changes"] is None
    assert reported(copy) == whole
    changed = reported(copy, "echo '# faster' >> labutopia_lerobot/skills/pick.py")
    assert changed["sources"] != whole["sources"]
    assert changed["tasks"] == whole["tasks"]
    task = reported(copy, "echo '# harder' >> labutopia_lerobot/tasks/level1/pick.py")
    assert task["tasks"] != whole["tasks"]


def test_a_wheel_has_the_sources_of_the_checkout_it_is_built_of(copy):
    checkout = reported(copy)
    for folder in ("configs", "policies", "eval"):  # a wheel carries these inside the package
        shutil.copytree(PACKAGE.parent / folder, copy / "labutopia_lerobot" / folder)
    assert reported(copy)["sources"] == checkout["sources"]


def test_in_a_repository_the_commit_and_its_changes_are_reported(copy):
    clean = reported(copy, "git init -q", "git add .", COMMIT)
    assert len(clean["commit"]) == 40
    assert clean["uncommitted_changes"] is False
    assert reported(copy, "mkdir out", "touch out/rows.jsonl") == clean
    edited = reported(copy, "echo '# x' >> labutopia_lerobot/env.py")
    assert edited["uncommitted_changes"] is True
    assert edited["sources"] != clean["sources"]
    assert reported(copy, COMMIT)["commit"] != clean["commit"]


def test_the_repository_of_somebody_else_is_not_ours(copy):
    assert reported(copy, "git init -q")["commit"] is None


def test_everything_that_computes_has_its_version(copy):
    assert {"python", "scipy", "mujoco", "torch", "numba"} <= {
        k for k, v in reported(copy).items() if v
    }


def test_a_machine_that_rounds_otherwise_is_another_one(monkeypatch):
    monkeypatch.delenv("OPENBLAS_CORETYPE", raising=False)
    usual = machine()
    assert ("avx512f" in Path("/proc/cpuinfo").read_text()) == ("with AVX-512" in usual)
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Sandybridge")
    assert " as Sandybridge, " in machine() != usual


def test_differences_are_named_down_to_the_option():
    there = {
        "config": {"policy": {"name": "act"}, "gone": 1},
        "code": {"uncommitted_changes": True},
    }
    here = {
        "config": {"policy": {"name": "expert"}, "cameras": ("a",)},
        "code": {"uncommitted_changes": False},
    }
    assert differences(there, here) == [
        "  config.cameras: None there, ['a'] here",
        "  config.gone: 1 there, None here",
        "  config.policy.name: 'act' there, 'expert' here",
    ]
    assert differences({"config": {"cameras": ["a"]}}, {"config": {"cameras": ("a",)}}) == []


def test_a_folder_is_locked_once_and_freed(tmp_path):
    folder = tmp_path / "a"
    refused = pytest.raises(UserError, match=r"out=.* in use by another process")
    with locked(folder, "out", UserError), refused, locked(folder, "out", UserError):
        pass
    with locked(folder, "out", UserError):
        pass
