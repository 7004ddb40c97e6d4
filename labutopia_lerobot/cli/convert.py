"""`labutopia-convert EPISODES OUT`: the original's HDF5 episodes as a LeRobotDataset.

60 to 30 frames a second, camera_1, 2, 3 to front, top, wrist, one finger to the opening. An action
is the state that was measured next, not a command. The result cannot be replayed, and the
original's data are CC BY-NC 4.0.
"""

import argparse
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser


@clear_errors
def main() -> None:
    """Convert what the command line names."""
    parser = OptionParser(
        prog="labutopia-convert",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("source", type=Path, help="HDF5 file, or a folder of them")
    parser.add_argument("out", type=Path, help="folder of the new dataset")
    parser.add_argument("--repo-id", default="local/original", help="name of the dataset on a Hub")
    parser.add_argument("--instruction", help="for episodes that have none")
    arguments = parser.parse_args()
    from labutopia_lerobot.datasets.conversion import convert  # here: LeRobot brings torch

    with doing(Console(stderr=True), f"Converting {arguments.source}"):
        episodes = convert(
            arguments.source, arguments.out, arguments.repo_id, arguments.instruction
        )
    Console(highlight=False, soft_wrap=True).print(
        f"Converted {episodes} episodes into {arguments.out}: not replayable, CC BY-NC 4.0",
        markup=False,
    )


if __name__ == "__main__":
    main()
