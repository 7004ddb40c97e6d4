"""Checkpoints of LeRobot: what they observe, whether they fit a task.

Reads only the JSON beside the weights, so that a mistake is reported before torch is imported.
"""

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import zip_longest
from pathlib import Path
from typing import Any

from safetensors import SafetensorError, safe_open

from labutopia_lerobot.datasets.description import INFO, RECORDING
from labutopia_lerobot.evaluation.checkpoint_security import (
    CONFIG,
    PREPROCESSOR,
    CheckpointError,
    read_steps,
    require_safe_checkpoint,
    require_safe_model,
)
from labutopia_lerobot.evaluation.find_checkpoint import (
    WEIGHTS,
    adapted,
    checkpoint_files,
    find_checkpoint,
)
from labutopia_lerobot.evaluation.policies import Policy
from labutopia_lerobot.features import ACTION
from labutopia_lerobot.foreign_files import checked, read_json_object
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenario.privileged_state import environment_state_names
from labutopia_lerobot.setting import CAMERAS, IMAGE_SIZE, Setting

_STATE = "observation.state"
_PRIVILEGED = "observation.environment_state"
_IMAGES = "observation.images."
_RENAMING = "rename_observations_processor"


@dataclass(frozen=True)
class Checkpoint:
    """A trained policy that fits a task; calling it loads the weights.

    Attributes:
        folder: LeRobot's `pretrained_model` folder, with links such as `last` followed: what is
            recorded of it stays true, and every worker loads the same, whatever training does.
        base: Folder of the policy that `folder` adapts, if that is a LoRA adapter.
        type: LeRobot's name of the policy.
        device: Device of torch, or None for CUDA where there is one.
        rename: Pairs of a key of ours and what the policy calls it, or None for those that the
            checkpoint was trained with.
        setting: What it plays and observes.
    """

    folder: Path
    base: Path | None
    type: str
    device: str | None
    rename: tuple[tuple[str, str], ...] | None
    setting: Setting

    def __call__(self) -> Policy:
        """Load the policy."""
        # Here: torch takes seconds to import, and only the workers need it.
        from labutopia_lerobot.evaluation.learned_policy import LearnedPolicy

        rename = None if self.rename is None else dict(self.rename)
        return LearnedPolicy(self.folder, self.device, self.base, rename)


def open_checkpoint(
    path: Path | str,
    policy: str | None,
    setting: Setting,
    obs: str | None = None,
    device: str | None = None,
    rename: Mapping[str, str] | None = None,
    one_of_several: bool = False,
) -> Checkpoint:
    """Find the checkpoint for a task, or a step of it, and make sure that it can play it.

    The elements of `environment_state` are compared by name while the dataset of the training is on
    this machine, since LeRobot keeps the shapes only; otherwise by number. Then a checkpoint of
    another task with as many elements is not noticed.

    Args:
        path: See `find_checkpoint`.
        policy: LeRobot's name of the policy, such as `act`, or None for whatever it is.
        setting: What to play; observed is what the checkpoint was trained on.
        obs: What it must have been trained on, `pixels` or `state`, or None for either.
        device: Device of torch, or None for CUDA where there is one.
        rename: Our key -> what the policy calls it; None or empty for the checkpoint's own.
        one_of_several: See `find_checkpoint`.

    Raises:
        CheckpointError: If there is none, or it cannot play the task.
    """
    folder = find_checkpoint(str(path), policy, setting.task, obs, setting.step, one_of_several)
    files = [folder / name for name in checkpoint_files(folder)]
    require_safe_checkpoint(folder)
    base = adapted(folder)
    if base is not None:
        require_safe_model(base)
        files.append(base / WEIGHTS)
    _require_whole(file for file in files if file.suffix == ".safetensors")
    config = read_json_object(folder / CONFIG, CheckpointError)
    kind = _type(folder, config, policy)
    renamed = dict(rename) if rename else _trained_rename(folder)
    inputs = _shapes(folder, config, "input_features")
    outputs = _shapes(folder, config, "output_features")
    elements = len(load_robot(setting.robot).elements)
    _require_size(folder, ACTION, outputs.get(ACTION), elements)
    # Models that pad the state also scale the pictures, and keep the sizes of their base model.
    adapts = "max_state_dim" in config
    if not adapts:
        _require_size(folder, _STATE, inputs.get(renamed.get(_STATE, _STATE)), elements)
    pictures = {key: shape for key, shape in inputs.items() if key.startswith(_IMAGES)}
    _require_obs(folder, "pixels" if pictures else "state", obs)
    if pictures and _PRIVILEGED in inputs:
        raise CheckpointError(
            f"{folder} wants both pictures and {_PRIVILEGED}, but obs=pixels and obs=state offer "
            "one of them. Train on one"
        )
    if pictures:
        cameras = _cameras(folder, pictures, renamed, adapts)
        height, width = (IMAGE_SIZE, IMAGE_SIZE) if adapts else _picture_size(folder, pictures)
        observed = replace(setting, obs="pixels", cameras=cameras, width=width, height=height)
    else:
        names = environment_state_names(canonical_task(setting), setting.hidden)
        _require_size(folder, _PRIVILEGED, inputs.get(_PRIVILEGED), len(names))
        _require_names(folder, setting.task, names)
        observed = setting.without_pictures()
    chosen = tuple(sorted(rename.items())) if rename else None
    return Checkpoint(folder, base, kind, device, chosen, observed)


