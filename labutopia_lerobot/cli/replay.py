"""`labutopia-replay DATASET`: play recorded actions again and compare the states."""

import argparse
import sys
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.datasets.replay import Replay, replay
from labutopia_lerobot.errors import UserError


class ReplayOptionError(UserError):
    """An option with an impossible value; the message says which are possible."""


@clear_errors
def main() -> None:
    """Replay the dataset that the command line names; exit with 1 if anything differs."""
    parser = argparse.ArgumentParser(prog="labutopia-replay", description=__doc__)
    parser.add_argument("dataset", type=Path, help="folder that labutopia-record made")
    parser.add_argument(
        "--episodes", type=int, metavar="N", help="only the first N episodes (default: all)"
    )
    arguments = parser.parse_args()
    if arguments.episodes is not None and arguments.episodes < 1:
        raise ReplayOptionError(f"--episodes {arguments.episodes} is too small: at least 1")
    console = Console(highlight=False, soft_wrap=True)
    replays = []
    for played in replay(arguments.dataset, arguments.episodes):
        console.print(_line(played), markup=False)
        replays.append(played)
    faithful = sum(played.faithful for played in replays)
    console.print(f"{faithful} of {len(replays)} succeeded again with bit-identical states")
    sys.exit(faithful < len(replays))


def _line(played: Replay) -> str:
    states = (
        "states bit-identical"
        if played.first_difference is None
        else f"states differ from frame {played.first_difference}"
    )
    return f"episode {played.episode}  seed {played.seed}  {played.outcome}  {states}"


if __name__ == "__main__":
    main()
