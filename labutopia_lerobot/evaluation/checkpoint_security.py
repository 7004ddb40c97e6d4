"""A checkpoint's JSON, read before LeRobot sees it: it must not be able to run code.

LeRobot imports and calls whatever a processor's step names by `class`, and only then looks at what
it got. Some of its policies load models with code of their own from wherever their configuration
says. PEFT imports modules that an adapter names.
"""

import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any, NotRequired, TypedDict

from huggingface_hub import try_to_load_from_cache

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.foreign_files import checked, read_json_object

PREPROCESSOR = "policy_preprocessor.json"
POSTPROCESSOR = "policy_postprocessor.json"
CONFIG = "config.json"
ADAPTER = "adapter_config.json"

FOREIGN_CODE = frozenset({"gaussian_actor", "groot", "pi0_fast", "wall_x"})
"""Policies of LeRobot 0.6 that pass `trust_remote_code=True`, whatever a checkpoint names."""

_TRUSTS_BY_DEFAULT = "action_tokenizer_processor"
"""The step of LeRobot whose `trust_remote_code` is true by default."""

_ADAPTERS = ("LORA",)
_IMPORTING = ("megatron_config", "loftq_config", "corda_config", "eva_config", "lora_ga_config")
"""Keys of an adapter by which PEFT imports modules or reads other files."""

_LARGEST = {"layers": 1_000, "heads": 10_000, "dim": 1_000_000, "size": 1_000_000}
"""Part of the name of a network's number -> the largest value that it may have."""

_REPEATED_GROUP = re.compile(r"\)[*+{]")
_REPETITION = re.compile(r"[*+{]")
_MOST_REPETITIONS = 3
"""Most repetitions in a pattern: with more, matching the names of all modules takes minutes."""

_TOKENIZER = "tokenizer_name"
_TOKENIZER_FILES = ("tokenizer_config.json", "tokenizer.json")

_CURE = "Save the policy with LeRobot's save_pretrained, or do not use it if it is not yours"


class ProcessorStep(TypedDict):
    """The part of a processor's step that is read."""

    config: NotRequired[dict[str, Any]]


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
        steps = read_steps(folder / name)
        for problem in _problems(folder, steps):
            raise CheckpointError(f"{folder / name} is refused: {problem}. {_CURE}")
        _require_tokenizers(folder, name, steps)


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
    said = read_json_object(file, CheckpointError).get("steps")
    steps: list[dict[str, Any]] = checked(
        list[ProcessorStep], said, f"{file}, steps", CheckpointError
    )
    return steps


def _model_problems(config: dict[str, Any]) -> Iterator[str]:
    if not isinstance(config.get("type"), str):
        yield "it does not name the type of the policy"
    elif config["type"] in FOREIGN_CODE:
        yield f"LeRobot runs code from elsewhere for policies of type '{config['type']}'"
    for key, value in _leaves(config):
        if key == "trust_remote_code" and value:
            yield f"it wants to run code from elsewhere ({key})"
        for part, most in _LARGEST.items():
            if part in key and isinstance(value, int | float) and not value <= most:
                yield f"{key} is {value}, and at most {most:,} can be"


def _adapter_problems(adapter: dict[str, Any]) -> Iterator[str]:
    if adapter.get("peft_type") not in _ADAPTERS:
        yield f"peft_type={adapter.get('peft_type')!r} is not one of {', '.join(_ADAPTERS)}"
    for key in _IMPORTING:
        if adapter.get(key):
            yield f"it has {key}, which may import code or read other files"
    for _, value in _leaves(adapter):
        if isinstance(value, str) and (
            _REPEATED_GROUP.search(value) or len(_REPETITION.findall(value)) > _MOST_REPETITIONS
        ):
            yield f"the pattern {value[:80]!r} may take for ever to match"


def _problems(folder: Path, steps: list[dict[str, Any]]) -> Iterator[str]:
    for index, step in enumerate(steps):
        where, registered = f"step {index}", step.get("registry_name")
        if "class" in step:
            yield f"{where} names the class {step['class']!r}, which can run any code"
        if not isinstance(registered, str) or not registered:
            yield f"{where} has no registry_name"
        if registered == _TRUSTS_BY_DEFAULT and _trusts(step):
            yield f"{where} wants to run code from elsewhere (trust_remote_code, its default)"
        for key, value in _leaves(step):
            if key == "trust_remote_code" and value:
                yield f"{where} wants to run code from elsewhere ({key})"
            if isinstance(value, str) and leaves_folder(value):
                yield f"{where} names the path {value!r}, which is not inside the checkpoint"
        if "state_file" in step:
            yield from _state_problems(folder, where, step["state_file"])


def _require_tokenizers(folder: Path, name: str, steps: list[dict[str, Any]]) -> None:
    """Make sure that no step of a checkpoint makes LeRobot ask the Hub for what nobody named."""
    for key, value in (leaf for step in steps for leaf in _leaves(step)):
        if key != _TOKENIZER or value is None:
            continue
        if not isinstance(value, str) or not value:
            raise CheckpointError(f"{folder / name} is refused: {_TOKENIZER} is {value!r}. {_CURE}")
        if not (folder / value).is_dir() and not _cached(value):
            raise CheckpointError(
                f"{folder / name} wants the tokenizer {value!r} of the Hugging Face Hub, which is "
                f"not on this machine. If you trust it: hf download {value}"
            )


def _cached(repo: str) -> bool:
    """Return whether a tokenizer of the Hub is in the cache of this machine."""
    try:
        return any(isinstance(try_to_load_from_cache(repo, f), str) for f in _TOKENIZER_FILES)
    except ValueError:  # no name of the Hub
        return False


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


def leaves_folder(text: str) -> bool:
    """Return whether a text is a path that leads out of the folder that it is read in."""
    # Both kinds, so that what is refused does not depend on the machine.
    paths = PurePosixPath(text), PureWindowsPath(text)
    absolute = text.startswith(("~", "/", "\\", "file:")) or any(p.is_absolute() for p in paths)
    return absolute or any(".." in path.parts for path in paths)
