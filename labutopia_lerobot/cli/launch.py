"""Starts a program: what it imports takes seconds, and Ctrl-C ends these in one line too.

Nothing heavy is imported here, as worker processes import it again.
"""

from collections.abc import Callable
from functools import partial
from importlib import import_module

from labutopia_lerobot.runtime.termination import ended_at_once

with ended_at_once():
    from labutopia_lerobot.cli.clear_errors import clear_errors

PROGRAMS = (
    "bench",
    "check",
    "chem",
    "compare",
    "convert",
    "cut",
    "doctor",
    "evaluate",
    "experiment",
    "film",
    "publish",
    "recipe",
    "record",
    "render",
    "replay",
    "report",
    "scene",
    "verify",
    "view",
)
"""Modules beside this one whose `main` is a program."""


@clear_errors
def launch(program: str) -> None:
    """Import one of the `PROGRAMS` and run it."""
    with ended_at_once():
        module = import_module(f"labutopia_lerobot.cli.{program}")
    module.main()


def __getattr__(program: str) -> Callable[[], None]:
    """Return what starts one of the `PROGRAMS`: `launch.record` is the program `record`."""
    if program not in PROGRAMS:
        raise AttributeError(f"There is no program '{program}'. Programs: {', '.join(PROGRAMS)}")
    return partial(launch, program)
