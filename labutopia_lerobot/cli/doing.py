"""Progress of a program: a spinner in a terminal, a plain line in a log file."""

from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console


@contextmanager
def doing(console: Console, what: str) -> Iterator[None]:
    """Say what is going on while it goes on.

    Args:
        console: Where to; it knows whether it is a terminal.
        what: Name of the activity, such as "Playing level1/pick".
    """
    if console.is_terminal:
        with console.status(what):
            yield
    else:
        console.print(f"{what} ...", markup=False, highlight=False, soft_wrap=True)
        yield
