"""Open a door or drawer by its handle."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.skills.handle import Operable, move_by_handle
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.world import World


@dataclass(frozen=True)
class Open:
    """The phases of the paper ("Open Door").

    Attributes:
        part: The door or drawer.
        to: Position of its joint to open it to [rad or m].
        within: How far short of that the hand may let go [share of `to`].
        heading: Where the hand points all the while, to the left of straight ahead of the robot
            [rad], which a wide swing needs; None for a hand that turns with the door.
    """

    part: Operable
    to: float
    within: float = 0.02
    heading: float | None = None

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, reach, settle, grip, move, pause, release and leave."""
        enough = (1.0 - self.within) * self.to
        yield from move_by_handle(
            self.part,
            world,
            self.to,
            lambda w, target, elapsed: w.joint(self.part.joint) > enough,
            self.heading,
        )
