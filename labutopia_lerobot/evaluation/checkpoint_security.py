"""A checkpoint's JSON, read before LeRobot sees it: it must not be able to run code.

LeRobot imports and calls whatever a processor's step names by `class`, and only then looks at what
it got. Some of its policies load models with code of their own from wherever their configuration
says. PEFT imports modules that an adapter names.
"""

from collections.abc import Iterator
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.json_object import read_json_object

PREPROCESSOR = "policy_preprocessor.json"
POSTPROCESSOR = "policy_postprocessor.json"
CONFIG = "config.json"
ADAPTER = "adapter_config.json"

FOREIGN_CODE = frozenset({"gaussian_actor", "groot", "pi0_fast", "wall_x"})
"""Policies of LeRobot 0.6 that pass `trust_remote_code=True`, whatever a checkpoint names."""

_TRUSTS_UNLESS_TOLD = "action_tokenizer_processor"
"""The step of LeRobot whose `trust_remote_code` is true by default."""

_ADAPTERS = ("LORA",)
_IMPORTING = ("megatron_config", "loftq_config", "corda_config", "eva_config", "lora_ga_config")
"""Keys of an adapter by which PEFT imports modules or reads other files."""

_CURE = "Save the policy with LeRobot's save_pretrained, or do not use it if it is not yours"


class CheckpointError(UserError):
    """A checkpoint that is missing, or that cannot play the task; the message says the cure."""


def require_safe_checkpoint(folder: Path) -> None:
    """Make sure that loading a checkpoint runs no code but LeRobot's own.

    Args:
        folder: LeRobot's `pretrained_model` folder.

    Raises:
        CheckpointError: If a step of its processors is none of LeRobot's registered ones, wants
            code from elsewhere, names a path outside the folder, or keeps its state in another form
            than safetensors; or as `require_safe_model`.
    """
    require_safe_model(folder)
    for name in (PREPROCESSOR, POSTPROCESSOR):
        for problem in _problems(folder, read_steps(folder / name)):
            raise CheckpointError(f"{folder / name} is refused: {problem}. {_CURE}")


def require_safe_model(folder: Path) -> None:
    """Make sure that loading the network of a checkpoint, without processors, runs no other code.

    Raises:
        CheckpointError: If its type of policy runs code from elsewhere, its configuration wants
            that, or its adapter is no LoRA, or one that names modules to import.
    """
    for problem in _model_problems(read_json_object(folder / CONFIG, CheckpointError)):
        raise CheckpointError(f"{folder / CONFIG} is refused: {problem}. {_CURE}")
    if not (folder / ADAPTER).exists():
        return
    for problem in _adapter_problems(read_json_object(folder / ADAPTER, CheckpointError)):
        raise CheckpointError(f"{folder / ADAPTER} is refused: {problem}. {_CURE}")


def read_steps(file: Path) -> list[dict[str, Any]]:
    """Return the steps of a processor file.

    Raises:
        CheckpointError: If it cannot be read, or lists no steps.
    """
    steps = read_json_object(file, CheckpointError).get("steps")
    if not isinstance(steps, list) or not all(isinstance(step, dict) for step in steps):
        raise CheckpointError(f"{file} is refused: it lists no `steps`. {_CURE}")
    return steps


def _model_problems(config: dict[str, Any]) -> Iterator[str]:
    if config.get("type") in FOREIGN_CODE:
        yield f"LeRobot runs code from elsewhere for policies of type '{config['type']}'"
    for key, value in _leaves(config):
        if key == "trust_remote_code" and value:
            yield f"it wants to run code from elsewhere ({key})"


def _adapter_problems(adapter: dict[str, Any]) -> Iterator[str]:
    if adapter.get("peft_type") not in _ADAPTERS:
        yield f"peft_type={adapter.get('peft_type')!r} is not one of {', '.join(_ADAPTERS)}"
    for key in _IMPORTING:
        if adapter.get(key):
            yield f"it has {key}, which may import code or read other files"


def _problems(folder: Path, steps: list[dict[str, Any]]) -> Iterator[str]:
    for index, step in enumerate(steps):
        where, registered = f"step {index}", step.get("registry_name")
        if "class" in step:
            yield f"{where} names the class {step['class']!r}, which can run any code"
        if not isinstance(registered, str) or not registered:
            yield f"{where} has no registry_name"
        if registered == _TRUSTS_UNLESS_TOLD and _trusts(step):
            yield f"{where} wants to run code from elsewhere (trust_remote_code, its default)"
        for key, value in _leaves(step):
            if key == "trust_remote_code" and value:
                yield f"{where} wants to run code from elsewhere ({key})"
            if isinstance(value, str) and _leaves_folder(value):
                yield f"{where} names the path {value!r}, which is not inside the checkpoint"
        if "state_file" in step:
            yield from _state_problems(folder, where, step["state_file"])


def _trusts(step: dict[str, Any]) -> bool:
    config = step.get("config")
    return not isinstance(config, dict) or config.get("trust_remote_code") is not False


def _state_problems(folder: Path, where: str, state: object) -> Iterator[str]:
    if not isinstance(state, str) or not state.endswith(".safetensors"):
        yield f"the state_file {state!r} of {where} is no .safetensors; other forms can run code"
    elif not (folder / state).is_file():
        yield f"the state_file {state!r} of {where} is missing"


def _leaves(value: object, key: str = "") -> Iterator[tuple[str, object]]:
    """Yield every plain value below a JSON value, with the key that it has; keys count too."""
    if isinstance(value, dict):
        for name, inner in value.items():
            yield "", name
            yield from _leaves(inner, name)
    elif isinstance(value, list):
        for inner in value:
            yield from _leaves(inner, key)
    else:
        yield key, value


def _leaves_folder(text: str) -> bool:
    # Both kinds, so that what is refused does not depend on the machine.
    paths = PurePosixPath(text), PureWindowsPath(text)
    absolute = text.startswith(("~", "/", "\\", "file:")) or any(p.is_absolute() for p in paths)
    return absolute or any(".." in path.parts for path in paths)
