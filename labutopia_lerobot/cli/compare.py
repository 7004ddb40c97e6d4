"""`labutopia-compare DIR_A DIR_B`: which of two policies is better, on common seeds."""

import json
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.printing_tables import print_tables
from labutopia_lerobot.evaluation.compare import compare, comparison_table
from labutopia_lerobot.evaluation.load_results import LoadedResult, load_results
from labutopia_lerobot.evaluation.reporting.table import FORMATS


@clear_errors
def main() -> None:
    """Compare the results that the command line names."""
    parser = OptionParser(prog="labutopia-compare", description=__doc__)
    for name in ("first", "second"):
        parser.add_argument(name, type=Path, help="folder of results of one policy")
    parser.add_argument(
        "--tables", choices=FORMATS, default="text", help="how the table is printed"
    )
    parser.add_argument("--json", action="store_true", help="print everything as JSON instead")
    arguments = parser.parse_args()
    places = (arguments.first, arguments.second)
    first, second = (load_results(place) for place in places)
    comparisons = compare(first, second)
    if arguments.json:
        places_of = {"first": str(places[0]), "second": str(places[1])}
        content = places_of | {"comparisons": [comparison.columns for comparison in comparisons]}
        json.dump(content, sys.stdout, indent=1)
        sys.stdout.write("\n")
        return
    names = (_played(first), _played(second))
    if names[0] == names[1]:
        names = (places[0].name, places[1].name)
    if names[0] == names[1]:  # heads of a CSV file may be long
        names = (str(places[0]), str(places[1])) if arguments.tables == "csv" else ("A", "B")
    table = comparison_table(comparisons, names)
    which = f"{names[0]}: {places[0]}, {names[1]}: {places[1]}. "
    print_tables([replace(table, note=which + table.note)], arguments.tables)


def _played(results: Sequence[LoadedResult]) -> str:
    """Return the policies that were played."""
    return ", ".join(dict.fromkeys(row.policy for result in results for row in result.rows))


if __name__ == "__main__":
    main()