def _require_whole(files: Iterable[Path]) -> None:
    """Make sure that weights have the length that they should have, before anything is begun."""
    for file in files:
        try:
            with safe_open(file, framework="numpy"):
                pass
        except (OSError, SafetensorError) as error:
            raise CheckpointError(
                f"{file} is damaged or cut short ({error}). Copy or download it again"
            ) from None


def _type(folder: Path, config: dict[str, Any], policy: str | None) -> str:
    stored = config.get("type")
    if not isinstance(stored, str):
        raise CheckpointError(f"{folder / CONFIG} does not name the type of the policy")
    if policy not in (None, stored):
        raise CheckpointError(
            f"policy={policy} cannot play {folder}, which holds a policy of type '{stored}'. "
            "Leave policy= out, or choose another policy.path="
        )
    return stored


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
        raise CheckpointError(f"{folder / CONFIG} declares no {kind}") from None


def _require_size(folder: Path, key: str, shape: tuple[int, ...] | None, size: int) -> None:
    if shape != (size,):
        trained = "none" if shape is None else f"one of shape {shape}"
        cure = "the hidden= of its dataset" if key == _PRIVILEGED else "the robot= of its dataset"
        raise CheckpointError(
            f"{folder} does not fit: `{key}` has {size} elements in this task, and it was trained "
            f"with {trained}{_of(folder)}. Choose {cure}, or train it on a dataset that "
            "labutopia-record made of this task"
        )


def _of(folder: Path) -> str:
    """Return of which tasks the dataset of a checkpoint was, if anybody knows."""
    tasks = trained_on(folder)
    return f", on {' and '.join(tasks)}" if tasks else ""


def _require_names(folder: Path, task: str, names: tuple[str, ...]) -> None:
    known = element_names(folder, _PRIVILEGED)
    if known is None or known[1] == names:
        return
    root, trained = known
    there, here = next((a, b) for a, b in zip_longest(trained, names) if a != b)
    raise CheckpointError(
        f"{folder} does not fit {task}: it was trained on {root}, where `{_PRIVILEGED}` has "
        f"{there!r} for what is {here!r} here. Train it on a dataset of this task, with the same "
        "hidden=; if another dataset has come to lie there since, take `dataset` out of its "
        "train_config.json"
    )


def _trained_rename(folder: Path) -> dict[str, str]:
    """Return what a training renamed: a map may name cameras that its dataset did not have."""
    steps = read_steps(folder / PREPROCESSOR)
    states = [folder / step["state_file"] for step in steps if "state_file" in step]
    trained = {key for key in keys_with_statistics(states) if key.startswith(_IMAGES)}
    return {
        before: after
        for step in steps
        if step["registry_name"] == _RENAMING
        for before, after in _rename_map(folder, step).items()
        if not before.startswith(_IMAGES) or not trained or trained & {before, after}
    }


def _rename_map(folder: Path, step: Mapping[str, Any]) -> dict[str, str]:
    said = step.get("config", {}).get("rename_map", {})
    where = f"{folder / PREPROCESSOR}, rename_map"
    names: dict[str, str] = checked(dict[str, str], said, where, CheckpointError)
    return names


