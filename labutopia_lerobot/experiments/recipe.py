"""A recipe of `policies/` and a dataset become the command of `lerobot-train`."""

import io
import json
import math
from collections.abc import Iterable, Sequence
from contextlib import redirect_stderr
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from warnings import catch_warnings

from labutopia_lerobot.datasets.dataset_folder import INFO, require_dataset
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import read_json_object
from labutopia_lerobot.runtime.shipped import shipped

if TYPE_CHECKING:
    from lerobot.configs.train import TrainPipelineConfig

_SEEDS = 2**32
"""How many seeds numpy's global generator takes, from 0 (lerobot/utils/random_utils.py)."""


class RecipeError(UserError):
    """No such recipe, or an impossible number; the message lists the recipes."""


def training_command(
    policy: str, dataset: Path, epochs: int | None, batch_size: int | None, out: Path | None
) -> list[str]:
    """Return the command that trains a policy on a dataset with the recipe that suits it.

    Args:
        policy: A folder of `policies/`.
        dataset: Folder of the dataset; without pictures, the recipe for privileged state is taken.
        epochs: How often every frame is seen, or None for the recipe's own number of steps.
        batch_size: Frames per step, or None for the recipe's.
        out: Where the training goes; None for where `policy=` looks for it.

    Raises:
        NoDatasetError: If there is no such dataset.
        RecipeError: If there is no such recipe, or a number is impossible.
    """
    features = _info(dataset)["features"].values()
    pictures = any(feature.get("dtype") == "video" for feature in features)
    file = recipe_file(policy, "pixels" if pictures else "state")
    recipe = read_json_object(file, RecipeError)
    for name, value in {"epochs": epochs, "batch-size": batch_size}.items():
        if value is not None and value < 1:
            raise RecipeError(f"--{name} {value} is too small: at least 1")
    command = [
        "lerobot-train",
        f"--config_path={file}",
        f"--dataset.repo_id=local/{dataset.resolve().name}",
        f"--dataset.root={dataset}",
        f"--output_dir={out or Path('outputs/train') / policy / _place(dataset)}",
    ]
    size = batch_size or recipe["batch_size"]
    if batch_size is not None:
        command.append(f"--batch_size={batch_size}")
    if epochs is not None:
        frames = trained_frames(_episodes(dataset), recipe)
        command.append(f"--steps={math.ceil(epochs * frames / size)}")
    if _lerobot_averages():
        command.append("--ema.enable=true")
    return command


def trained_frames(episodes: Iterable[tuple[str, int]], recipe: dict[str, Any]) -> int:
    """Return how many frames a training draws from in one epoch.

    Of each task's episodes LeRobot holds the last `ceil(episodes * eval_split)` out
    (lerobot/datasets/factory.py), and a policy may leave out the last frames of each
    (`drop_n_last_frames`).

    Args:
        episodes: Task and number of frames of every episode, in order.
        recipe: What `lerobot-train` is configured with.
    """
    split = recipe.get("dataset", {}).get("eval_split", 0.0)
    dropped = recipe.get("policy", {}).get("drop_n_last_frames", 0)
    of: dict[str, list[int]] = {}
    for task, frames in episodes:
        of.setdefault(task, []).append(frames)
    return sum(
        max(frames - dropped, 0)
        for lengths in of.values()
        for frames in lengths[: len(lengths) - math.ceil(len(lengths) * split)]
    )


def _place(dataset: Path) -> str:
    """Return where, below a policy's folder, evaluations look for what a dataset trains.

    That is its task; of several tasks together, and of datasets of others, there is none, and it is
    the end of the dataset's path.
    """
    file = dataset / "meta" / "labutopia.json"
    recorded = read_json_object(file, RecipeError).get("config", {}) if file.is_file() else {}
    task, step = recorded.get("task"), recorded.get("step")
    if not isinstance(task, str):
        return "/".join(dataset.resolve().parts[-2:])
    return task if step is None else f"{task}/{step}"


def trainable_policies() -> list[str]:
    """Return the names of all policies that have a recipe."""
    return sorted({file.parent.name for file in shipped("policies").glob("*/train*.json")})


def recipe_file(policy: str, obs: str) -> Path:
    """Return the recipe of a policy that observes `pixels` or `state`.

    Raises:
        RecipeError: If there is none; the message lists the recipes.
    """
    name = "train.json" if obs == "pixels" else "train_state.json"
    file = shipped("policies") / policy / name
    if file.is_file():
        return file
    if policy in trainable_policies():
        raise RecipeError(
            f"{policy} has no recipe for a dataset "
            f"{'with' if name == 'train.json' else 'without'} pictures. There are: "
            f"{', '.join(sorted(f.name for f in file.parent.glob('train*.json')))}"
        )
    raise RecipeError(f"'{policy}' is no recipe. Recipes: {', '.join(trainable_policies())}")


