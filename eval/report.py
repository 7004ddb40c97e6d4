"""`python eval/report.py DIR`: one table of every result in a folder, unfinished ones too."""

import argparse
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.evaluation.found import find_results
from labutopia_lerobot.evaluation.table import summary_table


@clear_errors
def main() -> None:
    """Print the summaries of all results below the folder."""
    parser = argparse.ArgumentParser(prog="python eval/report.py", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR")
    results = find_results(parser.parse_args().folder)
    summaries = [summary for result in results for summary in result.summaries]
    summaries.sort(key=lambda summary: (summary.task, summary.split))
    console = Console()
    console.print(summary_table(summaries, level_means=False))
    for result in results:
        if not result.finished:
            played = sum(summary.n for summary in result.summaries)
            line = f"Unfinished: {result.folder}, {played} episodes so far"
            console.print(line, soft_wrap=True, markup=False, highlight=False)


if __name__ == "__main__":
    main()
