"""`labutopia-scene export WHAT --out FILE`: a piece, a room or the start of a task for others."""

import argparse
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.doing import doing

_ABOUT = """Write an instrument, a piece of ware, a room or the start of a task as a file.

FILE.usda and FILE.usdc are OpenUSD with UsdPhysics and need the extra `usd`; FILE.xml is MJCF,
which MuJoCo's viewer opens. Textures go into FILE_textures. The file is opened again and compared.
"""


def add_export(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command `export`; `run` of what it parses does it."""
    parser = commands.add_parser(
        "export",
        help="write a piece, a room or a task as OpenUSD or MJCF",
        description=_ABOUT,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("what", help="such as centrifuge, beaker_low, laboratory or level1/pick")
    parser.add_argument(
        "--out", type=Path, required=True, help="file that ends on .usda, .usdc or .xml"
    )
    parser.add_argument("--size", help='of ware that comes in several, such as "250 ml"')
    parser.add_argument("--seed", type=int, default=0, help="of the episode, for a task (0)")
    parser.set_defaults(run=_run)


def _run(arguments: argparse.Namespace) -> None:
    from labutopia_lerobot.export import export, find_subject, require_writable

    require_writable(arguments.out)
    with doing(Console(stderr=True), f"Exporting {arguments.what}"):
        summary = export(
            find_subject(arguments.what, arguments.size, arguments.seed), arguments.out
        )
    Console(highlight=False, soft_wrap=True).print(
        f"{arguments.out}: {summary.drawn} shapes to see, {summary.touched} to touch, "
        f"{summary.moving} moving bodies of {summary.mass:.3f} kg, {len(summary.limits)} joints; "
        "opened again, the same",
        markup=False,
    )
