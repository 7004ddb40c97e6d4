"""`labutopia-replay DATASET --episode 3`: look at a recorded episode, played from its seed.

In a window, as an MP4 (`--out FILE.mp4`), as a Rerun recording (`--out FILE.rrd`) with states,
actions, facts and liquid, or in a browser (`--web`), where the other episodes can be chosen too.
Without `--episode` and `--web` nothing is shown: every episode is played again and its frames are
compared with the recorded ones.
"""

import argparse
import sys
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Self

import pyarrow as pa
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.in_browser import WEB_SIZE, add_web_flags, show_in_browser
from labutopia_lerobot.cli.setting_flags import add_own_files
from labutopia_lerobot.datasets.dataset_folder import dataset_folder
from labutopia_lerobot.datasets.looking import Film, Look, find_episode, look_at
from labutopia_lerobot.datasets.playback import Playback
from labutopia_lerobot.datasets.replay import Replay, replay
from labutopia_lerobot.datasets.rerun_recording import RerunRecording
from labutopia_lerobot.datasets.tables import SEED
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import CAMERAS, require_choices
from labutopia_lerobot.sim.viewer import Viewer, has_display
from labutopia_lerobot.web.recorded_episodes import RecordedEpisodes

_SIZE = 512, 512
"""Width and height of a picture by default [pixels]: more than policies see."""


class ReplayOptionError(UserError):
    """An option with an impossible value; the message says which are possible."""


@clear_errors
def main() -> None:
    """Show an episode, or compare them all; exit with 1 if anything differs."""
    parser = OptionParser(
        prog="labutopia-replay",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("dataset", type=dataset_folder, help="folder that labutopia-record made")
    parser.add_argument("--episode", type=int, metavar="N", help="number of the episode to show")
    parser.add_argument("--out", type=Path, metavar="FILE", help="FILE.mp4 or FILE.rrd to write")
    parser.add_argument(
        "--cameras", nargs="+", default=list(CAMERAS), help="which are drawn into the file"
    )
    add_web_flags(parser)
    shown = f"(default: {_SIZE[0]}; with --web {' x '.join(map(str, WEB_SIZE))})"
    parser.add_argument("--width", type=int, help=f"of a picture [pixels] {shown}")
    parser.add_argument("--height", type=int, help="likewise")
    parser.add_argument(
        "--episodes", type=int, metavar="N", help="compare only the first N (default: all)"
    )
    add_own_files(parser)
    parser.add_argument(
        "--tasks-dir", metavar="DIR", help="a folder of tasks of your own, whose files you trust"
    )
    arguments = parser.parse_args()
    width, height = WEB_SIZE if arguments.web else _SIZE
    arguments.width = width if arguments.width is None else arguments.width
    arguments.height = height if arguments.height is None else arguments.height
    if arguments.web:
        _show_in_browser(arguments)
        return
    if arguments.episode is not None:
        _show(arguments)
        return
    if arguments.episodes is not None and arguments.episodes < 1:
        raise ReplayOptionError(f"--episodes {arguments.episodes} is too small: at least 1")
    if arguments.out is not None:
        raise ReplayOptionError("--out shows one episode: name it with --episode N")
    _compare(arguments.dataset, arguments.episodes, arguments.tasks_dir)


def _show_in_browser(arguments: argparse.Namespace) -> None:
    if arguments.out is not None:
        raise ReplayOptionError("--out writes a file and --web shows episodes: choose one of them")
    root, first, tasks_dir = arguments.dataset, arguments.episode or 0, arguments.tasks_dir
    size = arguments.width, arguments.height
    episodes = partial(RecordedEpisodes, root, first, *size, tasks_dir)
    show_in_browser(episodes, first, arguments.port, str(root))


def _show(arguments: argparse.Namespace) -> None:
    require_choices("cameras", arguments.cameras, CAMERAS)
    row, frames = find_episode(arguments.dataset, arguments.episode, arguments.tasks_dir)
    what = f"episode {arguments.episode}, seed {row[SEED]}"
    with _look(arguments, frames) as look, doing(Console(stderr=True), f"Playing {what}"):
        played = look_at(row, frames, look, arguments.width, arguments.height, arguments.tasks_dir)
    wrote = f". Wrote {arguments.out}" if arguments.out else ""
    Console(highlight=False, soft_wrap=True).print(
        f"{what}: {played.outcome}, {_difference(played)}{wrote}", markup=False
    )


def _look(arguments: argparse.Namespace, frames: pa.Table) -> AbstractContextManager[Look]:
    out: Path | None = arguments.out
    if out is None:
        if not has_display():
            raise ReplayOptionError(
                "There is no display here: give --web, or --out FILE.mp4 or FILE.rrd"
            )
        return Window()
    if out.suffix == ".mp4":
        return Film(out, arguments.cameras, arguments.width, arguments.height)
    if out.suffix == ".rrd":
        return RerunRecording(out, frames, arguments.cameras)
    raise ReplayOptionError(f"--out {out} is neither FILE.mp4 nor FILE.rrd")


class Window:
    """A `Look` through MuJoCo's window, at real time; a context manager that closes it."""

    def __init__(self) -> None:
        self._viewer: Viewer | None = None

    def __call__(self, number: int, env: LabEnv) -> None:
        """Show a frame, unless somebody has closed the window."""
        if self._viewer is None:
            self._viewer = Viewer(env.workcell.simulation, env.workcell.world.bench_height)
        if self._viewer.is_open:
            self._viewer.show()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._viewer is not None:
            self._viewer.__exit__(kind, error, trace)


def _difference(played: Playback) -> str:
    if played.difference is None:
        return "bit-identical to the recording"
    return f"differs from frame {played.difference.frame} in {played.difference.key}"


def _compare(root: Path, episodes: int | None, tasks_dir: str | None) -> None:
    console = Console(highlight=False, soft_wrap=True)
    replays = []
    for played in replay(root, episodes, tasks_dir):
        console.print(_line(played), markup=False)
        replays.append(played)
    faithful = sum(played.faithful for played in replays)
    console.print(
        f"{faithful} of {len(replays)} ended as they were recorded, with bit-identical states"
    )
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
