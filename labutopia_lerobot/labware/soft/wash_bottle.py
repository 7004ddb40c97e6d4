"""A squeeze wash bottle of soft polyethylene, standing in a holder on the bench."""

import math
from dataclasses import dataclass
from itertools import pairwise

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.materials import add_materials
from labutopia_lerobot.labware.parts.mounting import Fixed
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_look, add_part
from labutopia_lerobot.labware.soft.displacement import Squeezing
from labutopia_lerobot.labware.soft.elastic_shell import OWN_CONTYPE, SKIN, Elastic, Shell
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, VISUAL_GROUP

LDPE = Elastic(young=1.0e8, poisson=0.45, density=920.0, damping=0.1)
"""Low-density polyethylene, of which squeeze bottles are blown.

Modulus: a bottle wall that caves in is bent; the flexural modulus is 0.069 to 0.207 GPa, density
912 to 925 kg/m^3 (the table of matmake.com, after Cardarelli's "Materials Handbook", 2018, and the
CRC Handbook). Poisson's ratio: not in that table; 0.45 is usual for polyethylene, and the bending
stiffness, which goes with 1 / (1 - nu^2), is within 12 % of it for any value from 0.38 to 0.5.
Damping: ours; it stands in for the resistance of spout and liquid: the wall comes back in half a
second, without swinging.
"""

_RADIUS = 0.029
"""Radius of the body, to the middle of its wall [m]: with the wall's skin it is 61 mm wide, about
what bottles of 250 ml are, and a hand that opens by 80 mm takes it round."""
_WALL = 0.001
"""Thickness of the wall [m]; ours: with the modulus above, the hand's 35 N per finger, a firm pinch
between finger and thumb, take it in by a third of its width (measured: from 61 to 41 mm)."""
_GRIP_HEIGHT = 0.072
"""Half-way up, where the wall gives most and comes back in full. Squeezed as hard as the hand can
nearer to the shoulder, it keeps a dent of 5 to 10 ml (measured), as thin walls may."""
_RINGS = (
    (_RADIUS, 0.012),
    (_RADIUS, 0.042),
    (_RADIUS, _GRIP_HEIGHT),
    (_RADIUS, 0.102),
    (0.025, 0.123),
    (0.014, 0.132),
)
"""(radius, height) [m] of the wall's rings, from the holder's rim to the neck."""
_SEGMENTS = 14
_CONTENTS = 200e-6
"""Liquid at the start [m^3]; the rest is air."""
_WATER_DENSITY = 998.2
"""Density of water at 20 C [kg/m^3] (CRC Handbook, "Standard density of water")."""

_HOLDER_RADIUS, _PLATE_RADIUS, _PLATE_HEIGHT = 0.034, 0.042, 0.004
_CAP_RADIUS, _CAP_BOTTOM, _CAP_TOP = 0.017, 0.130, 0.152

_TUBE_RADIUS, _BORE_RADIUS = 0.003, 0.0015
"""Outside and inside of the spout [m]; it ends in a fine bore, which makes the jet."""
_SPOUT: tuple[tuple[float, float], ...] = (
    (0.000, _CAP_TOP),
    (0.000, 0.172),
    (0.006, 0.188),
    (0.020, 0.197),
    (0.038, 0.197),
    (0.056, 0.188),
    (0.072, 0.172),
    (0.084, 0.152),
    (0.090, 0.130),
)
"""Centre line of the swan neck, (x, z) [m]: its end hangs over a beaker beside the bottle."""


