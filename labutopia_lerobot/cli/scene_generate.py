"""`labutopia-scene generate --family F --seed N --out DIR`: a new room.

Writes NAME.json (specification), NAME.xml with NAME_textures (MJCF) and NAME.png (picture). The
same family and seed give the same bytes.
"""

import argparse
from pathlib import Path

from rich.console import Console


def add_generate(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `generate`; `run` of what it parses does it."""
    parser = commands.add_parser(
        "generate",
        help="generate a room from a family and a seed",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--family", required=True, help="kind of laboratory, such as organic")
    parser.add_argument("--seed", type=_seed, default=0, help="draws all that is drawn (default 0)")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to write to")
    parser.add_argument("--name", help="of the room and its files (default: FAMILY_SEED)")
    parser.add_argument(
        "--size",
        type=float,
        nargs=2,
        metavar=("WIDTH", "DEPTH"),
        help="of the room [m], for families of one room (default: drawn)",
    )
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> None:
    """Generate, prove and write a room."""
    from labutopia_lerobot.export.room_export import write_room
    from labutopia_lerobot.scenes.families import family  # here: they bring mujoco
    from labutopia_lerobot.scenes.generation import generate
    from labutopia_lerobot.scenes.proof import proven

    size = tuple(arguments.size) if arguments.size else None
    plan = generate(family(arguments.family), arguments.seed, arguments.name, size)
    files = write_room(proven(plan, plan.name), arguments.out)
    console = Console(highlight=False, soft_wrap=True)
    width, depth, _ = plan.size
    console.print(
        f"{plan.name}: {width:g} x {depth:g} m, {len(plan.pieces)} pieces, "
        f"{len(plan.work_places)} work places: {', '.join(map(str, files))}",
        markup=False,
    )


def _seed(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text} is no seed: a whole number, 0 or more")
    return int(text)