@cache
def require_options(recipe: Path, words: tuple[str, ...]) -> None:
    """Have LeRobot read a recipe with further options, as it will when a training begins.

    Of a recipe that begins with a base model, LeRobot knows the options when that is loaded.

    Args:
        recipe: One of `recipe_file`.
        words: Arguments for `lerobot-train` beside it.

    Raises:
        RecipeError: If it refuses one; the message says why.
    """
    if "type" not in read_json_object(recipe, RecipeError).get("policy", {}):
        return
    import lerobot.policies  # noqa: F401  here: it takes seconds
    from draccus.utils import DecodingError
    from lerobot.configs.train import TrainPipelineConfig

    import labutopia_lerobot.behaviour_cloning  # noqa: F401  both register policies

    said = io.StringIO()
    try:
        with redirect_stderr(said):
            config = TrainPipelineConfig.from_pretrained(recipe, cli_args=[*words])
    except SystemExit:  # of its parser
        reason = said.getvalue().strip().rpartition("error: ")[2]
    except DecodingError as error:
        reason = _why(error)
    else:
        refusal = _refusal(config, words)
        if refusal is None:
            return
        reason = refusal
    raise RecipeError(
        f"lerobot-train refuses {' '.join(words)} with {recipe.parent.name}/{recipe.name}: {reason}"
    )


def _refusal(config: "TrainPipelineConfig", words: tuple[str, ...]) -> str | None:
    """Return why a training is not to begin with options that LeRobot takes as they are, or None.

    Of the optimizer's options, the recipe's or the policy's, it uses one kind and ignores the
    other. Numbers it hands to torch and numpy once the dataset is loaded; torch is asked here.
    """
    import torch

    assert config.policy is not None
    preset = config.use_policy_training_preset
    used, idle = ("policy.optimizer_", "policy.scheduler_"), ("optimizer.", "scheduler.")
    if not preset:
        used, idle = idle, used
    ignored = [word for word in words if word.startswith(tuple(f"--{name}" for name in idle))]
    if ignored:
        setting = f"use_policy_training_preset={str(preset).lower()}"
        return f"{setting} ignores {', '.join(ignored)}; say {'* or '.join(used)}*"
    if config.seed is not None and not 0 <= config.seed < _SEEDS:
        return f"seed {config.seed} is not from 0 to {_SEEDS - 1}"
    optimizer = config.policy.get_optimizer_preset() if preset else config.optimizer
    try:
        with catch_warnings(action="ignore"):  # a training says itself what it warns of
            torch.utils.data.DataLoader(
                torch.utils.data.TensorDataset(torch.zeros(1)),
                batch_size=config.batch_size,
                num_workers=config.num_workers,
                prefetch_factor=config.prefetch_factor if config.num_workers else None,
            )
        if optimizer is not None:
            optimizer.build([torch.nn.Parameter(torch.zeros(1))])
    except ValueError as error:
        return str(error)
    return None


def _why(error: BaseException) -> str:
    """Return the last line of an error and, if that says more, of what caused it in the end."""
    first = last = str(error).strip().splitlines()[-1].strip()
    while error.__cause__ is not None:
        error = error.__cause__
        last = str(error).strip()
    return first if last in first else f"{first} ({last})"


def _info(dataset: Path) -> dict[str, Any]:
    file = dataset / INFO
    require_dataset(dataset, (INFO,))
    return read_json_object(file, RecipeError)


def _episodes(dataset: Path) -> list[tuple[str, int]]:
    from pyarrow import parquet  # here: it takes half a second

    files: Sequence[Path] = sorted((dataset / "meta" / "episodes").rglob("*.parquet"))
    columns = ["episode_index", "tasks", "length"]
    rows = [row for file in files for row in parquet.read_table(file, columns=columns).to_pylist()]
    rows.sort(key=lambda row: row["episode_index"])
    return [(json.dumps(row["tasks"][:1]), row["length"]) for row in rows]


def _lerobot_averages() -> bool:
    """Return whether LeRobot can average weights over a training, as the paper did."""
    from lerobot.configs import default  # here: it takes seconds

    return hasattr(default, "EMAConfig")
