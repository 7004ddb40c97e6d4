"""Tables on the standard output, whether that is a terminal or a file."""

from collections.abc import Iterable

from rich.console import Console

from labutopia_lerobot.evaluation.reporting.table import FORMATS, Table

_FILE_WIDTH = 120
"""Characters of a line where nobody knows how wide the terminal is."""


def print_tables(tables: Iterable[Table], form: str) -> None:
    """Print tables in one of the `FORMATS`."""
    out = Console(highlight=False, soft_wrap=form != "text")
    if not out.is_terminal:
        out.width = _FILE_WIDTH
    for table in tables:
        out.print(FORMATS[form](table), markup=False)