@dataclass(frozen=True)
class WashBottle(Fixed):
    """A 250 ml wash bottle; its origin is the centre of its holder's base, z up, spout along x.

    Holder, cap and spout are rigid, the wall between them is an elastic shell. What is squeezed out
    is physical: liquid cannot be compressed, so that it leaves through the spout by as much as the
    volume inside the deformed wall falls. The pressure that drives the jet does not push back on
    the wall. At 8 ml/s it is 0.6 kPa (density times speed squared over 2), which would stretch the
    wall by 0.02 % and take 0.6 % from the air above the liquid. It is not small while the wall
    snaps in, as thin walls do: at 40 ml/s, the median of the highest flow within a thirtieth of a
    second in 100 episodes of the expert, it would be 16 kPa.

    The holder is screwed to the bench, so that the bottle is neither knocked over nor dragged; a
    pinch from two sides needs no such help. One that stands free would cost five times as much per
    step (measured on a finer mesh: 4.1 against 0.8 ms), since MuJoCo solves flexes on moving bodies
    without the sparsity of those on fixed ones. The contents' mass moves with the wall, whose
    vertices are too many to be observed one by one: `joints` is empty.

    Attributes:
        name: Name of its root body; prefix of all its elements.
        material: Of the wall.
    """

    name: str
    material: Elastic = LDPE

    @property
    def shell(self) -> Shell:
        """The wall that can be squeezed."""
        return Shell(_RINGS, _SEGMENTS, _WALL, self.material)

    @property
    def wall(self) -> str:
        """Name of the flex of the wall."""
        return f"{self.name}_wall"

    @property
    def cap(self) -> str:
        """Name of the body of cap and spout."""
        return f"{self.name}_cap"

    @property
    def spout(self) -> str:
        """Name of the frame at the end of the spout; z the way that the liquid leaves."""
        return f"{self.name}_spout"

    @property
    def spout_reach(self) -> float:
        """Distance of the end of the spout from the axis [m], along x of the bottle."""
        return _SPOUT[-1][0]

    @property
    def spout_volume(self) -> float:
        """Volume of the bore, which fills before anything leaves [m^3]."""
        length = sum(math.dist(a, b) for a, b in pairwise(_SPOUT))
        return math.pi * _BORE_RADIUS**2 * length

    @property
    def bore_area(self) -> float:
        """Cross-section of the spout [m^2]."""
        return math.pi * _BORE_RADIUS**2

    @property
    def contents(self) -> float:
        """Liquid in it at the start [m^3]."""
        return _CONTENTS

    @property
    def squeezed(self) -> str:
        """Name of the reading of the volume that has left it [ml]."""
        return f"{self.name}_squeezed"

    @property
    def processes(self) -> tuple[Process, ...]:
        return (Squeezing(self.squeezed, self, self.shell, self.wall, self.spout_volume),)

    @property
    def grip_height(self) -> float:
        """Height of the grasp above the base [m]."""
        return _GRIP_HEIGHT

    @property
    def grip_width(self) -> float:
        """Outer diameter at the grasp [m]."""
        return 2 * (_RADIUS + SKIN)

    @property
    def height(self) -> float:
        return max(z for _, z in _SPOUT) + _TUBE_RADIUS

    @property
    def footprint_radius(self) -> float:
        """Radius of the circle around its axis that it needs on the bench [m]."""
        return _PLATE_RADIUS

    @property
    def bodies(self) -> frozenset[str]:
        """Names that it is touched under: holder with wall, cap with spout."""
        return frozenset({self.name, self.cap})

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build its body into a spec (angles in radians), at the origin of the parent.

        Sites: `<name>_spout` at the end of the spout.

        Returns:
            The body.
        """
        add_materials(
            spec,
            self.name,
            ("wall", (0.93, 0.95, 0.96, 1.0), 0.3),
            ("cap", (0.10, 0.32, 0.66, 1.0), 0.4),
            ("tube", (0.90, 0.92, 0.94, 1.0), 0.4),
            ("holder", (0.35, 0.38, 0.42, 1.0), 0.3),
        )
        body = parent.add_body(name=self.name)
        self._add_holder(body)
        self._add_cap(body)
        self.shell.add_to(spec, body, self.wall, self.wall, _CONTENTS * _WATER_DENSITY)
        for geom in [*body.geoms, *spec.body(self.cap).geoms]:
            if geom.contype:
                geom.contype = OWN_CONTYPE  # the wall is fixed to these, it does not touch them
        return body

    def _add_holder(self, body: mujoco.MjsBody) -> None:
        """Add plate and rim, and the hull of the wall, for the planner only."""
        look, rim = f"{self.name}_holder", _RINGS[0][1] + 0.003
        for part, radius, top in (
            ("plate", _PLATE_RADIUS, _PLATE_HEIGHT),
            ("rim", _HOLDER_RADIUS, rim),
        ):
            size, pos = (radius, top / 2, 0.0), (0.0, 0.0, top / 2)
            add_part(body, f"{self.name}_{part}", size, pos, look, shape=CYLINDER)
        low, high = _RINGS[0][1], _RINGS[-1][1]
        body.add_geom(
            name=f"{self.name}_wall_hull",
            type=CYLINDER,
            size=(_RADIUS + SKIN, (high - low) / 2, 0.0),
            pos=(0.0, 0.0, (high + low) / 2),
            rgba=(0, 0, 0, 0),
            group=HULL_GROUP,
            contype=0,
            conaffinity=0,
            mass=0,
        )

    def _add_cap(self, holder: mujoco.MjsBody) -> None:
        """Add the screw cap with its ribs, and the swan neck as a chain of cylinders."""
        body, look = holder.add_body(name=self.cap), f"{self.name}_cap"
        half = (_CAP_TOP - _CAP_BOTTOM) / 2
        middle = (0.0, 0.0, _CAP_BOTTOM + half)
        add_part(body, f"{self.cap}_lid", (_CAP_RADIUS, half, 0), middle, look, shape=CYLINDER)
        collar, top = (0.4 * _CAP_RADIUS, 0.006, 0.0), (0.0, 0.0, _CAP_TOP + 0.004)
        add_look(body, f"{self.cap}_collar", collar, top, look, shape=CYLINDER)
        for number, (start, end) in enumerate(pairwise(_SPOUT)):
            self._add_tube(body, f"{self.name}_tube_{number}", start, end)
        (x, z), slope = _SPOUT[-1], _direction(_SPOUT[-2], _SPOUT[-1])
        body.add_site(name=self.spout, pos=(x, 0, z), quat=_along(slope), group=COLLISION_GROUP)

    def _add_tube(
        self, body: mujoco.MjsBody, name: str, start: tuple[float, float], end: tuple[float, float]
    ) -> None:
        """Add one straight piece of the spout, rounded at its ends; its hull is a cylinder."""
        (x0, z0), (x1, z1) = start, end
        pos: Vector = ((x0 + x1) / 2, 0.0, (z0 + z1) / 2)
        half, quat = math.dist(start, end) / 2, _along(_direction(start, end))
        capsule = mujoco.mjtGeom.mjGEOM_CAPSULE
        for suffix, shape, group, collides in (
            ("", capsule, VISUAL_GROUP, 0),
            ("_contact", capsule, COLLISION_GROUP, 1),
            ("_hull", capsule, HULL_GROUP, 0),
        ):
            body.add_geom(
                name=name + suffix,
                type=shape,
                size=(_TUBE_RADIUS, half, 0.0),
                pos=pos,
                quat=quat,
                material=f"{self.name}_tube",
                group=group,
                contype=collides,
                conaffinity=collides,
                mass=0,
            )


def _direction(start: tuple[float, float], end: tuple[float, float]) -> Vector:
    """Return the unit vector between two points of the spout."""
    length = math.dist(start, end)
    return (end[0] - start[0]) / length, 0.0, (end[1] - start[1]) / length


def _along(direction: Vector) -> tuple[float, float, float, float]:
    """Return the scalar-first quaternion that turns z to a direction in the x-z plane."""
    rotation = Rotation.from_euler("y", np.arctan2(direction[0], direction[2]))
    w, x, y, z = rotation.as_quat(scalar_first=True)
    return w, x, y, z
