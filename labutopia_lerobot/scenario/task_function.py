"""Importing what makes a task: `level1/pick` is the function `pick` in `level1/pick.py`."""

import importlib
import importlib.util
import inspect
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from functools import cache
from pathlib import Path
from types import ModuleType

from labutopia_lerobot.errors import mistakes_located
from labutopia_lerobot.registry import BEYOND, PACKAGED, UnknownTaskError, require_task
from labutopia_lerobot.scenario.draw import Draw
from labutopia_lerobot.task import Task


@cache
def task_function(task_id: str, tasks_dir: str | Path | None = None) -> Callable[[Draw], Task]:
    """Return the function that makes the task with this id of a draw.

    A function without an argument, whose task is always the same, is called once.

    Raises:
        FileMistakeError: If the file, or what it calls, raises one of Python's own errors.
        UnknownTaskError: If there is no such task, or its file defines no such function.
    """
    path = require_task(task_id, tasks_dir)
    with _located(path):
        function = getattr(_import(task_id, path), path.stem, None)
    if not callable(function):
        raise UnknownTaskError(f"{path} must define the function `{path.stem}() -> Task`")

    def made(*draw: Draw) -> Task:
        with _located(path):
            return _require_task_value(function(*draw), path)

    if inspect.signature(function).parameters:
        return made
    task = made()
    return lambda draw: task


@contextmanager
def located_in_play(task_id: str, tasks_dir: str | Path | None = None) -> Iterator[None]:
    """Report a mistake in a task's predicates or skills with its file and line.

    Episodes are played within it: a task's code is called wherever one is judged, by
    the expert, and by what measures and explains. What the files of this package raise stays what
    it is, a bug.

    Raises:
        FileMistakeError: If a file of the user's raises anything that has no message of ours.
    """
    try:
        yield
    except Exception:
        # The file is looked for only now: a control step enters here too.
        with _located(require_task(task_id, tasks_dir), playing=True):
            raise


def _located(path: Path, *, playing: bool = False) -> AbstractContextManager[None]:
    """Return what reports mistakes in a task's file, and in those beside it; ours are bugs."""
    if path.is_relative_to(PACKAGED):
        return nullcontext()
    folder = path.parents[2 if path.parent.name == BEYOND else 1]
    return mistakes_located(folder, playing=playing)


def _require_task_value(task: object, path: Path) -> Task:
    if not isinstance(task, Task):
        raise UnknownTaskError(f"`{path.stem}` in {path} returned {task!r}, which is no Task")
    return task


def _import(task_id: str, path: Path) -> ModuleType:
    if path.is_relative_to(PACKAGED):
        dotted = ".".join(path.relative_to(PACKAGED).with_suffix("").parts)
        return importlib.import_module(f"labutopia_lerobot.tasks.{dotted}")
    name = f"labutopia_user_tasks.{task_id.replace('/', '.')}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise UnknownTaskError(f"{path} cannot be imported as Python")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
