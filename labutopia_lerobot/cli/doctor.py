"""`labutopia-doctor`: what is installed here, what draws, what is slow, and the cure of each.

Exits with 1 if something is missing without which nothing goes. How fast this machine is,
`labutopia-bench` measures.
"""

import argparse
import json
import sys

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.findings import GOOD, MISSING, OPTIONAL, SLOW, Finding, findings
from labutopia_lerobot.cli.grammar import OptionParser

_SIGNS = {GOOD: ("good", "green"), SLOW: ("SLOW", "yellow"), OPTIONAL: ("none", "cyan")}
_SIGNS |= {MISSING: ("MISSING", "red")}
"""How each state is shown, and in which colour."""


@clear_errors
def main() -> None:
    """Look at the machine, print a line for each thing, and exit with the verdict."""
    parser = OptionParser(
        prog="labutopia-doctor",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    arguments = parser.parse_args()
    with doing(Console(stderr=True), "Looking at this machine"):
        found = list(findings())
    missing = [each.about for each in found if each.state == MISSING]
    if arguments.json:
        rows = [each.row() for each in found]
        sys.stdout.write(json.dumps({"works": not missing, "findings": rows}, indent=2) + "\n")
    else:
        _print(found, missing)
    sys.exit(1 if missing else 0)


def _print(found: list[Finding], missing: list[str]) -> None:
    out = Console(highlight=False, soft_wrap=True)
    wide = max(len(each.about) for each in found)
    for each in found:
        sign, color = _SIGNS[each.state]
        out.print(f"{sign:7}", style=color, end="  ", markup=False)
        out.print(f"{each.about:{wide}}  {each.found}", markup=False)
        if each.cure:
            out.print(f"{'':7}  {'':{wide}}  {each.cure}", style="dim", markup=False)
    slow = [each.about for each in found if each.state == SLOW]
    out.print(
        f"Missing: {', '.join(missing)}"
        if missing
        else "Everything that is needed works" + (f"; slow: {', '.join(slow)}" if slow else ""),
        markup=False,
    )


if __name__ == "__main__":
    main()
