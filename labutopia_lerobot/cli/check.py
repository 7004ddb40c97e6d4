"""`labutopia-check FOLDER`, or `TASK`: does everything hold that must hold for a task, or for each?

Each check is a line: a claim about the task, and what is so if it is not. A task takes a minute or
two, mostly for the expert's episodes. The exit status is 1 if any check fails.
"""

import argparse
import re
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from labutopia_lerobot.checks import CHECKS, Check, CheckFailed
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.registry import UnknownTaskError, require_task, task_files
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.setting import Setting

_PARTICLES = 300
"""A third of the usual ones: enough for everything but the rate of success."""

_TASK = re.compile(r"level\d+/\w+")
"""What a task looks like, and seldom a folder."""


class CheckOptionError(UserError):
    """Words that do not say what to check; the message says how to say it."""


@clear_errors
def main() -> None:
    """Check what the command line names, a folder or tasks; exit with 1 if any fails."""
    parser = OptionParser(
        prog="labutopia-check",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "words",
        nargs="*",
        metavar="folder|task",
        help="task folder, which holds level1 ... level5; or a task, such as level1/pick",
    )
    parser.add_argument("--task", metavar="ID", help="only this one, such as level1/mine")
    parser.add_argument("--tasks-dir", metavar="DIR", help="task folder, whatever it is called")
    arguments = parser.parse_args()
    console = Console(highlight=False, soft_wrap=True)
    folder, named = _named(arguments.words, arguments.tasks_dir)
    named += [] if arguments.task is None else [arguments.task]
    tasks = _tasks(folder, named)
    failed = 0
    for task in tasks:
        for check, reason in _outcomes(task, folder, console):
            failed += reason is not None
            word = "[green]pass[/]" if reason is None else "[red]FAIL[/]"
            console.print(
                f"{word}  {task}  {check}{'' if reason is None else f': {escape(reason)}'}"
            )
    checked = f"{len(tasks)} task{'s' * (len(tasks) != 1)} checked"
    console.print(f"{checked}; {failed or 'no'} check{'s' * (failed != 1)} failed")
    sys.exit(int(failed > 0))


def _named(words: Sequence[str], tasks_dir: str | None) -> tuple[str | None, list[str]]:
    """Return the folder, if one is named, and the tasks, distinguished by their form.

    Raises:
        CheckOptionError: If two folders are named, or a word is both a folder and a task.
        UnknownTaskError: If the folder holds no task.
    """
    folders = [] if tasks_dir is None else [tasks_dir]
    folders += [word for word in words if not _TASK.fullmatch(word)]
    tasks: list[str] = []
    for word in filter(_TASK.fullmatch, words):
        if not Path(word).is_dir():
            tasks.append(word)
        elif word not in task_files(folders[0] if folders else None):
            folders.append(word)
        else:
            raise CheckOptionError(
                f"'{word}' is a task, and a folder here: say task={word} or tasks_dir={word}"
            )
    if len(folders) > 1:
        raise CheckOptionError(f"{' and '.join(folders)} are two folders: check one at a time")
    return (folders[0] if folders else None), tasks


def _tasks(folder: str | None, named: Sequence[str]) -> list[str]:
    """Return the ids of the tasks to check.

    Raises:
        CheckOptionError: If neither a folder nor a task is named.
        UnknownTaskError: If the folder holds no task, or not those that are wanted.
    """
    if folder is None and not named:
        raise CheckOptionError("Name a folder of tasks, or a task, such as level1/pick")
    files = task_files(folder)
    for task in named:
        require_task(task, folder)
    tasks = list(dict.fromkeys(named))
    if folder is None:
        return tasks
    own = [task for task, path in files.items() if path.is_relative_to(Path(folder).resolve())]
    for task in tasks:
        if task not in own:
            raise UnknownTaskError(f"{folder} does not hold {task}. Tasks in it: {', '.join(own)}")
    return tasks or own


def _outcomes(task: str, folder: str | None, console: Console) -> Iterator[tuple[str, str | None]]:
    """Yield every check of a task with what is wrong, or None, as soon as it is known."""
    made = "the_task_can_be_made"
    try:
        env = LabEnv(Setting(task, obs="state", particles=_PARTICLES, tasks_dir=folder))
    except Exception as error:  # a task file can raise anything
        yield _claim(made), _reason(error)
        return
    yield _claim(made), None
    for check in CHECKS:
        start = time.monotonic()
        with console.status(f"{task}: {_claim(check.__name__)}"):
            reason = _wrong(check, env)
        yield f"{_claim(check.__name__)} ({time.monotonic() - start:.0f} s)", reason
    env.close()


def _wrong(check: Check, env: LabEnv) -> str | None:
    """Return what is wrong, or None if the check passes."""
    try:
        with located_in_play(env.setting.task, env.setting.tasks_dir):
            check(env)
    except Exception as error:  # what a user's predicate raises fails the check, not the others
        return _reason(error)
    return None


def _reason(error: Exception) -> str:
    if isinstance(error, CheckFailed | UserError):
        return str(error)
    return f"{type(error).__name__}: {error}"


def _claim(name: str) -> str:
    return name.replace("_", " ")


if __name__ == "__main__":
    main()
