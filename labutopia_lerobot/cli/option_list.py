"""The options of a program that takes `name=value`, as its `--help` lists them, and the tasks."""

import shutil
import textwrap
from collections.abc import Iterator
from dataclasses import MISSING, Field
from itertools import groupby
from typing import Any

from labutopia_lerobot.registry import is_beyond_paper, task_files
from labutopia_lerobot.setting import option_help, options_of

_WIDTH = 22
"""Columns of `name=default`; what is longer has its explanation on the next line."""
_WIDEST = 100
"""Columns that a line takes at most, however wide the terminal is."""


def option_list(options: type, *, prefix: str = "", but: tuple[str, ...] = ()) -> str:
    """Return one entry per field of a dataclass of options: name, default and explanation.

    Args:
        options: The dataclass; `option_help` explains every field.
        prefix: What the names begin with on the command line, such as `policy.`.
        but: Fields that are left out.
    """
    return "\n".join(_entries(options, prefix, but))


def _entries(options: type, prefix: str, but: tuple[str, ...]) -> Iterator[str]:
    helps = option_help(options)
    for option in options_of(options):
        if option.name in but:
            continue
        shown = f"{prefix}{option.name}={_default(option)}"
        if len(shown) >= _WIDTH:
            yield f"  {shown}"
            shown = ""
        yield _wrapped(f"  {shown:{_WIDTH}}", helps[option.name])


def task_list() -> str:
    """Return the names of all packaged tasks, the paper's first, a paragraph for each level."""
    lines = []
    for beyond, tasks in groupby(task_files(), key=is_beyond_paper):
        lines.append("Tasks beyond the paper:" if beyond else "Tasks of the paper:")
        for level, of_level in groupby(tasks, key=lambda task: task.partition("/")[0]):
            names = ", ".join(task.partition("/")[2] for task in of_level)
            lines.append(_wrapped(f"  {level}/  ", names))
    return "\n".join(lines)


def _wrapped(head: str, text: str) -> str:
    """Return a text behind a head, its further lines below its first."""
    return textwrap.fill(
        text,
        min(shutil.get_terminal_size().columns, _WIDEST),
        initial_indent=head,
        subsequent_indent=" " * len(head),
        break_long_words=False,
        break_on_hyphens=False,
    )


def _default(option: Field[Any]) -> str:
    """Return a default as it is typed; nothing where there is none, or it depends."""
    default = option.default if option.default is not MISSING else None
    if option.default_factory is not MISSING:
        default = option.default_factory()
    if isinstance(default, tuple):
        return f"[{','.join(default)}]"
    return "" if default in (None, "???") else str(default)
