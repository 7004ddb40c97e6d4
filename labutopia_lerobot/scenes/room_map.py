"""The map of a furnished room, from its plan alone."""

import numpy as np

from labutopia_lerobot.navigation.occupancy import FINE, Occupancy
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plan import Plan, WorkPlace
from labutopia_lerobot.scenes.space.boxes import joined
from labutopia_lerobot.scenes.space.claims import claims
from labutopia_lerobot.world import FloatArray


def room_map(plan: Plan, resolution: float = FINE) -> Occupancy:
    """Return the map of a room, doors being open.

    Args:
        plan: The room.
        resolution: Width of a cell [m].
    """
    occupancy = Occupancy.empty(plan.size[:2], resolution)
    occupancy.add(*joined(*(claim.room for claim in claims(plan) if not claim.what)))
    return occupancy


def map_around(plan: Plan, place: WorkPlace, resolution: float = FINE) -> Occupancy:
    """Return the map of a room in the frame of a task that is played at one of its work places.

    The room is turned and moved as in `scenes.furnished_room_model`: the robot of the place is
    where that of the laboratory is. The bench is the laboratory's, too.

    Args:
        plan: The room.
        place: The work place.
        resolution: Width of a cell [m].
    """
    occupancy = room_map(plan, resolution)
    rows, columns = occupancy.cells.shape
    turn, moved = frame_around(place)
    far = turn @ (columns * resolution, rows * resolution)
    x, y = np.minimum(far, 0.0) + moved
    return occupancy.placed(-place.heading // 90, (float(x), float(y)))


def frame_around(place: WorkPlace) -> tuple[FloatArray, FloatArray]:
    """Return how a room is turned for a task at one of its work places, and then moved.

    Args:
        place: The work place: its robot is then where that of the laboratory is.

    Returns:
        Rotation over the floor, shape (2, 2), and translation [m], shape (2,).
    """
    quarters = -place.heading // 90 % 4
    turn = np.linalg.matrix_power(np.array([[0.0, -1.0], [1.0, 0.0]]), quarters)
    return turn, np.array(LABORATORY.robot_stand[:2]) - turn @ (place.x, place.y)
