"""`labutopia-scene COMMAND`: what scenes are made of."""

import argparse

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.scene_export import add_export


@clear_errors
def main() -> None:
    """Do what the command line names."""
    parser = argparse.ArgumentParser(prog="labutopia-scene", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    add_export(commands)
    arguments = parser.parse_args()
    arguments.run(arguments)


if __name__ == "__main__":
    main()
