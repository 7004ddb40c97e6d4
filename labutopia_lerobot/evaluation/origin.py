"""Origin of the rows of an evaluation: options, code, versions, weights."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from labutopia_lerobot.evaluation.checkpoint import Checkpoint
from labutopia_lerobot.evaluation.checkpoint_security import CONFIG, CheckpointError
from labutopia_lerobot.evaluation.compare import PlayedEpisodes
from labutopia_lerobot.evaluation.config import EvaluationConfig
from labutopia_lerobot.evaluation.find_checkpoint import WEIGHTS, checkpoint_files
from labutopia_lerobot.evaluation.jobs import EvaluationJob
from labutopia_lerobot.evaluation.policies import StagedPolicyMaker
from labutopia_lerobot.evaluation.rows import Row
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.runtime import provenance
from labutopia_lerobot.scenario.own_files import without_paths

_FREE = ("out", "workers", "videos")
"""Options on which no row depends."""


def origin(
    config: EvaluationConfig, jobs: Sequence[EvaluationJob], rival: PlayedEpisodes | None = None
) -> dict[str, Any]:
    """Return everything that decides what the rows are, known before the first is played.

    Args:
        config: Options of the run.
        jobs: What it plays.
        rival: What decides, with `versus`, how many episodes are played.

    Raises:
        CheckpointError: If a file of a checkpoint cannot be read.
    """
    tasks_dir = jobs[0].setting.tasks_dir
    tasks = dict.fromkeys(job.setting.task for job in jobs)
    # Of each once, whatever its splits: weights may be large.
    checkpoints = {name: each for job in jobs for name, each in _checkpoints(job)}
    return {
        "config": {name: value for name, value in _options(config).items() if name not in _FREE},
        "code": provenance.code(tasks, tasks_dir),
        "versions": provenance.versions(),
        "checkpoints": {name: _weights(checkpoint) for name, checkpoint in checkpoints.items()},
        "rival_sha256": None if rival is None else rival.sha256,
    }


def full_provenance(
    began: dict[str, Any], config: EvaluationConfig, rows: Sequence[Row]
) -> dict[str, Any]:
    """Return the provenance of a finished result.

    Args:
        began: Its `origin`.
        config: Options of the run that finished it.
        rows: Its rows, which say what they were played and drawn with.
    """
    return {
        **began["code"],
        "versions": began["versions"],
        "checkpoints": began["checkpoints"],
        "rival_sha256": began["rival_sha256"],
        "device": _several(row.device for row in rows),
        "renderer": _several(row.renderer for row in rows),
        "machine": provenance.machine(),
        "config": _options(config),
    }


def _options(config: EvaluationConfig) -> dict[str, Any]:
    return without_paths(config.chosen)


def _checkpoints(job: EvaluationJob) -> Iterator[tuple[str, Checkpoint]]:
    """Yield what plays, by its task or, where it plays a step only, by task and step."""
    made = job.make_policy
    for maker in (
        [maker for _, maker in made.makers] if isinstance(made, StagedPolicyMaker) else [made]
    ):
        if isinstance(maker, Checkpoint):
            step = maker.setting.step
            yield job.setting.task + (f"/{step}" if step else ""), maker


def _weights(checkpoint: Checkpoint) -> dict[str, Any]:
    """Return which weights a checkpoint has: its real folder, its training step, its hashes."""
    folder, base = checkpoint.folder, checkpoint.base
    hashes, of_base = weight_hashes(folder, base)
    weights = {
        "folder": str(folder),
        "type": checkpoint.type,
        "step": training_step(folder),
        "sha256": hashes,
    }
    return weights if base is None else weights | {"base": {"folder": str(base), "sha256": of_base}}


def weight_hashes(folder: Path, base: Path | None) -> tuple[dict[str, str], dict[str, str]]:
    """Return file -> SHA-256 of all that decides what a policy does, and of what it adapts.

    Args:
        folder: LeRobot's `pretrained_model` folder.
        base: Folder of the policy that it adapts, if it is an adapter (see `adapted`).

    Raises:
        CheckpointError: If a file is missing, or cannot be read.
    """
    of_base = {} if base is None else _hashes(base, (CONFIG, WEIGHTS))
    return _hashes(folder, checkpoint_files(folder)), of_base


def _hashes(folder: Path, names: Iterable[str]) -> dict[str, str]:
    try:
        return {name: provenance.sha256(folder / name) for name in names}
    except OSError as error:
        raise CheckpointError(f"{folder} cannot be read: {error}") from None


def training_step(folder: Path) -> int | None:
    """Return after how many steps of training it was saved, or None if nothing says so."""
    file = folder.parent / "training_state" / "training_step.json"
    if file.is_file():
        step = read_json_object(file, CheckpointError).get("step")
        return step if isinstance(step, int) else None
    return int(folder.parent.name) if folder.parent.name.isdigit() else None


def _several(values: Iterable[str | None]) -> str | None:
    return ", ".join(sorted({value for value in values if value is not None})) or None
