"""A named place of an instrument where something stands or is put in."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world import FloatArray, World
from labutopia_lerobot.world.model import COLLISION_GROUP


@dataclass(frozen=True)
class Seat:
    """A pan, a hot plate, a bore: a destination; z of the frame of its name points out of it.

    Attributes:
        name: Name of its frame, and of the place in the name of a fact.
        support: Name of the body that what is there stands on.
        at: Where its middle is in that body's frame [m].
        width: Diameter of the largest thing that fits [m].
        depth: How deep a thing stands in it [m]; 0 where it stands on it.
    """

    name: str
    support: str
    at: Vector
    width: float
    depth: float = 0.0

    def position_w(self, world: World) -> FloatArray:
        """Return where the base of a thing goes, shape (3,), metres, world frame."""
        return world.frame(self.name).position_w

    def add_to(self, body: mujoco.MjsBody) -> None:
        """Add its frame to the body of its name `support`."""
        body.add_site(name=self.name, pos=self.at, group=COLLISION_GROUP)
