"""Carry a held thing past places, upright."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from labutopia_lerobot.places import Destination
from labutopia_lerobot.skills.posture import upright_in_hand
from labutopia_lerobot.skills.skill import Phase, arrived, carrier
from labutopia_lerobot.world import Pose, Thing, World


@dataclass(frozen=True)
class Carry:
    """Take a thing out of something, or round something, to where the next skill begins.

    Attributes:
        thing: The thing in the hand.
        past: Where its base passes by, one after the other.
    """

    thing: Thing
    past: tuple[Destination, ...]

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield a phase for every place."""
        own, shut = frozenset({self.thing.name}), world.commanded_opening
        for place in self.past:
            there = upright_in_hand(world, self.thing, place.position_w(world))
            hand = carrier(world, self.thing)(there)
            yield Phase("past", partial(_stay, hand), shut, arrived(0.02, 0.2), own, self.thing)


def _stay(pose: Pose, world: World) -> Pose:
    """Return the pose, whatever the world does."""
    return pose
