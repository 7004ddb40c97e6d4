"""A route: a path to a bench as it was planned at a moment of an episode, for the recording."""

from dataclasses import dataclass

from labutopia_lerobot.navigation.path import Path
from labutopia_lerobot.world import Dock, Obstacle, Thing


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
