"""`labutopia-scene COMMAND`: what scenes are made of."""

import argparse

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.scene_check import add_check
from labutopia_lerobot.cli.scene_export import add_export
from labutopia_lerobot.cli.scene_generate import add_generate
from labutopia_lerobot.cli.scene_list import add_list
from labutopia_lerobot.cli.scene_occupancy import add_occupancy

_COMMANDS = (add_list, add_generate, add_check, add_occupancy, add_export)


@clear_errors
def main() -> None:
    """Do what the command line names."""
    parser: argparse.ArgumentParser = OptionParser(prog="labutopia-scene", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for add in _COMMANDS:
        add(commands)
    arguments = parser.parse_args()
    arguments.run(arguments)


if __name__ == "__main__":
    main()
