"""A silicone tube on a hose nozzle: it leaves the nozzle and lies in a bow on the bench."""

import math
from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np

from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.mounting import Fixed
from labutopia_lerobot.labware.parts.solid import CYLINDER, Quaternion, add_look, add_part
from labutopia_lerobot.labware.soft.elastic_shell import OWN_CONTYPE, Elastic
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ, SOLIMP, VISUAL_GROUP

SILICONE = Elastic(young=3.0e6, poisson=0.49, density=1150.0, damping=0.02)
"""Silicone rubber. Modulus: tubing of Shore A 50 to 78 has 2.1 to 4 MPa (table 2 of the article
PMC11019708, "Silastic tubing"). Density: ours, the middle of the usual 1.1 to 1.2 g/cm^3. Poisson's
ratio: rubber hardly changes its volume. Damping: ours; a tube let go of swings once or twice."""

_OUTER, _BORE = 0.004, 0.0025
"""Outside and inside radius [m]: tubing of 5 by 8 mm, a usual size."""
_FRICTION = (0.8, 0.005, 0.0001)
"""The first is the kinetic friction of rubber on concrete (Serway and Jewett, "Physics for
Scientists and Engineers", table of friction coefficients)."""
_SOLREF = (1.0 / PHYSICS_HZ, 1.0)
"""Time constant [s] and damping ratio of contacts: see `elastic_shell.py`."""
_SOLREF_LENGTH = (0.0012, 1.0)
"""Time constant [s] and damping ratio of the edges' length. Pulled by 0.25 N, an edge gets 0.8 %
longer (measured; rubber, 0.3 %); at five sixths of the time constant the tube hums on the bench."""

_NOZZLE_HEIGHT = 0.030
_EDGE = 0.016
"""Length of an edge [m]: four times the radius, so that neighbours do not touch in a bend."""
_FALL = 8
"""Edges that lead from the nozzle down to the bench."""
_BOW = 10
"""Edges of the bow on the bench."""
_BOW_RADIUS = 0.060
"""Radius of the bow [m]: tubing comes off a roll and keeps some of its bend."""

_ALONG_X: Quaternion = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)


@dataclass(frozen=True)
class SiliconeTube(Fixed):
    """A tube whose first edge sits on a nozzle that is screwed to the bench; it leaves along x.

    It is an elastic rod (MuJoCo flex of dimension 1) that bends and keeps its length, and that is
    at rest in the bow that it is made in. MuJoCo's rods are solid: their modulus is the rubber's
    times 1 - (bore / outside)^4, the share that a tube has of a rod's second moment of area. Left
    out: twist, of which a round tube that is free at one end stores none, and kinks.

    The slides of its points are its shape, too many to be observed one by one: `joints` is empty.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        material: What the tube is made of.
    """

    name: str
    material: Elastic = SILICONE

    @property
    def tube(self) -> str:
        """Name of the flex."""
        return f"{self.name}_rod"

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its origin that it needs on the bench [m]."""
        return float(np.hypot(*self.path[:, :2].T).max()) + _OUTER

    @property
    def mass(self) -> float:
        """Mass of the tube [kg]."""
        length = _EDGE * (len(self.path) - 1)
        return math.pi * (_OUTER**2 - _BORE**2) * length * self.material.density

    @cached_property
    def path(self) -> FloatArray:
        """Points of its centre line at rest, in the frame of its body, shape (n, 3) [m].

        Edges are laid one by one: level, sloping down and level again, then round the bow.
        """
        drop = _NOZZLE_HEIGHT - _OUTER
        slopes = np.sin(np.pi * (np.arange(_FALL) + 0.5) / _FALL) ** 2
        steepest = drop / (_EDGE * slopes.sum())  # sine of the greatest slope, about
        sines = np.concatenate([[0.0], steepest * slopes, np.zeros(_BOW)])
        turn = np.maximum(0, np.arange(len(sines)) - _FALL) * _EDGE / _BOW_RADIUS
        levels = np.sqrt(1.0 - sines**2)
        edges = np.column_stack([levels * np.cos(turn), levels * np.sin(turn), -sines])
        start = np.array([0.0, 0.0, _NOZZLE_HEIGHT])
        return np.vstack([start, start + _EDGE * np.cumsum(edges, axis=0)])

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Returns:
            The body; its origin lies on the bench below the nozzle, x the way the tube leaves.
        """
        add_materials(
            spec,
            self.name,
            ("rod", (0.86, 0.55, 0.22, 1.0), 0.3),
            ("metal", (0.66, 0.68, 0.70, 1.0), 0.6),
            shininess=0.4,
        )
        body = parent.add_body(name=self.name)
        self._add_nozzle(body)
        self._add_tube(spec, body)
        return body

    def _add_nozzle(self, body: mujoco.MjsBody) -> None:
        """Add a foot, a post and a barb that the tube is pushed onto."""
        look = f"{self.name}_metal"
        for part, radius, top in (("foot", 0.022, 0.005), ("post", 0.009, _NOZZLE_HEIGHT + 0.008)):
            size, pos = (radius, top / 2, 0.0), (-0.012, 0.0, top / 2)
            add_part(body, f"{self.name}_{part}", size, pos, look, shape=CYLINDER)
        barb, pos = (1.4 * _OUTER, 0.006, 0.0), (0.0, 0.0, _NOZZLE_HEIGHT)
        add_look(body, f"{self.name}_barb", barb, pos, look, shape=CYLINDER, quat=_ALONG_X)
        for geom in body.geoms:
            if geom.contype:
                geom.contype = OWN_CONTYPE

    def _add_tube(self, spec: mujoco.MjSpec, body: mujoco.MjsBody) -> None:
        """Add the rod: its first edge is fixed, each further vertex is a point on three slides."""
        last = len(self.path) - 1
        bodies, local = [], self.path.copy()
        for number, position in enumerate(self.path):
            if number < 2:
                bodies.append(body.name)
                continue
            vertex = f"{self.tube}_{number:02d}"
            share = self.mass / last * (0.5 if number == last else 1.0)  # of the edges beside it
            point = body.add_body(name=vertex, pos=position, explicitinertial=True, mass=share)
            point.inertia = (share * 1e-6,) * 3  # not felt: it never turns
            for axis, direction in zip("xyz", np.eye(3), strict=True):
                slide = mujoco.mjtJoint.mjJNT_SLIDE
                point.add_joint(name=f"{vertex}_{axis}", type=slide, axis=direction)
            bodies.append(vertex)
            local[number] = 0.0
        first = np.arange(last)
        spec.add_flex(
            name=self.tube,
            dim=1,
            radius=_OUTER,
            vertbody=bodies,
            vert=local.ravel(),
            elem=np.column_stack([first, first + 1]).ravel(),
            young=self.material.young * (1.0 - (_BORE / _OUTER) ** 4),
            poisson=self.material.poisson,
            damping=self.material.damping,
            selfcollide=mujoco.mjtFlexSelf.mjFLEXSELF_NONE,
            contype=OWN_CONTYPE,
            friction=_FRICTION,
            solref=_SOLREF,
            solimp=SOLIMP,
            material=[f"{self.name}_rod"],
            group=VISUAL_GROUP,
        )
        spec.add_equality(
            name=f"{self.tube}_length",
            type=mujoco.mjtEq.mjEQ_FLEX,
            name1=self.tube,
            solref=_SOLREF_LENGTH,
        )
