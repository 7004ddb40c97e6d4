"""Take the hand past places, to where the next skill begins."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from labutopia_lerobot.places import Destination
from labutopia_lerobot.skills.posture import pointing
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.world import Pose, World


@dataclass(frozen=True)
class Go:
    """Go round something that straight ways lead into, such as an open door.

    Attributes:
        past: Where the point between the pads passes by, one after the other.
        heading: Where the hand points, to the left of straight ahead of the robot [rad].
    """

    past: tuple[Destination, ...]
    heading: float

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield a phase for every place."""
        opening, pitch = world.commanded_opening, world.robot.handle_approach.pitch
        for place in self.past:
            hand = pointing(place.position_w(world), self.heading, pitch)
            yield Phase("past", partial(_stay, hand), opening, arrived(0.03, 0.2))


def _stay(pose: Pose, world: World) -> Pose:
    """Return the pose, whatever the world does."""
    return pose
