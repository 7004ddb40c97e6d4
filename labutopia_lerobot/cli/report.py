"""`labutopia-report DIR...`: tables and a page of results, of unfinished ones too."""

from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.in_browser import add_web_flags, serve_to_browser
from labutopia_lerobot.cli.printing_tables import print_tables
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.reporting.page import write_page
from labutopia_lerobot.evaluation.reporting.report_entry import report_entries
from labutopia_lerobot.evaluation.reporting.result_tables import (
    failure_table,
    level_tables,
    precision_table,
)
from labutopia_lerobot.evaluation.reporting.table import FORMATS
from labutopia_lerobot.web.results_site import ResultsSite


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
    add_web_flags(parser)
    arguments = parser.parse_args()
    results = _load(arguments.places)
    entries = report_entries(results)
    tables = [*level_tables(entries), failure_table(entries), precision_table(entries)]
    print_tables([table for table in tables if table.lines], arguments.tables)
    console = Console(stderr=True, soft_wrap=True, highlight=False)
    for result in results:
        if not result.finished:
            line = f"Unfinished: {result.place}, {len(result.rows)} episodes so far"
            console.print(line, markup=False)
    if arguments.web:
        serve_to_browser(ResultsSite(lambda: _load(arguments.places)), arguments.port)
        return
    page = arguments.out or _beside(arguments.places[0])
    write_page(page, results)
    console.print(f"Wrote {page}", markup=False)


def _load(places: Sequence[Path]) -> list[LoadedResult]:
    """Return the results in some places.

    Raises:
        NothingToReportError: If no episode of them is finished.
        UnreadableResultError: If one is damaged.
    """
    results = [result for place in places for result in load_results(place)]
    if not any(result.rows for result in results):
        raise NothingToReportError(
            f"No episode is finished yet in {', '.join(str(result.place) for result in results)}. "
            "Let the evaluation play on: its command goes on where it was"
        )
    return results


def _beside(place: Path) -> Path:
    return (place.parent if place.is_file() else place) / "report.html"


if __name__ == "__main__":
    main()
