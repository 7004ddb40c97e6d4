"""`labutopia-check FOLDER`: does everything hold that must hold for a task, for those in a folder?

Each check is a line: a claim about the task, and what is so if it is not. A task takes a minute or
two, mostly for the expert's episodes. The exit status is 1 if any check fails.
"""

import argparse
import sys
import time
from collections.abc import Iterator
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


@clear_errors
def main() -> None:
    """Check every task of the folder that the command line names; exit with 1 if any fails."""
    parser = OptionParser(
        prog="labutopia-check",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", type=Path, help="task folder: it holds level1 ... level5")
    parser.add_argument("--task", metavar="ID", help="only this one, such as level1/mine")
    arguments = parser.parse_args()
    console = Console(highlight=False, soft_wrap=True)
    tasks = _tasks(arguments.folder, arguments.task)
    failed = 0
    for task in tasks:
        for check, reason in _outcomes(task, arguments.folder, console):
            failed += reason is not None
            word = "[green]pass[/]" if reason is None else "[red]FAIL[/]"
            console.print(
                f"{word}  {task}  {check}{'' if reason is None else f': {escape(reason)}'}"
            )
    checked = f"{len(tasks)} task{'s' * (len(tasks) != 1)} checked"
    console.print(f"{checked}; {failed or 'no'} check{'s' * (failed != 1)} failed")
    sys.exit(int(failed > 0))


def _tasks(folder: Path, only: str | None) -> list[str]:
    """Return the ids of the tasks to check.

    Raises:
        UnknownTaskError: If the folder holds no task, or not the one that is wanted.
    """
    files = task_files(folder)
    own = [task for task, path in files.items() if path.is_relative_to(folder.resolve())]
    if only is None:
        return own
    require_task(only, folder)
    if only not in own:
        raise UnknownTaskError(f"{folder} does not hold {only}. Tasks in it: {', '.join(own)}")
    return [only]


def _outcomes(task: str, folder: Path, console: Console) -> Iterator[tuple[str, str | None]]:
    """Yield every check of a task with what is wrong, or None, as soon as it is known."""
    made = "the_task_can_be_made"
    try:
        env = LabEnv(Setting(task, obs="state", particles=_PARTICLES, tasks_dir=str(folder)))
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
