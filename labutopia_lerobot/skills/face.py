"""Turn to face a thing on a bench, and go in to where the arm reaches it."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.skills.way import Way, base_at, dock_for, in_hand, parking
from labutopia_lerobot.world import Thing, World

INWARDS = 0.4
"""Share of the base's speeds with which it goes in; ours: centimetres before furniture."""


@dataclass(frozen=True)
class Face:
    """The paper's "controlled orientation adjustment", and the last half metre to the bench.

    Attributes:
        thing: What to face.
        carrying: Thing in the hand, if any.
        from_above: Whether it is to be taken from above.
    """

    thing: Thing
    carrying: Thing | None = None
    from_above: bool = False

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield turn and dock."""
        hand = in_hand(world, self.carrying)
        dock = dock_for(world, self.thing, from_above=self.from_above)
        limits = Way.of(world, INWARDS).limits
        yield parking("turn", Parking(base_at(world)[0], dock.yaw, limits), hand)
        if limits.sideways:
            yield parking("line up", Parking(dock.before, dock.yaw, limits), hand)
        yield parking("dock", Parking(dock.position, dock.yaw, limits), hand)
