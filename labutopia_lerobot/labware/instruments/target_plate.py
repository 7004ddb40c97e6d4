"""The target plate: a thin square tile with a printed ring that shows where a vessel goes."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.colors import Color
from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.instrument import Equipment
from labutopia_lerobot.labware.parts.mesh import revolve
from labutopia_lerobot.labware.parts.solid import BOX
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, SOLIMP, SOLREF, VISUAL_GROUP

SIDE = 0.15
"""Side of the square [m] (original, `target_plat`)."""

THICKNESS = 0.005
"""Height of the top above the bench [m] (original)."""

_DENSITY = 2400.0
"""Density of glazed porcelain [kg/m^3] (CRC Handbook, "Density of various solids": 2300 to
2500)."""

PORCELAIN = (0.86, 0.86, 0.82, 1.0)
_BLUE = (0.10, 0.33, 0.62, 1.0)
_RING = (0.046, 0.053)  # inner and outer radius [m]: a 250 ml beaker's lip leaves it visible
_PRINT_HEIGHT = 0.0003  # of the printing above the glaze, so that the two never flicker [m]


@dataclass(frozen=True)
class TargetPlate(Equipment):
    """A porcelain tile that lies free on the bench: origin at the centre of its underside, z up.

    Attributes:
        name: Name of the body; prefix of the names of all its elements.
        color: Of the ring.
        glaze: Colour of the tile.
    """

    name: str
    color: Color = _BLUE
    glaze: Color = PORCELAIN
    size = (0.150, 0.150, 0.0053)
    mass = 0.27
    source = "original (target_plat), of porcelain"
    movable = True
    passive = True

    @property
    def top_height(self) -> float:
        """Height of its top above its origin [m]."""
        return THICKNESS

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around it [m]."""
        return SIDE / math.sqrt(2.0)

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build one jointless body into a spec, at the origin of the parent.

        Returns:
            The body.
        """
        body = parent.add_body(name=self.name)
        size, pos = (SIDE / 2, SIDE / 2, THICKNESS / 2), (0, 0, THICKNESS / 2)
        tile, ring = f"{self.name}_tile", f"{self.name}_ring"
        spec.add_material(name=tile, rgba=self.glaze, specular=0.3, shininess=0.5)
        spec.add_material(name=ring, rgba=self.color, specular=0.1, shininess=0.1)
        inner, outer = _RING
        height = THICKNESS + _PRINT_HEIGHT
        vertices, faces = revolve([(outer, height), (inner, height)])
        spec.add_mesh(
            name=ring,
            uservert=vertices.ravel(),
            userface=faces.ravel(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )
        looks = {"group": VISUAL_GROUP, "contype": 0, "conaffinity": 0, "mass": 0}
        body.add_geom(name=tile, type=BOX, size=size, pos=pos, material=tile, **looks)
        mesh = mujoco.mjtGeom.mjGEOM_MESH
        body.add_geom(name=ring, type=mesh, meshname=ring, material=ring, **looks)
        body.add_geom(
            name=f"{self.name}_contact",
            type=BOX,
            size=size,
            pos=pos,
            group=COLLISION_GROUP,
            density=_DENSITY,
            friction=FRICTION,
            solref=SOLREF,
            solimp=SOLIMP,
        )
        body.add_geom(
            name=f"{self.name}_hull",
            type=BOX,
            size=size,
            pos=pos,
            group=HULL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )
        return body
