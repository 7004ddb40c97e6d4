"""Recordings for tests: small, watched, compared."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from labutopia_lerobot.cli.record import parse
from labutopia_lerobot.datasets.candidate import Candidate
from labutopia_lerobot.datasets.recorder import record

PICK = ["task=level1/pick", "obs=state", "episodes=3", "seed=20"]
FILM = ["task=level1/pick", "episodes=2", "width=64", "height=48", "cameras=[wrist,front]"]

MOODY_TASK = """
import dataclasses
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.tasks.level1.pick import pick

class Sulk:
    def phases(self, world):
        if world.frame("flask_rim").position_w[1] > {limit}:
            never = lambda world, target, elapsed: False
            yield Phase("sulk", lambda w: w.gripper, 0.08, never, timeout_s=0.1)

def moody():
    (step,) = pick().steps
    return dataclasses.replace(
        pick(), steps=(dataclasses.replace(step, skills=(Sulk(), *step.skills)),)
    )
"""
"""An expert that sulks where a flask stands too far to the left."""


class StoppedError(Exception):
    """Stops a recording."""


class Watch:
    """Watches a recording; stops it after so many candidates or episodes."""

    def __init__(self, played: int = -1, assembled: int = -1) -> None:
        self.left = {"played": played, "assembled": assembled}
        self.indices: list[int] = []
        self.new: list[int] = []

    def resumed(self, candidates: Sequence[Candidate]) -> None:
        self.indices += [candidate.index for candidate in candidates]

    def played(self, candidate: Candidate) -> None:
        self.indices.append(candidate.index)
        self.new.append(candidate.index)
        self._count("played")

    def assembled(self, candidate: Candidate) -> None:
        self._count("assembled")

    def _count(self, event: str) -> None:
        self.left[event] -= 1
        if self.left[event] == 0:
            raise StoppedError


def recording(root: Path, *overrides: str, workers: int = 1, watch: Watch | None = None) -> Path:
    """Record one dataset."""
    (config,) = parse([*overrides, f"root={root}", f"workers={workers}"]).datasets()
    record(config, watch or Watch())
    return root


def assert_same_dataset(first: Path, second: Path) -> None:
    """The same command makes the same bytes."""
    files = [
        {path.relative_to(root): path.read_bytes() for path in root.rglob("*") if path.is_file()}
        for root in (first, second)
    ]
    assert files[0].keys() == files[1].keys()
    assert [name for name in files[0] if files[0][name] != files[1][name]] == []


def edit_table(root: Path, folder: str, key: str, edit: Callable[[list[Any]], None]) -> None:
    """Change a column of the table of frames (`data`) or episodes (`meta/episodes`)."""
    path = next((root / folder).glob("*/*.parquet"))
    table = pq.read_table(path)
    values, number = table[key].to_pylist(), table.column_names.index(key)
    edit(values)
    field = table.schema.field(number)
    pq.write_table(table.set_column(number, field, pa.array(values, type=field.type)), path)
