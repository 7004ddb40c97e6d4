"""`python scripts/make_films.py`: the films of the README, of its rooms, and of every task.

All are drawn with Filament, as `labutopia-film` does. Beside other work the README's takes half an
hour, a task's half a minute. `make_films.py tasks level1/pick` makes those that are named.
"""

import argparse
import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.cli import film
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.progress import SUCCESS
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import DEFAULT_ROOM, FILAMENT, Setting
from labutopia_lerobot.sim.filming import BEAUTY, FilmCamera

GALLERY = Path(__file__).parents[1] / "docs" / "gallery"
FILM = "level4/liquid_fusion room=organic_7 width=896 height=504 fps=15 speed=6"
"""What is filmed, as one would type it."""
ROOMS = (
    ("level1/stir", "teaching_5", 6.0),
    ("level2/heat_beaker", "analytical_3", 9.0),
    ("level2/vortex_tube", "biology_5", 6.0),
    ("level2/stir_glassrod", "physics_4", 9.0),
)
"""Task, room and moment [s] of each picture of the strip."""
SIZE = 480, 320
"""Width and height of each [pixels]."""
EXPOSURES = 24
OF_TASKS = GALLERY / "films"
TASK_FILM = "width=480 height=270 fps=10 exposures=3"
LONGEST_S = 8.0
"""A task's film lasts no longer [s]: it is shown faster, by a whole number."""
LARGEST = 600_000
"""It has no more bytes: where a whole room goes by it is shown faster still."""
TASK_ROOMS = ("organic_7", "teaching_5", "analytical_3", "biology_5", "physics_4")
"""Rooms that the tasks are filmed in, one after the other; a task in which one drives draws its
own."""

FACE_THE_ROBOT = ("door", "drawer", "press", "open")
"""Words of tasks with furniture that turns its back to the camera for films: the task's own is
behind the robot."""


@clear_errors
def main() -> None:
    """Make what is asked for, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", nargs="?", choices=("film", "rooms", "tasks"), help="default: all")
    parser.add_argument("tasks", nargs="*", help="default: all that have no film yet")
    arguments = parser.parse_args()
    wanted = [arguments.what] if arguments.what else ["rooms", "film", "tasks"]
    OF_TASKS.mkdir(parents=True, exist_ok=True)
    if "rooms" in wanted:
        strip = np.hstack([moment(*each) for each in ROOMS])
        Image.fromarray(strip).save(GALLERY / "rooms.webp", quality=85, method=6)
    if "film" in wanted:
        film.main([*FILM.split(), f"out={GALLERY / 'film.webp'}"])
    if "tasks" in wanted:
        for number, task in enumerate(task_files()):
            if task in arguments.tasks or not (arguments.tasks or film_of(task).exists()):
                film_task(task, number)


def film_of(task: str) -> Path:
    """Return where the film of a task lies."""
    return OF_TASKS / f"{task.replace('/', '-')}.mp4"


def film_task(task: str, number: int) -> None:
    """Film a success of a task's expert, in the first of the rooms where there is one."""
    first = number % len(TASK_ROOMS)
    rooms = TASK_ROOMS[first:] + TASK_ROOMS[:first]
    drives = canonical_task(Setting(task)).drives
    if drives:
        rooms = (DEFAULT_ROOM,)
    room, seed, seconds = next(
        (room, seed, seconds)
        for room in rooms
        for seed in range(3)
        if (seconds := success_s(task, room, seed)) is not None
    )
    speed = math.ceil(seconds / LONGEST_S)
    facing = any(word in task for word in FACE_THE_ROBOT)
    camera = "front" if facing or drives else BEAUTY  # on the base, where one drives
    while True:
        options = f"room={room} seed={seed} speed={speed} camera={camera}"
        film.main([task, *TASK_FILM.split(), *options.split(), f"out={film_of(task)}"])
        if film_of(task).stat().st_size < LARGEST:
            break
        speed += math.ceil(speed / 4)


def success_s(task: str, room: str, seed: int) -> float | None:
    """Return when the expert has succeeded [s]; None if it does not, or the room does not fit."""
    try:
        env = LabEnv(Setting(task, obs="state", room=room))
        env.reset(seed=seed)
    except UserError:
        return None
    expert, progress = env.expert(), env.workcell.progress
    expert.start()
    while not progress.over:
        env.step(expert.act())
    seconds = env.workcell.world.time
    env.close()
    return seconds if progress.outcome == SUCCESS else None


def moment(task: str, room: str, seconds: float) -> NDArray[np.uint8]:
    """Return what the camera for films sees of the expert at a moment of its episode."""
    width, height = SIZE
    env = LabEnv(
        Setting(task, obs="state", renderer=FILAMENT, room=room, width=width, height=height)
    )
    env.reset(seed=0)
    camera = FilmCamera(env.workcell, BEAUTY, width / height, EXPOSURES)
    expert = env.expert()
    expert.start()
    while env.workcell.world.time < seconds:
        env.step(expert.act())
    picture = camera.picture()
    env.close()
    return picture


if __name__ == "__main__":
    main()
