"""The folder of a result: rows as they come, then everything with its provenance."""

import json
import os
import platform
import subprocess
from collections.abc import Sequence
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.rollout import Row
from labutopia_lerobot.evaluation.statistics import Summary

ROWS = "rows.jsonl"
"""One JSON row per finished episode, in the order in which they finished."""

RESULT = "result.json"

_PACKAGES = (
    "lerobot_env_labutopia",
    "lerobot",
    "torch",
    "mujoco",
    "mink",
    "daqp",
    "numba",
    "numpy",
)
"""Another version of any of these may give another result."""


class OccupiedFolderError(UserError):
    """The folder already holds a result."""


class ResultFolder:
    """Writes a result.

    Args:
        path: The folder; made if it does not exist.

    Raises:
        OccupiedFolderError: If it already holds a result, finished or not.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        if (path / ROWS).exists():
            raise OccupiedFolderError(f"out={path} already holds a result. Choose another out=")
        path.mkdir(parents=True, exist_ok=True)
        (path / ROWS).touch()

    def add(self, row: Row) -> None:
        """Keep a row, whatever happens next."""
        with (self.path / ROWS).open("a") as rows:
            rows.write(json.dumps(asdict(row)) + "\n")

    def finish(
        self, rows: Sequence[Row], summaries: Sequence[Summary], provenance: dict[str, Any]
    ) -> Path:
        """Write the result file, whole or not at all, and return it.

        Args:
            rows: Every row, ordered by task, split and seed.
            summaries: What follows from them.
            provenance: What they come from (see `provenance`).
        """
        result = {
            "rows": [asdict(row) for row in rows],
            "summary": [asdict(summary) for summary in summaries],
            "provenance": provenance,
        }
        file = self.path / RESULT
        draft = file.with_suffix(".tmp")
        draft.write_text(json.dumps(result, indent=1) + "\n")
        draft.rename(file)
        return file


def provenance(config: dict[str, Any], renderer: str | None) -> dict[str, Any]:
    """Return where a result comes from.

    Args:
        config: Options of the run.
        renderer: What drew the pictures that the policy saw, or None.
    """
    changes = _git("status", "--short")
    return {
        "commit": _git("rev-parse", "HEAD"),
        "uncommitted_changes": None if changes is None else bool(changes),
        "versions": {"python": platform.python_version()}
        | {package: version(package) for package in _PACKAGES},
        "renderer": renderer,
        "machine": f"{platform.system()} {platform.machine()}, {_processor()}, "
        f"{os.cpu_count()} cores",
        "config": config,
    }


def _git(*command: str) -> str | None:
    """Return what git says about the repository of this package, or None if it is in none."""
    this = Path(__file__)
    # A virtual environment may stand in the repository of somebody else, who tracks none of it.
    tracked = ("ls-files", "--error-unmatch", this.parents[1].joinpath("__init__.py"))
    try:
        for arguments in (tracked, command):
            answer = subprocess.run(
                ["git", *arguments], cwd=this.parent, capture_output=True, text=True, check=True
            )
    except (OSError, subprocess.CalledProcessError):
        return None
    return answer.stdout.strip()


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, platform.processor())
