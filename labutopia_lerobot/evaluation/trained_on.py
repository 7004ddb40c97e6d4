"""What a checkpoint was trained on: what its dataset says, while it is here, and statistics."""

import json
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from safetensors import SafetensorError, safe_open

_TRAINING = "train_config.json"
_INFO = "meta/info.json"


def element_names(folder: Path, key: str) -> tuple[Path, tuple[str, ...]] | None:
    """Return the dataset of a checkpoint, and how it names the elements of a vector.

    LeRobot keeps shapes with the weights, and no names. Those stand in the dataset, to which only a
    path leads, relative to where `lerobot-train` was run: None, if it leads nowhere any more.

    Args:
        folder: LeRobot's `pretrained_model` folder.
        key: Key of the vector, such as `observation.environment_state`.
    """
    dataset = _read(folder / _TRAINING).get("dataset")
    if not isinstance(dataset, dict) or not isinstance(dataset.get("repo_id"), str):
        return None
    root = Path(dataset.get("root") or _home() / dataset["repo_id"])
    feature = _read(root / _INFO).get("features", {}).get(key, {})
    names = feature.get("names")
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        return None
    return root, tuple(names)


def keys_with_statistics(states: Iterable[Path]) -> set[str]:
    """Return the keys of everything that a training had statistics of; empty if nothing tells.

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
        content = json.loads(file.read_text())
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}
