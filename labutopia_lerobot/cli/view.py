"""`labutopia-view TASK`: look at the expert doing a task, in MuJoCo's viewer or as files."""

import argparse
import os
import sys
from pathlib import Path

import numpy as np
from PIL import Image
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.cli.setting_flags import add_setting_flags, setting_of_flags
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.runtime.video import require_filmable, write_video
from labutopia_lerobot.sim.viewer import Viewer

_SIZE = 512
"""Width and height of a picture by default [pixels]: more than policies see."""


@clear_errors
def main() -> None:
    """Open the viewer where there is a display, else write `TASK.png` and `TASK.mp4`."""
    parser = argparse.ArgumentParser(prog="labutopia-view", description=__doc__)
    parser.add_argument("task", help="task id, such as level1/pick")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path(), help="folder for the files")
    parser.add_argument("--headless", action="store_true", help="write files even with a display")
    add_setting_flags(parser, width=_SIZE, height=_SIZE)
    arguments = parser.parse_args()
    headless = arguments.headless or not _has_display()
    obs = "pixels" if headless else "state"
    setting = setting_of_flags(arguments, arguments.task, obs=obs)
    require_filmable(setting.width, setting.height)
    env = LabEnv(setting)
    if headless:
        _write_files(env, arguments.seed, arguments.out)
    else:
        _open_viewer(env, arguments.seed)


def _has_display() -> bool:
    return sys.platform != "linux" or any(
        os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY")
    )


def _write_files(env: LabEnv, seed: int, folder: Path) -> None:
    """Write the first picture and the whole episode, all cameras side by side."""
    observation, info = env.reset(seed=seed)
    expert = env.expert()
    expert.start()
    frames = [np.hstack(list(observation["pixels"].values()))]
    over = False
    while not over:
        observation, _, terminated, truncated, info = env.step(expert.act())
        frames.append(np.hstack(list(observation["pixels"].values())))
        over = terminated or truncated
    folder.mkdir(parents=True, exist_ok=True)
    stem = folder / env.setting.task.replace("/", "-")
    Image.fromarray(frames[0]).save(stem.with_suffix(".png"))
    write_video(stem.with_suffix(".mp4"), frames)
    Console().print(
        f"{env.setting.task}, seed {seed}: {info['outcome']}. Wrote {stem}.png and {stem}.mp4",
        soft_wrap=True,
    )


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
