"""`labutopia-report DIR...`: tables and a page of results, of unfinished ones too."""

from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.printing_tables import print_tables
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.load_results import load_results
from labutopia_lerobot.evaluation.reporting.page import write_page
from labutopia_lerobot.evaluation.reporting.report_entry import report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import (
    failure_table,
    level_tables,
    precision_table,
)
from labutopia_lerobot.evaluation.reporting.table import FORMATS


class NothingToReportError(UserError):
    """Results without an episode; the message says which."""


@clear_errors
def main() -> None:
    """Print the tables of all results below the folders, and write the page."""
    parser = OptionParser(prog="labutopia-report", description=__doc__)
    parser.add_argument(
        "places", type=Path, nargs="+", metavar="DIR", help="folder of results, or file of rows"
    )
    parser.add_argument("--tables", choices=FORMATS, default="text", help="how tables are printed")
    parser.add_argument(
        "--out", type=Path, help="the page; DIR/report.html of the first by default"
    )
    arguments = parser.parse_args()
    results = [result for place in arguments.places for result in load_results(place)]
    entries = report_entries(results)
    if not entries:
        raise NothingToReportError(
            f"No episode is finished yet in {', '.join(str(result.place) for result in results)}. "
            "Let the evaluation play on: its command goes on where it was"
        )
    tables = [*level_tables(entries), failure_table(entries), precision_table(entries)]
    print_tables([table for table in tables if table.lines], arguments.tables)
    console = Console(stderr=True, soft_wrap=True, highlight=False)
    for result in results:
        if not result.finished:
            line = f"Unfinished: {result.place}, {len(result.rows)} episodes so far"
            console.print(line, markup=False)
    page = arguments.out or _beside(arguments.places[0])
    write_page(page, results)
    console.print(f"Wrote {page}", markup=False)


def _beside(place: Path) -> Path:
    return (place.parent if place.is_file() else place) / "report.html"


if __name__ == "__main__":
    main()
