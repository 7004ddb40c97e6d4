"""Provenance of numbers and datasets: the code, the task files, the versions, the machine.

Recordings and results keep it by these functions, and neither goes on with what other code began.
"""

import hashlib
import os
import platform
import subprocess
from collections.abc import Iterable
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from labutopia_lerobot.registry import require_task

_PACKAGE = Path(__file__).parents[1]

_SHIPPED = ("configs", "eval", "policies")
"""Folders that only a wheel has in the package: no code."""

_COMPUTING = (
    "lerobot_env_labutopia",
    "mujoco",
    "mink",
    "daqp",
    "qpsolvers",
    "numba",
    "llvmlite",
    "numpy",
    "scipy",
    "gymnasium",
    "trimesh",
    "fast-simplification",
    "rtb-data",
    "av",
    "opencv-python-headless",
    "lerobot",
    "torch",
    "torchvision",
    "diffusers",
    "transformers",
    "safetensors",
)
"""Another version of any of these may give other numbers; some of them need not be there."""


def code(tasks: Iterable[str], tasks_dir: str | None = None) -> dict[str, Any]:
    """Return which code runs.

    Args:
        tasks: Ids of the tasks that are played.
        tasks_dir: The further folder of tasks, or None.

    Returns:
        `commit` and `uncommitted_changes`, both None where the package lies in no repository that
        tracks it, such as a wheel's; `sources`, the sha256 over every file of the package, which a
        wheel has in common with its checkout; `tasks`, task id -> sha256 of its file. Of a task
        outside the package, what its file imports from beside it is not covered.

    Raises:
        UnknownTaskError: If there is no such task.
    """
    return {
        **_commit(),
        "sources": _sources(),
        "tasks": {task: sha256(require_task(task, tasks_dir)) for task in tasks},
    }


def versions() -> dict[str, str | None]:
    """Return the version of everything that computes; None for what is not installed."""
    return {"python": platform.python_version()} | {name: _version(name) for name in _COMPUTING}


def machine() -> str:
    """Return what this machine is, in words."""
    return f"{platform.system()} {platform.machine()}, {_processor()}, {os.cpu_count()} cores"


def sha256(file: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal digits."""
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()


# Both once per process, and as early as possible: sources may change on the disk while it runs.
@cache
def _sources() -> str:
    digest = hashlib.sha256()
    for file in sorted(_PACKAGE.rglob("*")):
        inside = file.relative_to(_PACKAGE)
        if inside.parts[0] in _SHIPPED or "__pycache__" in inside.parts or not file.is_file():
            continue
        digest.update(f"{inside.as_posix()} {sha256(file)}\n".encode())
    return digest.hexdigest()


@cache
def _commit() -> dict[str, str | bool | None]:
    # A virtual environment may stand in the repository of somebody else, who tracks none of it.
    if _git("ls-files", "--error-unmatch", "__init__.py") is None:
        return {"commit": None, "uncommitted_changes": None}
    # New files count within the package only, as a run's own results may lie in the repository,
    # and what Python compiled is none of them, though not every repository says so.
    edited = _git("status", "--short", "--untracked-files=no", ":/")
    added = _git("status", "--short", ".", ":(exclude,glob)**/__pycache__/**")
    return {"commit": _git("rev-parse", "HEAD"), "uncommitted_changes": bool(edited or added)}


def _git(*command: str) -> str | None:
    """Return what git says in the folder of this package, or None if it refuses."""
    try:
        answer = subprocess.run(
            ["git", *command], cwd=_PACKAGE, capture_output=True, text=True, check=True
        )
    except (OSError, subprocess.CalledProcessError):
        return None
    return answer.stdout.strip()


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _processor() -> str:
    """Return its name, and which of OpenBLAS's kernels it is given: they round differently."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    fields = {key.strip(): value.strip() for key, _, value in (s.partition(":") for s in lines)}
    name = fields.get("model name", platform.processor())
    if kernels := os.environ.get("OPENBLAS_CORETYPE"):
        return f"{name} as {kernels}"
    return f"{name} with AVX-512" if "avx512f" in fields.get("flags", "").split() else name
