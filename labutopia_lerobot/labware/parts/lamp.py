"""Lamps: what shines as brightly as a knob or a switch says."""

from dataclasses import dataclass
from typing import override

import mujoco

from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.processes import Apparatus, Process
from labutopia_lerobot.world import Reading
from labutopia_lerobot.world.model import VISUAL_GROUP

_DARK, _LIT = (0.45, 0.46, 0.45), (1.0, 0.97, 0.86)
"""Of a lamp behind frosted glass, off and at its brightest."""


@dataclass(frozen=True)
class Lamp(Process):
    """A lamp behind frosted glass; its reading is how bright it is, in parts of its brightest.

    It is seen to shine, and lights nothing else up.

    Attributes:
        name: What its reading is called, and the geom that is seen of it.
        level: From 0 to 1, what its knob or its switch says.
    """

    name: str
    level: Process

    @override
    def reading(self, apparatus: Apparatus) -> Reading:
        level = self.level.reading(apparatus)
        return Reading(0.0 if level is None else level.value, "1", 0.01)

    @override
    def show(self, apparatus: Apparatus) -> None:
        share = self.reading(apparatus).value
        color = ((1.0 - share) * dark + share * lit for dark, lit in zip(_DARK, _LIT, strict=True))
        apparatus.model.geom(self.name).rgba = (*color, 1.0)

    def add_to(self, spec: mujoco.MjSpec, body: mujoco.MjsBody, pos: Vector, size: Vector) -> None:
        """Build its glass, dark.

        Args:
            spec: What the body is in.
            body: What carries it.
            pos: Its middle in the frame of the body [m].
            size: Half sizes of a box; or radius and half height of an upright disc, and 0 [m].
        """
        spec.add_material(name=self.name, emission=0.6)
        box, disc = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CYLINDER
        body.add_geom(
            name=self.name,
            type=box if size[2] else disc,
            size=size,
            pos=pos,
            material=self.name,
            rgba=(*_DARK, 1.0),
            group=VISUAL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )
