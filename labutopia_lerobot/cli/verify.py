"""`labutopia-verify DATASET`: is a dataset whole, and is it what the environment does?

Exit status 1 for faults only: what could not be checked, such as after an edit with LeRobot's
tools, is reported and is no fault.
"""

import argparse
import os
import sys
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.setting_flags import add_own_files
from labutopia_lerobot.datasets.dataset_folder import dataset_folder
from labutopia_lerobot.datasets.description import read_info
from labutopia_lerobot.datasets.verification.environment import ALL
from labutopia_lerobot.datasets.verify import PICTURES, verify
from labutopia_lerobot.scenario.own_files import OwnFiles


@clear_errors
def main() -> None:
    """Verify the dataset that the command line names."""
    parser = OptionParser(prog="labutopia-verify", description=__doc__)
    parser.add_argument("dataset", type=dataset_folder, help="folder of a LeRobotDataset v3")
    parser.add_argument(
        "--pictures",
        type=_pictures,
        default=PICTURES,
        metavar="N",
        help="how many frames of each episode to draw again and compare, or 'all' "
        f"(default: {PICTURES})",
    )
    parser.add_argument(
        "--workers",
        type=_workers,
        default=len(os.sched_getaffinity(0)),
        metavar="N",
        help="processes that play episodes again (default: one per processor)",
    )
    add_own_files(parser)
    parser.add_argument(
        "--tasks-dir", metavar="DIR", help="a folder of tasks of your own, whose files you trust"
    )
    arguments = parser.parse_args()
    root: Path = arguments.dataset
    with doing(Console(stderr=True), f"Verifying {root}"):
        verdict = verify(
            root,
            arguments.pictures,
            arguments.tasks_dir,
            arguments.workers,
            OwnFiles(arguments.room, arguments.reasoner),
        )
    console = Console(highlight=False, soft_wrap=True)
    for text in verdict.faults:
        console.print(f"Fault: {text}", markup=False)
    for text in verdict.unchecked:
        console.print(f"Not checked: {text}", markup=False)
    if verdict.faults:
        console.print(f"{root} has {len(verdict.faults)} faults", markup=False)
        sys.exit(1)
    info = read_info(root)
    finding = "has no fault in what was checked" if verdict.unchecked else "is intact"
    videos = sum(feature["dtype"] == "video" for feature in info["features"].values())
    console.print(
        f"{root} {finding}: {info['total_episodes']} episodes, {info['total_frames']} frames, "
        f"{videos} cameras",
        markup=False,
    )


def _pictures(text: str) -> int:
    number = ALL if text == "all" else int(text)
    if number < ALL or (number == ALL and text != "all"):
        raise argparse.ArgumentTypeError(f"{text} is no number of frames: 0 or more, or 'all'")
    return number


def _workers(text: str) -> int:
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} is no number of processes: 1 or more")
    return number


if __name__ == "__main__":
    main()
