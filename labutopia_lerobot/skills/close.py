"""Close a door or drawer by its handle."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates import closed
from labutopia_lerobot.skills.handle import Operable, move_by_handle
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.world import World


@dataclass(frozen=True)
class Close:
    """The phases of the paper ("Close").

    Attributes:
        part: The door or drawer.
        heading: Where the hand points all the while, to the left of straight ahead of the robot
            [rad], which a wide swing needs; None for a hand that turns with the door.
        beyond: How far beyond the stop the hand aims [share of what is still no gap]: lightly, so
            that none is left; more where a catch must click.
    """

    part: Operable
    heading: float | None = None
    beyond: float = 0.4

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, reach, settle, grip, move, pause, release and leave."""
        done = closed(self.part)
        beyond = -self.beyond * self.part.closed_within
        yield from move_by_handle(
            self.part, world, beyond, lambda w, target, elapsed: done.holds(w), self.heading
        )
