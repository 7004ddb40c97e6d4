"""`labutopia-film TASK --out FILE.mp4`: a film of the expert, as one would show it to others.

1080p, edges smooth and shadows soft, from a camera that is near (`--camera beauty`) or from one of
the task's. The end of the file's name, .mp4, .webp or .gif, says what it becomes. The same command
gives the same bytes.
"""

import argparse
import math
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.bars import LogLines, counting_bars
from labutopia_lerobot.runtime.film import FilmWriter, require_film
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.setting import (
    FILAMENT,
    LARGEST_PICTURE,
    require_between,
    require_choices,
)
from labutopia_lerobot.sim.filming import BEAUTY, FILM_CAMERAS, FilmCamera
from labutopia_lerobot.sim.renderers import require_renderer
from labutopia_lerobot.world import CONTROL_HZ

_EXPOSURES = 8
"""Exposures of a picture by default: with fewer, one sees steps in shadows."""
_RATES = tuple(rate for rate in range(1, CONTROL_HZ + 1) if CONTROL_HZ % rate == 0)
"""Pictures per second that a film may have."""


class FilmOptionError(UserError):
    """An option with an impossible value; the message says which are possible."""


@clear_errors
def main(words: Sequence[str] | None = None) -> None:
    """Play one episode of the expert and film it.

    Args:
        words: The command line, without the program; that of the process by default.
    """
    arguments = _parser().parse_args(words)
    setting = setting_of_flags(arguments, arguments.task, obs="state")
    require_choices("camera", [arguments.camera], FILM_CAMERAS)
    require_choices("fps", [arguments.fps], _RATES)
    require_between("exposures", arguments.exposures, 1, 256)
    require_between("speed", arguments.speed, 1, CONTROL_HZ)
    require_between("seed", arguments.seed, 0, 2**31 - 1)
    require_film(arguments.out, setting.width, setting.height)
    require_renderer(setting.renderer)
    _make(arguments.out.parent)
    env = LabEnv(setting)
    with located_in_play(setting.task, setting.tasks_dir):
        _film(env, arguments)


def _parser() -> argparse.ArgumentParser:
    width, height = LARGEST_PICTURE
    parser = OptionParser(
        prog="labutopia-film",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("task", help="task id, such as level2/pour_liquid")
    parser.add_argument(
        "--out", type=Path, required=True, metavar="FILE", help="FILE.mp4, .webp or .gif"
    )
    parser.add_argument("--seed", type=int, default=0, help="of the episode (default: 0)")
    parser.add_argument(
        "--camera", default=BEAUTY, help=f"one of {', '.join(FILM_CAMERAS)} (default: {BEAUTY})"
    )
    parser.add_argument(
        "--exposures",
        type=int,
        default=_EXPOSURES,
        help=f"of how many a picture is the mean: 1 is quick and jagged (default: {_EXPOSURES})",
    )
    parser.add_argument(
        "--fps", type=int, default=CONTROL_HZ, help=f"pictures per second (default: {CONTROL_HZ})"
    )
    parser.add_argument("--speed", type=int, default=1, help="of the film, in times (default: 1)")
    add_setting_flags(
        parser,
        but=("obs", "cameras", "extras"),
        width=width,
        height=height,
        renderer=FILAMENT,
    )
    return parser


def _make(folder: Path) -> None:
    """Make a folder, before anything is played.

    Raises:
        FilmOptionError: If that cannot be.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FilmOptionError(
            f"--out: {folder} cannot be made a folder ({error.strerror}): choose another"
        ) from None


def _film(env: LabEnv, arguments: argparse.Namespace) -> None:
    """Write the film, and say what became of the episode."""
    setting, console = env.setting, Console(stderr=True)
    what = f"{setting.task}, seed {arguments.seed}"
    with doing(console, f"Setting up {what}"):
        env.reset(seed=arguments.seed)
    expert, progress = env.expert(), env.workcell.progress
    expert.start()
    size = setting.width, setting.height
    camera = FilmCamera(env.workcell, arguments.camera, size[0] / size[1], arguments.exposures)
    every = CONTROL_HZ * arguments.speed // arguments.fps
    most = math.ceil(env.workcell.task.max_steps / every) + 1
    with (
        FilmWriter(arguments.out, *size, arguments.fps) as film,
        counting_bars(console) as bars,
    ):
        bar, lines = bars.add_task("Filming, at most", total=most, note=""), LogLines(console)
        steps, drawn = 0, 0
        while True:
            if steps % every == 0 or progress.over:
                film.add(camera.picture())
                drawn += 1
                note = f"{env.workcell.world.time:.1f} s of the episode"
                bars.update(bar, advance=1, note=note)
                lines.write(f"Filmed {drawn} pictures, {note}")
            if progress.over:
                break
            env.step(expert.act())
            steps += 1
    env.close()
    Console(soft_wrap=True, highlight=False).print(
        f"{what}: {progress.outcome}. Wrote {arguments.out}: {drawn} pictures of "
        f"{size[0]} x {size[1]}",
        markup=False,
    )


if __name__ == "__main__":
    main()
