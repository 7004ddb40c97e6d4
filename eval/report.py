"""`python eval/report.py DIR`: one table of every result in a folder."""

import argparse
import json
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.result import RESULT
from labutopia_lerobot.evaluation.statistics import Summary
from labutopia_lerobot.evaluation.table import summary_table


@clear_errors
def main() -> None:
    """Print the summaries of all result files below the folder."""
    parser = argparse.ArgumentParser(prog="python eval/report.py", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR")
    folder: Path = parser.parse_args().folder
    files = sorted(folder.rglob(RESULT))
    if not files:
        raise UserError(f"{folder} holds no {RESULT}. Make one: python eval/run.py out={folder}")
    summaries = [
        Summary(**line) for file in files for line in json.loads(file.read_text())["summary"]
    ]
    summaries.sort(key=lambda summary: (summary.task, summary.split))
    Console().print(summary_table(summaries, level_means=False))


if __name__ == "__main__":
    main()
