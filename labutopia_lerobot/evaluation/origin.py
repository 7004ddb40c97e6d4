"""What the rows of an evaluation come from: options, code, versions, weights."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from labutopia_lerobot.evaluation.checkpoint import Checkpoint
from labutopia_lerobot.evaluation.checkpoint_folder import WEIGHTS, checkpoint_files
from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.harmless import CONFIG, CheckpointError
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.rollout import Pairing
from labutopia_lerobot.evaluation.row import Row
from labutopia_lerobot.evaluation.staged import Staged
from labutopia_lerobot.runtime import provenance

_FREE = ("out", "workers", "videos")
"""Options on which no row depends."""


def origin(config: EvaluationConfig, pairings: Sequence[Pairing]) -> dict[str, Any]:
    """Return everything that decides what the rows are, known before the first is played.

    Args:
        config: Options of the run.
        pairings: What it plays.

    Raises:
        CheckpointError: If a file of a checkpoint cannot be read.
    """
    tasks_dir = pairings[0].setting.tasks_dir
    tasks = dict.fromkeys(pairing.setting.task for pairing in pairings)
    # Of each once, whatever its splits: weights may be large.
    checkpoints = {name: each for pairing in pairings for name, each in _checkpoints(pairing)}
    return {
        "config": {name: value for name, value in asdict(config).items() if name not in _FREE},
        "code": provenance.code(tasks, tasks_dir),
        "versions": provenance.versions(),
        "checkpoints": {name: _weights(checkpoint) for name, checkpoint in checkpoints.items()},
    }


def full_provenance(
    began: dict[str, Any], config: EvaluationConfig, rows: Sequence[Row]
) -> dict[str, Any]:
    """Return the provenance of a finished result.

    Args:
        began: Its `origin`.
        config: Options of the run that finished it.
        rows: Its rows, which tell what they were played and drawn with.
    """
    return {
        **began["code"],
        "versions": began["versions"],
        "checkpoints": began["checkpoints"],
        "device": _several(row.device for row in rows),
        "renderer": _several(row.renderer for row in rows),
        "machine": provenance.machine(),
        "config": asdict(config),
    }


def _checkpoints(pairing: Pairing) -> Iterator[tuple[str, Checkpoint]]:
    """Yield what plays, by its task or, where it plays a step only, by task and step."""
    made = pairing.make_policy
    for maker in [maker for _, maker in made.makers] if isinstance(made, Staged) else [made]:
        if isinstance(maker, Checkpoint):
            step = maker.setting.step
            yield pairing.setting.task + (f"/{step}" if step else ""), maker


def _weights(checkpoint: Checkpoint) -> dict[str, Any]:
    """Return which weights a checkpoint has: its real folder, its training step, its hashes."""
    folder, base = checkpoint.folder, checkpoint.base
    told = {
        "folder": str(folder),
        "type": checkpoint.type,
        "step": _training_step(folder),
        "sha256": _hashes(folder, checkpoint_files(folder)),
    }
    if base is None:
        return told
    return {**told, "base": {"folder": str(base), "sha256": _hashes(base, (CONFIG, WEIGHTS))}}


def _hashes(folder: Path, names: Iterable[str]) -> dict[str, str]:
    try:
        return {name: provenance.sha256(folder / name) for name in names}
    except OSError as error:
        raise CheckpointError(f"{folder} cannot be read: {error}") from None


def _training_step(folder: Path) -> int | None:
    """Return after how many steps of training it was saved, or None if nothing tells."""
    told = folder.parent / "training_state" / "training_step.json"
    if told.is_file():
        step = read_json_object(told, CheckpointError).get("step")
        return step if isinstance(step, int) else None
    return int(folder.parent.name) if folder.parent.name.isdigit() else None


def _several(values: Iterable[str | None]) -> str | None:
    return ", ".join(sorted({value for value in values if value is not None})) or None
