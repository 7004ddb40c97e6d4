"""A glass stirring rod with fire-polished ends."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.glass.profile import BOROSILICATE_DENSITY
from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.mounting import Loose
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, SOLIMP, SOLREF, VISUAL_GROUP

LENGTH = 0.25
"""Length [m]. Original: 0.2, too short for fingers above a rack of 0.193 m; rods are usually 0.1 to
0.4 m long ("Glass rod", Wikipedia)."""

DIAMETER = 0.006
"""Diameter [m] (original; rods of this length are 5 to 7 mm thick)."""

_GRIP_BELOW_TOP = 0.022
"""The pads, 18 mm high, close just below the rounded end: the hand stays clear of the rack [m]."""

_GLASS = (0.80, 0.93, 0.98, 0.85)
"""Less transparent than a wall: light goes through solid glass only where it looks along it."""


@dataclass(frozen=True)
class GlassRod(Loose):
    """A round rod: origin at its lower tip, z along it.

    Attributes:
        name: Name of the body; prefix of the names of all its elements.
    """

    name: str

    @property
    def grip_height(self) -> float:
        """Height of the grasp above the lower tip [m]."""
        return LENGTH - _GRIP_BELOW_TOP

    @property
    def grip_width(self) -> float:
        """Diameter [m]."""
        return DIAMETER

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its axis that it needs when upright [m]."""
        return DIAMETER / 2

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build one jointless body into a spec, at the origin of the parent.

        Returns:
            The body.
        """
        body = parent.add_body(name=self.name)
        spec.add_material(name=self.name, rgba=_GLASS, specular=0.5, shininess=0.9)
        radius = DIAMETER / 2
        shape = {
            "type": mujoco.mjtGeom.mjGEOM_CAPSULE,
            "size": (radius, LENGTH / 2 - radius, 0),
            "pos": (0, 0, LENGTH / 2),
        }
        unfelt = {"contype": 0, "conaffinity": 0, "mass": 0}
        body.add_geom(
            name=f"{self.name}_look", material=self.name, group=VISUAL_GROUP, **shape, **unfelt
        )
        body.add_geom(
            name=f"{self.name}_contact",
            group=COLLISION_GROUP,
            density=BOROSILICATE_DENSITY,
            friction=FRICTION,
            solref=SOLREF,
            solimp=SOLIMP,
            **shape,
        )
        body.add_geom(name=f"{self.name}_hull", group=HULL_GROUP, **shape, **unfelt)
        return body
