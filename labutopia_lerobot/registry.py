"""Finding tasks: `level1/pick` is the function `pick` in the file `level1/pick.py`.

Tasks that the paper does not have lie in `beyond` below their level: `level1/beyond/squeeze.py` is
`level1/squeeze`. They have ids as all others, but `level=1` means the tasks of the paper, and in
listings they come after those. So it is with the tasks of other folders.

There is nothing to register. A folder that holds `level1` ... `level5` is a task folder: the one in
this package, those that installed distributions name under the entry point `labutopia.tasks` (a
package with such folders), and those that the user names with `tasks_dir`.
"""

import difflib
import importlib.metadata
import importlib.util
import warnings
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from labutopia_lerobot.errors import UserError

LEVELS = (1, 2, 3, 4, 5)
BEYOND = "beyond"
"""Name of the folders of tasks that the paper does not have."""
ENTRY_POINT_GROUP = "labutopia.tasks"
PACKAGED = Path(__file__).parent / "tasks"
"""Folder of the tasks in this package."""


class UnknownTaskError(UserError, ValueError):
    """A task, level or task folder that does not exist; the message lists those that do."""


def task_files(tasks_dir: str | Path | None = None) -> dict[str, Path]:
    """Return every task id with its file, in order of level and name; those of the paper first.

    Args:
        tasks_dir: A further folder that holds `level1` ... `level5`.

    Raises:
        UnknownTaskError: If `tasks_dir` holds no task, or two folders hold the same task.
    """
    if tasks_dir is not None and not _modules_in(Path(tasks_dir)):
        raise UnknownTaskError(
            f"tasks_dir={tasks_dir} holds no task: put one at {tasks_dir}/level1/<name>.py"
        )
    files: dict[str, Path] = {}
    for folder in _folders(tasks_dir):
        for path in _packaged_modules() if folder == PACKAGED else _modules_in(folder):
            level = path.parent.parent if path.parent.name == BEYOND else path.parent
            task_id = f"{level.name}/{path.stem}"
            if task_id in files:
                raise UnknownTaskError(
                    f"Task '{task_id}' exists twice: {files[task_id]} and {path}. Rename one."
                )
            files[task_id] = path
    return dict(sorted(files.items(), key=lambda item: (not _of_paper(item[1]), item[0])))


def is_beyond_paper(task_id: str, tasks_dir: str | Path | None = None) -> bool:
    """Return whether a task is none of the paper's.

    Raises:
        UnknownTaskError: If there is no such task.
    """
    return not _of_paper(require_task(task_id, tasks_dir))


def _of_paper(file: Path) -> bool:
    return file.parent.parent == PACKAGED


def tasks_of_levels(levels: Iterable[int], tasks_dir: str | Path | None = None) -> list[str]:
    """Return the ids of every task of the levels, without those beyond the paper.

    Raises:
        UnknownTaskError: If a level does not exist or has no task yet.
    """
    chosen: list[str] = []
    files = task_files(tasks_dir)
    known = [task_id for task_id, path in files.items() if _of_paper(path)]
    for level in levels:
        of_level = [task_id for task_id in known if task_id.startswith(f"level{level}/")]
        if not of_level:
            present = ", ".join(str(level) for level in levels_with_tasks(tasks_dir))
            raise UnknownTaskError(f"Level {level} has no tasks. Levels with tasks: {present}")
        chosen += of_level
    return chosen


def levels_with_tasks(tasks_dir: str | Path | None = None) -> list[int]:
    """Return the levels that have a task."""
    return sorted({int(task.split("/")[0].removeprefix("level")) for task in task_files(tasks_dir)})


def choose_tasks(
    task: str | list[str] | None,
    level: Any,
    tasks_dir: str | Path | None = None,
) -> list[str]:
    """Return the task ids that the options `task` and `level` name together, each of them once.

    Args:
        task: A task id, the bare name of a task of one of the levels, a list of these, or None for
            every task of the levels.
        level: A level, a list of these, `all`, or None where tasks are named by their ids.
        tasks_dir: A further folder of tasks.

    Raises:
        UnknownTaskError: If nothing is named, or what is named does not exist.
    """
    levels: list[Any] | None = None if level is None else listed(level)
    if levels == ["all"]:
        levels = levels_with_tasks(tasks_dir)
    named = [None] if task is None else listed(task)
    return list(dict.fromkeys(t for name in named for t in _chosen(name, levels, tasks_dir)))


