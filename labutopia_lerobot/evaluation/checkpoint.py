"""Checkpoints of LeRobot: where they are, what they observe, whether they fit a task.

Reads only the JSON beside the weights, so that a mistake is told before torch is imported.
"""

from dataclasses import dataclass, replace
from itertools import zip_longest
from pathlib import Path
from typing import Any

from labutopia_lerobot.evaluation.json_object import read_json_object
from labutopia_lerobot.evaluation.policies import Policy
from labutopia_lerobot.evaluation.processors import (
    POSTPROCESSOR,
    PREPROCESSOR,
    CheckpointError,
    read_steps,
    require_harmless,
)
from labutopia_lerobot.evaluation.trained_on import element_names
from labutopia_lerobot.features import ACTION, environment_state_names
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import CAMERAS, IMAGE_SIZE, Setting

_CONFIG = "config.json"
FILES = (_CONFIG, "model.safetensors", PREPROCESSOR, POSTPROCESSOR)
_PICKLES = {".bin", ".ckpt", ".pkl", ".pt", ".pth"}
_STATE = "observation.state"
_PRIVILEGED = "observation.environment_state"
_IMAGES = "observation.images."
_EMPTY_SLOT = "empty_camera"
"""LeRobot's name for cameras that a vision-language-action model can do without."""


@dataclass(frozen=True)
class Checkpoint:
    """A trained policy that fits a task; calling it loads the weights.

    Attributes:
        folder: LeRobot's `pretrained_model` folder, with links such as `last` followed: what is
            told of it stays true, and every worker loads the same, whatever training does.
        device: Device of torch, or None for CUDA where there is one.
        setting: What it plays and observes.
    """

    folder: Path
    device: str | None
    setting: Setting

    def __call__(self) -> Policy:
        """Load the policy."""
        # Here: torch takes seconds to import, and only the workers need it.
        from labutopia_lerobot.evaluation.learned import LearnedPolicy

        return LearnedPolicy(self.folder, self.device)


def open_checkpoint(
    path: Path, policy: str, setting: Setting, obs: str | None = None, device: str | None = None
) -> Checkpoint:
    """Find the checkpoint for a task and make sure that it can play it.

    The elements of `environment_state` are compared by name while the dataset of the training is on
    this machine, since LeRobot keeps the shapes only; otherwise by number. Then a checkpoint of
    another task with as many elements is not noticed.

    Args:
        path: A `pretrained_model` folder, an `output_dir` of `lerobot-train`, or a folder that
            holds either of them per task, such as `level1/pick`.
        policy: LeRobot's name of the policy, such as `act`.
        setting: What to play; observed is what the checkpoint was trained on.
        obs: What it must have been trained on, `pixels` or `state`, or None for either.
        device: Device of torch, or None for CUDA where there is one.

    Raises:
        CheckpointError: If there is none, or it cannot play the task.
    """
    folder = _find(path, policy, setting.task, obs).resolve()
    _require_files(folder)
    require_harmless(folder)
    config = read_json_object(folder / _CONFIG, CheckpointError)
    _require_type(folder, config, policy)
    inputs = _shapes(folder, config, "input_features")
    outputs = _shapes(folder, config, "output_features")
    elements = len(load_robot(setting.robot).elements)
    _require_size(folder, ACTION, outputs.get(ACTION), elements)
    # Models that pad the state also scale the pictures, and keep the sizes of their base model.
    adapts = "max_state_dim" in config
    if not adapts:
        _require_size(folder, _STATE, inputs.get(_STATE), elements)
    pictures = {key: shape for key, shape in inputs.items() if key.startswith(_IMAGES)}
    _require_obs(folder, "pixels" if pictures else "state", obs)
    if not pictures:
        names = environment_state_names(canonical_task(setting))
        _require_size(folder, _PRIVILEGED, inputs.get(_PRIVILEGED), len(names))
        _require_names(folder, setting.task, names)
        return Checkpoint(folder, device, replace(setting, obs="state"))
    if _PRIVILEGED in inputs:
        raise CheckpointError(
            f"{folder} wants both pictures and {_PRIVILEGED}, but obs=pixels and obs=state offer "
            "one of them. Train on one"
        )
    cameras = _cameras(folder, pictures)
    height, width = (IMAGE_SIZE, IMAGE_SIZE) if adapts else _picture_size(folder, pictures)
    seen = replace(setting, obs="pixels", cameras=cameras, width=width, height=height)
    return Checkpoint(folder, device, seen)