def _cameras(
    folder: Path,
    pictures: Mapping[str, tuple[int, ...]],
    renamed: Mapping[str, str],
    may_miss: bool,
) -> tuple[str, ...]:
    """Return our cameras, in the policy's order.

    Vision-language-action models have slots for cameras: one that none of ours is called by stays
    empty, as it was in training. Every other policy needs all of its pictures.
    """
    ours = {renamed.get(_IMAGES + camera, _IMAGES + camera): camera for camera in CAMERAS}
    unknown = [key for key in pictures if key not in ours]
    if not any(key in ours for key in pictures) or (unknown and not may_miss):
        raise CheckpointError(
            f"{folder} looks through {', '.join(unknown)}, which do not exist here. "
            f"Cameras: {', '.join(_IMAGES + camera for camera in CAMERAS)}. If one of these is "
            f"meant: 'policy.rename={{{_IMAGES}{CAMERAS[0]}: {unknown[0]}}}'"
        )
    return tuple(ours[key] for key in pictures if key in ours)


def _picture_size(folder: Path, pictures: Mapping[str, tuple[int, ...]]) -> tuple[int, int]:
    sizes = {shape[-2:] for shape in pictures.values()}
    if len(sizes) > 1:
        raise CheckpointError(f"{folder} wants pictures of several sizes: {sorted(sizes)}")
    height, width = sizes.pop()
    return height, width


_TRAINING = "train_config.json"


def element_names(folder: Path, key: str) -> tuple[Path, tuple[str, ...]] | None:
    """Return the dataset of a checkpoint, and how it names the elements of a vector.

    LeRobot keeps shapes with the weights, and no names. Those stand in the dataset, to which only a
    path leads, relative to where `lerobot-train` was run: None, if it leads nowhere any more.

    Args:
        folder: LeRobot's `pretrained_model` folder.
        key: Key of the vector, such as `observation.environment_state`.
    """
    root = _dataset(folder)
    if root is None:
        return None
    features = _read(root / INFO).get("features")
    feature = features.get(key) if isinstance(features, dict) else None
    names = feature.get("names") if isinstance(feature, dict) else None
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        return None
    return root, tuple(names)


def trained_on(folder: Path) -> tuple[str, ...]:
    """Return the tasks of the dataset that a checkpoint was trained on; empty if nobody knows them.

    Args:
        folder: LeRobot's `pretrained_model` folder.
    """
    root = _dataset(folder)
    recorded = {} if root is None else _read(root / RECORDING).get("config")
    tasks = recorded.get("task") if isinstance(recorded, dict) else None
    named = tasks if isinstance(tasks, list) else [tasks]
    return tuple(task for task in named if isinstance(task, str))


def _dataset(folder: Path) -> Path | None:
    """Return where the dataset of a checkpoint's training lay, or None if it does not say."""
    dataset = _read(folder / _TRAINING).get("dataset")
    if not isinstance(dataset, dict) or not isinstance(dataset.get("repo_id"), str):
        return None
    if isinstance(dataset.get("root"), str) and dataset["root"]:
        return Path(dataset["root"])
    return _home() / str(dataset["repo_id"])


def keys_with_statistics(states: Iterable[Path]) -> set[str]:
    """Return the keys of everything that a training had statistics of; empty if nothing says so.

    LeRobot keeps those of the whole dataset with its normaliser, `KEY.mean` and so on, whatever the
    policy uses.

    Args:
        states: Files of the states of a processor's steps.
    """
    keys: set[str] = set()
    for file in states:
        try:
            with safe_open(file, framework="numpy") as tensors:
                keys |= {name.rpartition(".")[0] for name in tensors.keys()}  # noqa: SIM118
        except (OSError, SafetensorError):
            continue  # what cannot be known is not checked
    return keys


def _home() -> Path:
    """Return where LeRobot keeps datasets without a root; its own constant would bring torch."""
    cache = Path(os.environ.get("HF_HOME") or Path.home() / ".cache" / "huggingface")
    return Path(os.environ.get("HF_LEROBOT_HOME") or cache / "lerobot")


def _read(file: Path) -> dict[str, Any]:
    """Return a JSON object, empty if there is none: what cannot be known is not checked."""
    try:
        return read_json_object(file, CheckpointError)
    except CheckpointError:
        return {}
