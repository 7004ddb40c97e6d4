"""A route: a path to a bench as it was planned at a moment of an episode, for the recording."""

from collections.abc import Sequence
from dataclasses import dataclass

from labutopia_lerobot.navigation.path import Path
from labutopia_lerobot.skills.way import Way, base_at, dock_for
from labutopia_lerobot.world import Dock, Obstacle, Thing, World

CLEAR_OF_PEOPLE = 0.10
"""Distance from a person that is kept beyond both discs [m]; ours: a hand's breadth."""


@dataclass(frozen=True, eq=False)
class Route:
    """A path as it was planned.

    Attributes:
        time: When [s].
        thing: What to drive to.
        around: Who was in the way and is gone round, where they were at that time.
        path: The path, world frame.
        dock: Place at the bench to which it leads.
    """

    time: float
    thing: Thing
    around: tuple[Obstacle, ...]
    path: Path
    dock: Dock

    @classmethod
    def planned(
        cls, way: Way, world: World, thing: Thing, around: Sequence[Obstacle] = ()
    ) -> "Route":
        """Return the route from where a base is now.

        Args:
            way: Map and limits.
            world: Where the base is.
            thing: What to drive to.
            around: Who walks, and is to be gone round.

        Raises:
            BlockedPlaceError: If the base is where its disc touches something.
            UnreachableGoalError: If no way leads there.
            PhaseError: If the thing is within reach of no place.
        """
        dock = dock_for(world, thing)
        free = way.round(world, around, 2.0 * CLEAR_OF_PEOPLE) if around else way
        path = free.path(base_at(world)[0], dock.before)
        return cls(world.time, thing, tuple(around), path, dock)
