"""Tables on the standard output, whether that is a terminal or a file."""

from collections.abc import Iterable

from rich.console import Console

from labutopia_lerobot.evaluation.reporting.table import FORMATS, Table


def print_tables(tables: Iterable[Table], form: str) -> None:
    """Print tables in one of the `FORMATS`."""
    out = Console(highlight=False, soft_wrap=form != "text")
    for table in tables:
        out.print(FORMATS[form](table), markup=False)
        out.print()
