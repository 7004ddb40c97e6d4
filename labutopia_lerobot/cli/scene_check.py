"""`labutopia-scene check ROOM...`: can one work in these rooms?

Nothing overlaps, all opens over its whole range, a robot of 0.6 m gets to everything. Exit status 1
if a room has faults; they are named.
"""

import argparse
import sys

from rich.console import Console


def add_check(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `check`; `run` of what it parses does it."""
    parser = commands.add_parser(
        "check",
        help="prove that rooms can be worked in",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("rooms", nargs="+", metavar="ROOM", help="name of a room, or a .json file")
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> None:
    """Print the faults of every room."""
    from labutopia_lerobot.scenes.plans import find_plan  # here: they bring mujoco
    from labutopia_lerobot.scenes.proof import faults

    console, faulty = Console(highlight=False, soft_wrap=True), 0
    for room in arguments.rooms:
        plan = find_plan(room)
        problems = faults(plan)
        for fault in problems:
            console.print(f"Fault: {room}: {fault}", markup=False)
        if not problems:
            summary = f"{len(plan.pieces)} pieces, {len(plan.work_places)} work places"
            console.print(f"{room} is proven: {summary}", markup=False)
        faulty += bool(problems)
    if faulty:
        console.print(f"{faulty} of {len(arguments.rooms)} rooms have faults", markup=False)
        sys.exit(1)
