"""A plain laboratory room with one bench: where things are in it."""

from typing import TYPE_CHECKING

from labutopia_lerobot.scenes.room import Room, Surface
from labutopia_lerobot.scenes.views import View

if TYPE_CHECKING:
    import mujoco


def _build(room: Room, view: View) -> "mujoco.MjSpec":
    from labutopia_lerobot.scenes.laboratory_model import laboratory  # here: it imports mujoco

    return laboratory(room, view)


LABORATORY = Room(
    name="laboratory",
    builder=_build,
    # Height: original, lab_001: 0.773 to 0.78.
    bench=Surface(height=0.775, x=(-0.2, 1.2), y=(-0.9, 0.9)),
    robot_stand=(-0.4, 0.0, 0.71),  # original, every level 1 to 4 task
)
