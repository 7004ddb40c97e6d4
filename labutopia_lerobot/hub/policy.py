"""A trained policy as a repository of the Hub: weights, processors, and what it achieved."""

from collections.abc import Sequence
from pathlib import Path

from huggingface_hub import EvalResult, ModelCardData

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.checkpoint_folder import checkpoint_files
from labutopia_lerobot.evaluation.harmless import require_harmless
from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.hub.card import TAGS, model_card, summary_row
from labutopia_lerobot.hub.dataset_card import LOCAL
from labutopia_lerobot.hub.repository import CARD, Repository

_CONFIG = "config.json"
_TRAINING = "train_config.json"
_PLACES = ("", "pretrained_model", "checkpoints/last/pretrained_model")
_SENT = {".json", ".safetensors"}
"""Neither pickles, which can run any code, nor states of optimisers."""


class UnpublishablePolicyError(UserError):
    """Results of something else than the policy; the message says of what."""


def find_policy(path: Path) -> Path | None:
    """Return LeRobot's `pretrained_model` folder at or below a path, or None."""
    folders = (path / place for place in _PLACES)
    return next((folder for folder in folders if (folder / _CONFIG).is_file()), None)


def policy_repository(folder: Path, repo_id: str, results: Sequence[Summary]) -> Repository:
    """Return what is to lie on the Hub of a policy.

    Args:
        folder: LeRobot's `pretrained_model` folder.
        repo_id: Its name on the Hub.
        results: What it achieved; rows of other policies are left out of its card.

    Raises:
        UnpublishablePolicyError: If no row is of a policy of its type.
        CheckpointError: If a file is missing, or loading it would run code.
    """
    checkpoint_files(folder)
    require_harmless(folder)
    config = read_json_object(folder / _CONFIG, UnpublishablePolicyError)
    own = [line for line in results if line.policy == config["type"]]
    if results and not own:
        played = ", ".join(sorted({line.policy for line in results}))
        raise UnpublishablePolicyError(
            f"--results are of {played}, and {folder} holds a policy of type {config['type']}"
        )
    files: dict[str, Path | bytes] = {
        file.name: file for file in sorted(folder.iterdir()) if file.suffix in _SENT
    }
    files[CARD] = _card(config["type"], _dataset(folder), repo_id, own).encode()
    return Repository("model", files)


def _dataset(folder: Path) -> str | None:
    """Return the name of the dataset that it was trained on, if its folder tells."""
    if not (folder / _TRAINING).is_file():
        return None
    told = read_json_object(folder / _TRAINING, UnpublishablePolicyError)
    name: str | None = told.get("dataset", {}).get("repo_id")
    return name


def _card(kind: str, dataset: str | None, repo_id: str, results: Sequence[Summary]) -> str:
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
        task=results[0].task if results else "level1/pick",
    )


def _eval_result(summary: Summary) -> EvalResult:
    return EvalResult(
        task_type="robotics",
        dataset_type="labutopia",
        dataset_name=f"LabUtopia {summary.task}",
        dataset_split=summary.split,
        metric_type="success_rate",
        metric_name="Success rate",
        metric_value=summary.rate,
        metric_config=f"obs={summary.obs} liquid={summary.liquid} episodes={summary.n}",
    )
