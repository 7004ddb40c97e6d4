"""Showing something in a browser: `--web`, `--port`, and the line that says where to look."""

import argparse
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from rich.console import Console

from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.setting import require_between
from labutopia_lerobot.web.episodes import Episodes
from labutopia_lerobot.web.episodes_site import EpisodesSite
from labutopia_lerobot.web.server import Site, served
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
    stage = Stage()
    with _announced(EpisodesSite(stage), port) as announce:
        with doing(Console(stderr=True), f"Setting up {what}"):
            shown = episodes()
            stage.choices = shown.choices
            showing = Showing(shown, number, stage)
        announce()
        showing.run()


def serve_to_browser(site: Site, port: int) -> None:
    """Serve a site to browsers until somebody presses Ctrl-C.

    Raises:
        UserError: If the port cannot be had.
    """
    with _announced(site, port) as announce:
        announce()
        threading.Event().wait()


@contextmanager
def _announced(site: Site, port: int) -> Iterator[Callable[[], None]]:
    """Serve a site until Ctrl-C, and yield what says where to look."""
    require_between("port", port, 0, 65535)

    def announce() -> None:
        here = address.removeprefix("http://")
        lines = (
            f"Open {address} in a browser on this machine. Ctrl-C ends it.",
            f"From another machine: ssh -L {here.rpartition(':')[2]}:{here} THIS_MACHINE, then "
            "the same address there.",
        )
        console = Console(soft_wrap=True, highlight=False)
        for line in lines:
            console.print(line, markup=False)

    with served(port, site) as address, suppress(KeyboardInterrupt):
        yield announce
