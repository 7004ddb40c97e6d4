"""Bars that count in a terminal, and lines in a log file."""

import time

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeRemainingColumn,
)

_LOG_S = 10.0
"""Time between two lines in a log file [s]."""


def counting_bars(console: Console) -> Progress:
    """Return bars with what is counted, how much of it, time left and a note; none in a log file.

    Args:
        console: Where to; it knows whether it is a terminal. Every bar needs a field `note`.
    """
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[note]}"),
        console=console,
        disable=not console.is_terminal,
    )


class LogLines:
    """Lines where no bars can be drawn, one every ten seconds.

    Args:
        console: Where to.
    """

    def __init__(self, console: Console) -> None:
        self._console = console
        self._last = time.monotonic()

    def write(self, line: str, *, at_once: bool = False) -> None:
        """Write a line, if it is time or must be at once."""
        due = at_once or time.monotonic() - self._last >= _LOG_S
        if self._console.is_terminal or not due:
            return
        self._last = time.monotonic()
        self._console.print(line, markup=False, highlight=False, soft_wrap=True)
