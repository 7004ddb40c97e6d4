"""`labutopia-report DIR...`: tables and a page of results, of unfinished ones too."""

import argparse
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.printing_tables import print_tables
from labutopia_lerobot.evaluation.found import find_results
from labutopia_lerobot.evaluation.reporting.entry import entries
from labutopia_lerobot.evaluation.reporting.levels import level_tables
from labutopia_lerobot.evaluation.reporting.outcomes import failure_table, precision_table
from labutopia_lerobot.evaluation.reporting.page import write_page
from labutopia_lerobot.evaluation.reporting.table import FORMATS


@clear_errors
def main() -> None:
    """Print the tables of all results below the folders, and write the page."""
    parser = argparse.ArgumentParser(prog="labutopia-report", description=__doc__)
    parser.add_argument(
        "places", type=Path, nargs="+", metavar="DIR", help="folder of results, or file of rows"
    )
    parser.add_argument("--tables", choices=FORMATS, default="text", help="how tables are printed")
    parser.add_argument(
        "--out", type=Path, help="the page; DIR/report.html of the first by default"
    )
    arguments = parser.parse_args()
    results = [result for place in arguments.places for result in find_results(place)]
    found = entries(results)
    tables = [*level_tables(found), failure_table(found), precision_table(found)]
    print_tables([table for table in tables if table.lines], arguments.tables)
    told = Console(stderr=True, soft_wrap=True, highlight=False)
    for result in results:
        if not result.finished:
            line = f"Unfinished: {result.place}, {len(result.rows)} episodes so far"
            told.print(line, markup=False)
    page = arguments.out or _beside(arguments.places[0])
    write_page(page, results)
    told.print(f"Wrote {page}", markup=False)


def _beside(place: Path) -> Path:
    return (place.parent if place.is_file() else place) / "report.html"


if __name__ == "__main__":
    main()