def listed[T](one_or_several: T | list[T]) -> list[T]:
    """Return the values of an option that takes one or a list."""
    return one_or_several if isinstance(one_or_several, list) else [one_or_several]


def _chosen(task: str | None, levels: list[int] | None, tasks_dir: str | Path | None) -> list[str]:
    if levels is None:
        if task is None:
            raise UnknownTaskError("Name a task (task=level1/pick) or a level (level=1)")
        require_task(task, tasks_dir)
        return [task]
    of_levels = tasks_of_levels(levels, tasks_dir)
    if task is None:
        return of_levels
    prefixes = tuple(f"level{level}/" for level in levels)
    of_levels = [task_id for task_id in task_files(tasks_dir) if task_id.startswith(prefixes)]
    chosen = [task_id for task_id in of_levels if task in (task_id, task_id.split("/")[1])]
    if not chosen:
        raise UnknownTaskError(f"No task '{task}' in these levels: {', '.join(of_levels)}")
    return chosen


def require_task(task_id: str, tasks_dir: str | Path | None = None) -> Path:
    """Return the file of a task.

    Raises:
        UnknownTaskError: If there is none; the message names the nearest, and what lists all.
    """
    files = task_files(tasks_dir)
    if not isinstance(task_id, str):
        raise UnknownTaskError(f"task={task_id!r} is no name of a task, such as level1/pick")
    if task_id not in files:
        near = _nearest(task_id, list(files))
        hint = f" Did you mean {' or '.join(repr(task) for task in near)}?" if near else ""
        own = "A task of your own is found with tasks_dir="
        if tasks_dir:
            folder = Path(tasks_dir).resolve()
            mine = [task for task, path in files.items() if path.is_relative_to(folder)]
            own = f"In {tasks_dir}: {', '.join(mine)}"
        raise UnknownTaskError(
            f"Unknown task '{task_id}'.{hint} `labutopia-record --help` lists all. {own}"
        )
    return files[task_id]


def _nearest(task_id: str, tasks: list[str]) -> list[str]:
    """Return the tasks of a bare name, lowest level first, or else those of similar names."""
    named = [task for task in tasks if task.split("/")[1] == task_id]
    if named or "/" in task_id:
        return named or difflib.get_close_matches(task_id, tasks, n=3, cutoff=0.8)
    names = dict.fromkeys(task.split("/")[1] for task in tasks)
    near = difflib.get_close_matches(task_id, names, n=2, cutoff=0.7)
    return [task for name in near for task in tasks if task.split("/")[1] == name][:3]


def _folders(tasks_dir: str | Path | None) -> list[Path]:
    installed = [folder for entry in entry_points() for folder in _installed(entry)]
    return [PACKAGED, *installed, *([Path(tasks_dir).resolve()] if tasks_dir else [])]


@cache
def entry_points() -> tuple[importlib.metadata.EntryPoint, ...]:
    """Return what installed distributions name; to look through all of them takes 20 ms."""
    return tuple(importlib.metadata.entry_points(group=ENTRY_POINT_GROUP))


def _installed(entry: importlib.metadata.EntryPoint) -> list[Path]:
    """Return the task folders of an installed package; warn if it is not there."""
    try:
        package = importlib.util.find_spec(entry.value)
    except ModuleNotFoundError:  # of the package that it would be in
        package = None
    if package is None:
        owner = entry.dist.name if entry.dist is not None else "some distribution"
        warnings.warn(
            f"{owner} names the package '{entry.value}' for tasks, which cannot be found: "
            f"its tasks are left out. Mend its entry point '{ENTRY_POINT_GROUP}'",
            stacklevel=2,
        )
        return []
    return [Path(location) for location in package.submodule_search_locations or ()]


@cache
def _packaged_modules() -> list[Path]:
    return _modules_in(PACKAGED)


def _modules_in(folder: Path) -> list[Path]:
    return [
        path
        for level in LEVELS
        for part in (f"level{level}", f"level{level}/{BEYOND}")
        for path in sorted((folder / part).glob("*.py"))
        if not path.stem.startswith("_")
    ]