def _find(path: Path, policy: str, task_id: str, obs: str | None) -> Path:
    for folder in (path / task_id, path):
        for inner in ("", "pretrained_model", "checkpoints/last/pretrained_model"):
            if (folder / inner / _CONFIG).is_file():
                return folder / inner
    name = task_id.rpartition("/")[2]
    recorded, recipe = (" obs=state", "train_state") if obs == "state" else ("", "train")
    raise CheckpointError(
        f"No checkpoint for {task_id} at policy.path={path}: it has neither {_CONFIG}, nor "
        f"checkpoints/last/pretrained_model, nor {task_id}. Make one:\n"
        f"  labutopia-record task={task_id}{recorded}\n"
        f"  lerobot-train --config_path=policies/{policy}/{recipe}.json "
        f"--dataset.repo_id=local/{name} "
        f"--dataset.root=outputs/datasets/{task_id} --output_dir={path / task_id}"
    )


def _require_files(folder: Path) -> None:
    missing = [name for name in FILES if not (folder / name).is_file()]
    if not missing:
        return
    pickles = sorted(file.name for file in folder.iterdir() if file.suffix in _PICKLES)
    pickled = (
        f" It holds {', '.join(pickles)}, but pickles can run any code: save the policy with "
        "LeRobot's save_pretrained"
        if pickles
        else " It must be whole, as lerobot-train saves it"
    )
    raise CheckpointError(f"{folder} lacks {', '.join(missing)}.{pickled}")


def _require_type(folder: Path, config: dict[str, Any], policy: str) -> None:
    found = config.get("type")
    if found != policy:
        raise CheckpointError(
            f"policy={policy} cannot play {folder}, which holds a policy of type '{found}'. "
            "Choose the policy of that type, or another policy.path="
        )


def _require_obs(folder: Path, trained_on: str, obs: str | None) -> None:
    if obs not in (None, trained_on):
        raise CheckpointError(
            f"obs={obs} does not suit {folder}, which was trained with obs={trained_on}. "
            "Leave obs= out"
        )


def _shapes(folder: Path, config: dict[str, Any], kind: str) -> dict[str, tuple[int, ...]]:
    try:
        return {key: tuple(feature["shape"]) for key, feature in config[kind].items()}
    except (AttributeError, KeyError, TypeError):
        raise CheckpointError(f"{folder / _CONFIG} declares no {kind}") from None


def _require_size(folder: Path, key: str, shape: tuple[int, ...] | None, size: int) -> None:
    if shape != (size,):
        found = "none" if shape is None else f"one of shape {shape}"
        raise CheckpointError(
            f"{folder} does not fit: `{key}` has {size} elements in this task, and it was trained "
            f"with {found}. Train it on a dataset that labutopia-record made of this task"
        )


def _require_names(folder: Path, task: str, names: tuple[str, ...]) -> None:
    known = element_names(folder, _PRIVILEGED)
    if known is None or known[1] == names:
        return
    root, trained = known
    there, here = next((a, b) for a, b in zip_longest(trained, names) if a != b)
    raise CheckpointError(
        f"{folder} does not fit {task}: it was trained on {root}, where `{_PRIVILEGED}` has "
        f"{there!r} for what is {here!r} here. Train it on a dataset of this task; if another "
        "dataset has come to lie there since, take `dataset` out of its train_config.json"
    )


def _cameras(folder: Path, pictures: dict[str, tuple[int, ...]]) -> tuple[str, ...]:
    renamed = {
        after: before
        for step in read_steps(folder / PREPROCESSOR)
        if step["registry_name"] == "rename_observations_processor"
        for before, after in step["config"].get("rename_map", {}).items()
    }
    seen = [renamed.get(key, key) for key in pictures if _EMPTY_SLOT not in key]
    unknown = [key for key in seen if key.removeprefix(_IMAGES) not in CAMERAS]
    if unknown:
        raise CheckpointError(
            f"{folder} looks through {', '.join(unknown)}, which do not exist here. "
            f"Cameras: {', '.join(_IMAGES + camera for camera in CAMERAS)}"
        )
    return tuple(key.removeprefix(_IMAGES) for key in seen)


def _picture_size(folder: Path, pictures: dict[str, tuple[int, ...]]) -> tuple[int, int]:
    sizes = {shape[-2:] for shape in pictures.values()}
    if len(sizes) > 1:
        raise CheckpointError(f"{folder} wants pictures of several sizes: {sorted(sizes)}")
    height, width = sizes.pop()
    return height, width
