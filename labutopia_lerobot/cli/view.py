"""`labutopia-view TASK`: look at the expert doing a task: a window, a browser (`--web`), files."""

from functools import partial
from pathlib import Path

import numpy as np
from PIL import Image
from rich.console import Console

from labutopia_lerobot.checks.why import why_failed
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.in_browser import WEB_SIZE, add_web_flags, show_in_browser
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.video import require_filmable, write_video
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.sim.renderers import require_renderer
from labutopia_lerobot.sim.viewer import Viewer, has_display
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.web.episodes import ExpertEpisodes

_SIZE = 512, 512
"""Width and height of a picture by default [pixels]: more than policies see."""


class ViewOptionError(UserError):
    """An option with an impossible value; the message says which are possible."""


@clear_errors
def main() -> None:
    """Open the viewer where there is a display, else write `TASK.png` and `TASK.mp4`; or serve."""
    parser = OptionParser(prog="labutopia-view", description=__doc__)
    parser.add_argument("task", help="task id, such as level1/pick")
    parser.add_argument("--seed", type=int, default=0, help="of the first episode (default: 0)")
    parser.add_argument(
        "--out", type=Path, default=Path(), help="folder for the files (default: this one)"
    )
    parser.add_argument("--headless", action="store_true", help="write files even with a display")
    add_web_flags(parser)
    shown = f"(default: {_SIZE[0]}; with --web {' x '.join(map(str, WEB_SIZE))})"
    parser.add_argument("--width", type=int, help=f"of the pictures [pixels] {shown}")
    parser.add_argument("--height", type=int, help="likewise")
    add_setting_flags(parser, but=("width", "height"))
    arguments = parser.parse_args()
    width, height = WEB_SIZE if arguments.web else _SIZE
    arguments.width = width if arguments.width is None else arguments.width
    arguments.height = height if arguments.height is None else arguments.height
    headless = arguments.headless or not has_display()
    obs = "pixels" if headless and not arguments.web else "state"
    setting = setting_of_flags(arguments, arguments.task, obs=obs)
    require_filmable(setting.width, setting.height)
    if arguments.seed < 0:
        raise ViewOptionError(f"--seed {arguments.seed} is too small: seeds begin at 0")
    with located_in_play(setting.task, setting.tasks_dir):
        if arguments.web:
            require_renderer(setting.renderer)
            episodes = partial(ExpertEpisodes, setting)
            show_in_browser(episodes, arguments.seed, arguments.port, setting.task)
        elif headless:
            _write_files(LabEnv(setting), arguments.seed, arguments.out)
        else:
            _open_viewer(LabEnv(setting), arguments.seed)


def _write_files(env: LabEnv, seed: int, folder: Path) -> None:
    """Write the first picture above the last, and the whole episode; cameras side by side."""
    _make(folder)
    with doing(Console(stderr=True), f"Playing {env.setting.task}, seed {seed}"):
        observation, _ = env.reset(seed=seed)
        expert = env.expert()
        expert.start()
        frames = [np.hstack(list(observation["pixels"].values()))]
        over = False
        while not over:
            observation, _, terminated, truncated, _ = env.step(expert.act())
            frames.append(np.hstack(list(observation["pixels"].values())))
            over = terminated or truncated
    stem = folder / env.setting.task.replace("/", "-")
    Image.fromarray(np.vstack([frames[0], frames[-1]])).save(stem.with_suffix(".png"))
    write_video(stem.with_suffix(".mp4"), frames)
    _print_outcome(env, expert, f". Wrote {stem}.png and {stem}.mp4")


def _make(folder: Path) -> None:
    """Make a folder, before anything is played.

    Raises:
        ViewOptionError: If that cannot be.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ViewOptionError(
            f"--out {folder} cannot be made a folder ({error.strerror}): choose another"
        ) from None


def _print_outcome(env: LabEnv, expert: Expert, more: str = "") -> None:
    """Print how an episode that is over has ended, and why if it failed."""
    cell = env.workcell
    lines = [f"{env.setting.task}, seed {env.seed}: {cell.progress.outcome}{more}"]
    lines += [f"  {line}" for line in why_failed(cell.task, cell.progress, expert, cell.world)]
    Console(soft_wrap=True, highlight=False).print("\n".join(lines), markup=False)


def _open_viewer(env: LabEnv, seed: int) -> None:
    """Play episodes of the expert at real time until the window is closed."""
    running = True
    while running:
        env.reset(seed=seed)
        cell = env.workcell
        with Viewer(cell.simulation, cell.world.bench_height) as viewer:
            while viewer.is_open and env.workcell is cell:
                _play(env, viewer)
                seed += 1
                env.reset(seed=seed)
            running = viewer.is_open


def _play(env: LabEnv, viewer: Viewer) -> None:
    """Show the expert's episode, unless the window is closed before its end."""
    expert = env.expert()
    expert.start()
    over = False
    while viewer.is_open and not over:
        _, _, terminated, truncated, _ = env.step(expert.act())
        viewer.show()
        over = terminated or truncated
    if over:
        _print_outcome(env, expert)


if __name__ == "__main__":
    main()
