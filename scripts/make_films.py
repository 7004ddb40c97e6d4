"""`python scripts/make_films.py`: the film that the README opens with, and its strip of four rooms.

Both are drawn with Filament, as `labutopia-film` does; beside other work the film takes half an
hour.
"""

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from labutopia_lerobot.cli import film
from labutopia_lerobot.cli.clear_errors import clear_errors
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import FILAMENT, Setting
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


@clear_errors
def main() -> None:
    """Make both, or what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", nargs="?", choices=("film", "rooms"), help="default: both")
    what = parser.parse_args().what
    GALLERY.mkdir(parents=True, exist_ok=True)
    if what != "film":
        strip = np.hstack([moment(*each) for each in ROOMS])
        Image.fromarray(strip).save(GALLERY / "rooms.webp", quality=85, method=6)
    if what != "rooms":
        film.main([*FILM.split(), f"out={GALLERY / 'film.webp'}"])


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
