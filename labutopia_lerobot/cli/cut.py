"""`labutopia-cut DATASET`: whole demonstrations as those of their steps, a dataset for each.

A policy per step (`play=staged`) learns from them, and the same recording serves a policy that
plays the whole task.
"""

import argparse
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.datasets.dataset_folder import dataset_folder
from labutopia_lerobot.errors import UserError


class CutOptionError(UserError):
    """Options that contradict each other; the message says how."""


@clear_errors
def main() -> None:
    """Cut the dataset that the command line names."""
    parser = OptionParser(
        prog="labutopia-cut",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("dataset", type=dataset_folder, help="folder that labutopia-record made")
    parser.add_argument("--step", metavar="NAME", help="one step, such as 3_place (default: all)")
    parser.add_argument(
        "--out",
        type=Path,
        metavar="DIR",
        help="folder of the new dataset, with --step (default: <dataset>-<step>)",
    )
    parser.add_argument(
        "--tasks-dir", metavar="DIR", help="a folder of tasks of your own, whose files you trust"
    )
    arguments = parser.parse_args()
    root: Path = arguments.dataset
    if arguments.out is not None and arguments.step is None:
        raise CutOptionError("--out is the folder of one step: name it with --step")
    from labutopia_lerobot.datasets.cutting import (  # here: LeRobot brings torch
        NothingOfStepError,
        cut,
        steps_of,
    )

    steps = [arguments.step] if arguments.step else steps_of(root, arguments.tasks_dir)
    console = Console(highlight=False, soft_wrap=True)
    for step in steps:
        out = arguments.out or root.with_name(f"{root.name}-{step}")
        try:
            with doing(Console(stderr=True), f"Cutting {step} out of {root}"):
                episodes = cut(root, step, out, arguments.tasks_dir)
        except NothingOfStepError as error:
            if arguments.step:
                raise
            console.print(str(error), markup=False)
            continue
        console.print(f"{out}: {episodes} episodes of {step}", markup=False)


if __name__ == "__main__":
    main()
