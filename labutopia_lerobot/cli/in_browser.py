"""Showing episodes in a browser: `--web`, `--port`, and the line that says where to look."""

import argparse
from collections.abc import Callable
from contextlib import suppress

from rich.console import Console

from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.setting import require_between
from labutopia_lerobot.web.episodes import Episodes
from labutopia_lerobot.web.server import served
from labutopia_lerobot.web.showing import Showing, Stage

WEB_SIZE = 960, 540
"""Width and height of the picture in a browser by default [pixels]."""
_PORT = 8080


def add_web_flags(parser: argparse.ArgumentParser) -> None:
    """Add `--web` and `--port`."""
    parser.add_argument(
        "--web", action="store_true", help="show it in a browser, on this machine only"
    )
    parser.add_argument(
        "--port", type=int, default=_PORT, help=f"of --web; 0 for any free (default: {_PORT})"
    )


def show_in_browser(episodes: Callable[[], Episodes], number: int, port: int, what: str) -> None:
    """Show episodes in browsers until somebody presses Ctrl-C.

    Args:
        episodes: Makes them, once the port is known to be free.
        number: Of the first one.
        port: Where; 0 for any that is free.
        what: Is shown, in a word.

    Raises:
        UserError: If the port cannot be had, or the first episode cannot be played.
    """
    require_between("port", port, 0, 65535)
    console, stage = Console(soft_wrap=True, highlight=False), Stage()
    with served(port, stage) as address:
        with doing(Console(stderr=True), f"Setting up {what}"):
            shown = episodes()
            stage.choices = shown.choices
            showing = Showing(shown, number, stage)
        here = address.removeprefix("http://")
        console.print(f"Open {address} in a browser on this machine. Ctrl-C ends it.", markup=False)
        console.print(
            f"From another machine: ssh -L {here.rpartition(':')[2]}:{here} THIS_MACHINE, then "
            "the same address there.",
            markup=False,
        )
        with suppress(KeyboardInterrupt):
            showing.run()
