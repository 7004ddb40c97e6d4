"""Turn to face a thing on a bench, and go in to where the arm reaches it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.skills.skill import Phase
from labutopia_lerobot.skills.way import INWARDS, STRAIGHT, Way, base_at, dock_for, in_hand, parking
from labutopia_lerobot.world import Dock, FloatArray, Thing, World

_NEARER = 0.05
"""How far beyond the point that it drives to a base has come nearer [m]; ours: driving ends within
2 cm of it."""


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
        """Yield turn and dock, and nothing where the base has docked."""
        hand = in_hand(world, self.carrying)
        dock = dock_for(world, self.thing, from_above=self.from_above)
        limits = Way.of(world, INWARDS).limits
        docked = Parking(dock.position, dock.yaw, limits)
        if docked.arrived(*base_at(world), 2.0 * docked.near, 2.0 * STRAIGHT):
            return
        yield parking("turn", Parking(base_at(world)[0], dock.yaw, limits), hand)
        if limits.sideways:
            yield parking("line up", Parking(_in_line(world, dock), dock.yaw, limits), hand)
        yield parking("dock", docked, hand)


def _in_line(world: World, dock: Dock) -> FloatArray:
    """Return where the base is to be straight behind a dock, shape (2,) [m].

    That is the point that it drives to, or beside where it is, if it has come nearer than that.
    """
    inwards = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
    nearer = float((base_at(world)[0] - dock.before) @ inwards)
    return dock.before if nearer < _NEARER else dock.before + nearer * inwards
