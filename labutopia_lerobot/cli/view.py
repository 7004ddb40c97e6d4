"""`labutopia-view TASK`: look at the expert doing a task, in MuJoCo's viewer or as files."""

from pathlib import Path

import numpy as np
from PIL import Image
from rich.console import Console

from labutopia_lerobot.checks.why import why_failed
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.doing import doing
from labutopia_lerobot.cli.grammar import OptionParser
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.runtime.video import require_filmable, write_video
from labutopia_lerobot.scenario.task_function import located_in_play
from labutopia_lerobot.sim.viewer import Viewer, has_display
from labutopia_lerobot.skills.expert import Expert

_SIZE = 512
"""Width and height of a picture by default [pixels]: more than policies see."""


class ViewOptionError(UserError):
    """An option with an impossible value; the message says which are possible."""


@clear_errors
def main() -> None:
    """Open the viewer where there is a display, else write `TASK.png` and `TASK.mp4`."""
    parser = OptionParser(prog="labutopia-view", description=__doc__)
    parser.add_argument("task", help="task id, such as level1/pick")
    parser.add_argument("--seed", type=int, default=0, help="of the first episode (default: 0)")
    parser.add_argument(
        "--out", type=Path, default=Path(), help="folder for the files (default: this one)"
    )
    parser.add_argument("--headless", action="store_true", help="write files even with a display")
    add_setting_flags(parser, width=_SIZE, height=_SIZE)
    arguments = parser.parse_args()
    headless = arguments.headless or not has_display()
    obs = "pixels" if headless else "state"
    setting = setting_of_flags(arguments, arguments.task, obs=obs)
    require_filmable(setting.width, setting.height)
    if arguments.seed < 0:
        raise ViewOptionError(f"--seed {arguments.seed} is too small: seeds begin at 0")
    env = LabEnv(setting)
    with located_in_play(setting.task, setting.tasks_dir):
        if headless:
            _write_files(env, arguments.seed, arguments.out)
        else:
            _open_viewer(env, arguments.seed)


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
