"""`labutopia-view TASK`: look at the expert doing a task, in MuJoCo's viewer or as files."""

import argparse
import os
import sys
import time
from pathlib import Path

import mujoco.viewer
import numpy as np
from PIL import Image
from rich.console import Console

from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.options import LIQUID, SPLITS
from labutopia_lerobot.video import write_video
from labutopia_lerobot.world import CONTROL_HZ


@clear_errors
def main() -> None:
    """Open the viewer where there is a display, else write `TASK.png` and `TASK.mp4`."""
    parser = argparse.ArgumentParser(prog="labutopia-view", description=__doc__)
    parser.add_argument("task", help="task id, such as level1/pick")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--split", choices=SPLITS, default="id")
    parser.add_argument("--tasks-dir", type=Path, help="a further folder of tasks")
    parser.add_argument("--liquid", choices=LIQUID, default="on")
    parser.add_argument("--size", type=int, default=512, help="picture size when headless [pixels]")
    parser.add_argument("--out", type=Path, default=Path(), help="folder for the files")
    parser.add_argument("--headless", action="store_true", help="write files even with a display")
    arguments = parser.parse_args()
    size = arguments.size
    headless = arguments.headless or not _has_display()
    env = LabEnv(
        arguments.task,
        obs="pixels" if headless else "state",
        width=size,
        height=size,
        split=arguments.split,
        tasks_dir=arguments.tasks_dir,
        liquid=arguments.liquid,
    )
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
    stem = folder / env.task_id.replace("/", "-")
    Image.fromarray(frames[0]).save(stem.with_suffix(".png"))
    write_video(stem.with_suffix(".mp4"), frames)
    Console().print(
        f"{env.task_id}, seed {seed}: {info['outcome']}. Wrote {stem}.png and {stem}.mp4",
        soft_wrap=True,
    )


def _open_viewer(env: LabEnv, seed: int) -> None:
    """Play episodes of the expert at real time until the window is closed."""
    simulation = env.simulation
    with mujoco.viewer.launch_passive(
        simulation.scene.model, simulation.data, show_left_ui=False, show_right_ui=False
    ) as viewer:
        viewer.cam.lookat[:] = (0.2, 0.0, env.room.bench.height + 0.15)
        viewer.cam.distance, viewer.cam.azimuth, viewer.cam.elevation = 1.3, 150.0, -20.0
        while viewer.is_running():
            env.reset(seed=seed)
            expert = env.expert()
            expert.start()
            over = False
            while viewer.is_running() and not over:
                began = time.monotonic()
                _, _, terminated, truncated, _ = env.step(expert.act())
                with viewer.lock():
                    simulation.draw_particles(viewer.user_scn)
                viewer.sync()
                time.sleep(max(0.0, 1.0 / CONTROL_HZ - (time.monotonic() - began)))
                over = terminated or truncated
            seed += 1
