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
    """

    part: Operable

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, reach, settle, grip, move, pause, release and leave."""
        done = closed(self.part)
        beyond = -0.4 * self.part.closed_within  # lightly against the stop, so that no gap is left
        yield from move_by_handle(
            self.part, world, beyond, lambda w, target, elapsed: done.holds(w)
        )
