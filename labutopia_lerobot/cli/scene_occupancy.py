"""`labutopia-scene occupancy ROOM --out DIR`: where in a room one can drive.

Writes ROOM_RESOLUTION.npz (cells; origin x, y and resolution [m]; the SHA-256 of the plan as
labutopia-scene writes it) and ROOM_RESOLUTION.png. Cells are 0 (free), 1 (occupied), -1 (beside the
floor); rows go north, columns east, from the room's south-west corner. The picture has north up:
white, black, grey.
"""

import argparse
import hashlib
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.errors import UserError


class NoFolderError(UserError):
    """A file where a folder is wanted."""


def add_occupancy(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `occupancy`; `run` of what it parses does it."""
    parser = commands.add_parser(
        "occupancy",
        help="map where in a room one can drive",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("room", help="name of a room, or a .json file")
    parser.add_argument(
        "--resolution",
        type=_resolution,
        default=0.05,
        metavar="METRES",
        help="width of a cell (default 0.05; the paper has 0.5)",
    )
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder to write to")
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> None:
    """Write the map of a room."""
    from labutopia_lerobot.navigation.occupancy import FREE  # here: they bring mujoco
    from labutopia_lerobot.scenes.plans import find_plan, text_of
    from labutopia_lerobot.scenes.room_map import room_map

    if arguments.out.suffix in (".npz", ".png"):
        raise NoFolderError(
            f"--out {arguments.out} is to be a folder: the files in it are named for the room"
        )
    plan = find_plan(arguments.room)
    occupancy = room_map(plan, arguments.resolution)
    arguments.out.mkdir(parents=True, exist_ok=True)
    stem = arguments.out / f"{plan.name}_{arguments.resolution:g}"
    data, picture = Path(f"{stem}.npz"), Path(f"{stem}.png")
    occupancy.save(data, hashlib.sha256(text_of(plan).encode()).hexdigest())
    picture.write_bytes(occupancy.png)
    rows, columns = occupancy.cells.shape
    free = (occupancy.cells == FREE).mean()
    Console(highlight=False, soft_wrap=True).print(
        f"{plan.name}: {rows} x {columns} cells, {free:.0%} free: {data}, {picture}", markup=False
    )


def _resolution(text: str) -> float:
    try:
        resolution = float(text)
    except ValueError:
        resolution = 0.0
    if not 0.01 <= resolution <= 2.0:
        raise argparse.ArgumentTypeError(f"{text} is no width of a cell: 0.01 to 2 m")
    return resolution
