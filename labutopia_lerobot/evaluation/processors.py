"""A checkpoint's processors, read before LeRobot sees them: they must not be able to run code.

LeRobot imports and calls whatever a step names by `class`, and only then looks at what it got.
"""

from collections.abc import Iterator
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.json_object import read_json_object

PREPROCESSOR = "policy_preprocessor.json"
POSTPROCESSOR = "policy_postprocessor.json"

_CURE = "Save the policy with LeRobot's save_pretrained, or do not use it if it is not yours"


class CheckpointError(UserError):
    """A checkpoint that is missing, or that cannot play the task; the message says the cure."""


def require_harmless(folder: Path) -> None:
    """Make sure that loading the processors of a checkpoint runs no code but LeRobot's own.

    Args:
        folder: LeRobot's `pretrained_model` folder.

    Raises:
        CheckpointError: If a step is none of LeRobot's registered ones, wants code from elsewhere,
            names a path outside the folder, or keeps its state in another form than safetensors.
    """
    for name in (PREPROCESSOR, POSTPROCESSOR):
        for problem in _problems(folder, read_steps(folder / name)):
            raise CheckpointError(f"{folder / name} is refused: {problem}. {_CURE}")


def read_steps(file: Path) -> list[dict[str, Any]]:
    """Return the steps of a processor file.

    Raises:
        CheckpointError: If it cannot be read, or lists no steps.
    """
    steps = read_json_object(file, CheckpointError).get("steps")
    if not isinstance(steps, list) or not all(isinstance(step, dict) for step in steps):
        raise CheckpointError(f"{file} is refused: it lists no `steps`. {_CURE}")
    return steps


def _problems(folder: Path, steps: list[dict[str, Any]]) -> Iterator[str]:
    for index, step in enumerate(steps):
        where, registered = f"step {index}", step.get("registry_name")
        if "class" in step:
            yield f"{where} names the class {step['class']!r}, which can run any code"
        if not isinstance(registered, str) or not registered:
            yield f"{where} has no registry_name"
        for key, value in _leaves(step):
            if key == "trust_remote_code" and value:
                yield f"{where} wants to run code from elsewhere ({key})"
            if isinstance(value, str) and _leaves_folder(value):
                yield f"{where} names the path {value!r}, which is not inside the checkpoint"
        if "state_file" in step:
            yield from _state_problems(folder, where, step["state_file"])


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
