"""A trained policy as a repository of the Hub: weights, processors, and what it achieved."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from huggingface_hub import EvalResult, ModelCardData

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.checkpoint_security import (
    POSTPROCESSOR,
    PREPROCESSOR,
    leaves_folder,
    read_steps,
    require_safe_checkpoint,
)
from labutopia_lerobot.evaluation.condition import ID, SINGLE, Condition
from labutopia_lerobot.evaluation.find_checkpoint import adapted, checkpoint_files
from labutopia_lerobot.evaluation.load_results import LoadedResult
from labutopia_lerobot.evaluation.origin import weight_hashes
from labutopia_lerobot.evaluation.rows import EvaluationSummary
from labutopia_lerobot.foreign_files import inside, read_json_object
from labutopia_lerobot.hub.card import TAGS, finished_summaries, model_card, options, summary_row
from labutopia_lerobot.hub.dataset_card import LOCAL
from labutopia_lerobot.hub.repository import CARD, Repository

_CONFIG = "config.json"
_TRAINING = "train_config.json"
_PLACES = ("", "pretrained_model", "checkpoints/last/pretrained_model")

_LOCAL_PLACES = ("output_dir", "root", "config_path", "checkpoint_path", "job_name")
"""Entries of the training's configuration that say something of the machine only."""


class UnpublishablePolicyError(UserError):
    """Results of something else than the policy; the message says of what."""


def find_policy(path: Path) -> Path | None:
    """Return LeRobot's `pretrained_model` folder at or below a path, or None."""
    folders = (path / place for place in _PLACES)
    return next((folder for folder in folders if (folder / _CONFIG).is_file()), None)


def policy_repository(folder: Path, repo_id: str, results: Sequence[LoadedResult]) -> Repository:
    """Return what is to lie on the Hub of a policy.

    Args:
        folder: LeRobot's `pretrained_model` folder.
        repo_id: Its name on the Hub.
        results: What it achieved; what other weights played is left out of its card.

    Raises:
        UnfinishedResultError: If a result is not finished.
        UnpublishablePolicyError: If there are results, and none was played by these very weights.
        CheckpointError: If a file is missing, or loading it would run code.
    """
    checkpoint_files(folder)
    require_safe_checkpoint(folder)
    config = read_json_object(folder / _CONFIG, UnpublishablePolicyError)
    own = _own_summaries(folder, results) if results else []
    files: dict[str, Path | bytes] = {
        name: inside(folder, name, UnpublishablePolicyError) for name in sorted(_names(folder))
    }
    if _TRAINING in files:
        training = read_json_object(folder / _TRAINING, UnpublishablePolicyError)
        files[_TRAINING] = (json.dumps(_without_places(training), indent=4) + "\n").encode()
    files[CARD] = _card(config["type"], _dataset(folder), repo_id, own).encode()
    return Repository("model", files)


def _names(folder: Path) -> set[str]:
    """Return the names of what is sent: what the policy is, and how it was trained.

    Neither pickles, which can run any code, nor states of optimisers, nor what else lies there.
    """
    steps = [s for name in (PREPROCESSOR, POSTPROCESSOR) for s in read_steps(folder / name)]
    states = {step["state_file"] for step in steps if "state_file" in step}
    training = {_TRAINING} if (folder / _TRAINING).is_file() else set()
    return {*checkpoint_files(folder), *states, *training}


def _without_places(value: Any, key: str = "") -> Any:
    """Return a configuration without folders of the machine that trained."""
    if isinstance(value, dict):
        return {name: _without_places(inner, name) for name, inner in value.items()}
    if isinstance(value, list):
        return [_without_places(inner, key) for inner in value]
    local = isinstance(value, str) and (key in _LOCAL_PLACES or leaves_folder(value))
    return None if local else value


def _own_summaries(folder: Path, results: Sequence[LoadedResult]) -> list[EvaluationSummary]:
    """Return what these very weights played, all steps of a task or one of them by itself.

    Raises:
        UnfinishedResultError: If a result is not finished.
        UnpublishablePolicyError: If they played none of the results; the message lists these.
    """
    summaries = finished_summaries(results)
    hashes = weight_hashes(folder, adapted(folder))
    own = [
        summary
        for result, of_result in zip(results, summaries, strict=True)
        for summary in of_result
        if _played_by(result, summary.condition) == hashes
    ]
    if not own:
        played = "; ".join(
            f"{result.place}: {', '.join(sorted({s.policy for s in of_result}))}"
            for result, of_result in zip(results, summaries, strict=True)
        )
        raise UnpublishablePolicyError(
            f"--results hold nothing that the weights in {folder} played ({played}). Evaluate "
            f"them: python eval/run.py policy.path={folder}"
        )
    return own


def _played_by(result: LoadedResult, condition: Condition) -> object:
    """Return the hashes of the weights that played alone under a condition, or None."""
    if condition.play != SINGLE:
        return None  # a policy per step: what they achieve is no single one's
    name = "/".join(filter(None, (condition.task, condition.step)))
    checkpoints = result.provenance.get("checkpoints")
    weights = checkpoints.get(name) if isinstance(checkpoints, dict) else None
    if not isinstance(weights, dict):
        return None
    return weights.get("sha256"), weights.get("base", {}).get("sha256", {})


def _dataset(folder: Path) -> str | None:
    """Return the name of the dataset that it was trained on, if its folder names it."""
    if not (folder / _TRAINING).is_file():
        return None
    dataset = read_json_object(folder / _TRAINING, UnpublishablePolicyError).get("dataset")
    name = dataset.get("repo_id") if isinstance(dataset, dict) else None
    return name if isinstance(name, str) else None


def _card(
    kind: str, dataset: str | None, repo_id: str, results: Sequence[EvaluationSummary]
) -> str:
    metadata = ModelCardData(
        license="apache-2.0",
        library_name="lerobot",
        pipeline_tag="robotics",
        tags=[*TAGS, kind],
        datasets=None if dataset is None or dataset.startswith(LOCAL) else [dataset],
        model_name=repo_id.partition("/")[2],
        eval_results=[_eval_result(line) for line in results] or None,
    )
    return model_card(
        "policy.md.jinja",
        metadata,
        kind=kind,
        repo_id=repo_id,
        dataset=dataset,
        results=[summary_row(line) for line in results],
        sequential=any(line.sequential for line in results),
        task=results[0].condition.task if results else "level1/pick",
    )


def _eval_result(summary: EvaluationSummary) -> EvalResult:
    played = summary.condition
    unusual = played.without_task(summary.policy).removeprefix(ID).lstrip(", ")
    name = ", ".join(filter(None, (played.task, unusual)))
    return EvalResult(
        task_type="robotics",
        dataset_type="labutopia",
        dataset_name=f"LabUtopia {name}",
        dataset_config=name,  # by this the Hub distinguishes results, not by the name
        dataset_split=played.split,
        metric_type="success_rate",
        metric_name="Success rate",
        metric_value=summary.rate,
        metric_config=f"{options(played)} episodes={summary.n}",
    )
