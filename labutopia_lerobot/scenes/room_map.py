"""The map of a furnished room, from its plan alone."""

from labutopia_lerobot.navigation.occupancy import FINE, Occupancy
from labutopia_lerobot.scenes.plan import Plan
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
