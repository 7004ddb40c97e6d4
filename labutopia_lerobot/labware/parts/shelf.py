"""A shelf in a cabinet or an oven."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.solid import Vector, add_part
from labutopia_lerobot.world.model import COLLISION_GROUP

_THICKNESS = 0.006
"""Thickness of the sheet with its bent edges [m]."""


@dataclass(frozen=True)
class Shelf:
    """A level plate, a body of its own: what stands on it does not touch the box around it.

    The frame of its name lies in the middle of its top: x away from the door, z up.

    Attributes:
        name: Name of its body and of its frame.
    """

    name: str

    def add_to(
        self, box: mujoco.MjsBody, size: tuple[float, float], at: Vector, material: str
    ) -> None:
        """Build its body into a box whose front faces -x.

        Args:
            box: What it hangs in.
            size: Depth and width [m].
            at: Its middle in the frame of the box [m].
            material: Name of a material of the spec.
        """
        depth, width = size
        body = box.add_body(name=self.name, pos=at)
        half = _THICKNESS / 2
        body.add_site(name=self.name, pos=(0, 0, half), group=COLLISION_GROUP)
        add_part(body, f"{self.name}_plate", (depth / 2, width / 2, half), (0, 0, 0), material)
