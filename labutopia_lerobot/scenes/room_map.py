"""The map of a furnished room, from its plan alone."""

import numpy as np

from labutopia_lerobot.navigation.occupancy import FINE, Occupancy
from labutopia_lerobot.scenes.laboratory import LABORATORY
from labutopia_lerobot.scenes.plan import Plan, WorkPlace
from labutopia_lerobot.scenes.space.boxes import joined
from labutopia_lerobot.scenes.space.claims import claims


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
    quarters = -place.heading // 90
    turn = np.linalg.matrix_power(np.array([[0, -1], [1, 0]]), quarters % 4)
    occupancy = room_map(plan, resolution)
    rows, columns = occupancy.cells.shape
    far = turn @ (columns * resolution, rows * resolution)
    moved = np.array(LABORATORY.robot_stand[:2]) - turn @ (place.x, place.y)
    x, y = np.minimum(far, 0.0) + moved
    return occupancy.placed(quarters, (float(x), float(y)))
