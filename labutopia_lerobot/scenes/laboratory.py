"""A plain laboratory room with one bench: where things are in it."""

from typing import TYPE_CHECKING

import numpy as np

from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.scenes.room import Room, Surface
from labutopia_lerobot.scenes.views import View

if TYPE_CHECKING:
    import mujoco


def _build(room: Room, view: View) -> "mujoco.MjSpec":
    from labutopia_lerobot.scenes.laboratory_model import laboratory  # here: it imports mujoco

    return laboratory(room, view)


_WALLS = ((-1.45, 2.5), (-2.45, 2.45))
"""Inner faces of the walls: x and y [m], world frame."""


def _map() -> Occupancy:
    (west, east), (south, north) = _WALLS
    occupancy = Occupancy.empty((east - west, north - south))
    bench, corner = LABORATORY.bench, np.array([west, south, 0.0])
    low = np.array([[bench.x[0], bench.y[0], 0.0]]) - corner
    high = np.array([[bench.x[1], bench.y[1], bench.height]]) - corner
    occupancy.add(low, high)
    return occupancy.placed(0, (west, south))


LABORATORY = Room(
    name="laboratory",
    builder=_build,
    # Height: original, lab_001: 0.773 to 0.78.
    bench=Surface(height=0.775, x=(-0.2, 1.2), y=(-0.9, 0.9)),
    robot_stand=(-0.4, 0.0, 0.71),  # original, every level 1 to 4 task
    mapper=_map,
)
