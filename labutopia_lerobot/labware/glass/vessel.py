"""A glass vessel of revolution as a MuJoCo body: look, hollow collision shape, mass and frames."""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import override

import mujoco
import numpy as np

from labutopia_lerobot.labware.glass.draining import Draining
from labutopia_lerobot.labware.glass.material import BOROSILICATE, Material
from labutopia_lerobot.labware.glass.moving_fittings import Fitting, Stopcock
from labutopia_lerobot.labware.glass.profile import MassProperties, Point, Profile
from labutopia_lerobot.labware.glass.thread import Thread
from labutopia_lerobot.labware.glass.vessel_look import VesselLook, add_look
from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.contact import FRICTION
from labutopia_lerobot.labware.parts.form import Form
from labutopia_lerobot.labware.parts.mechanism import Mechanism
from labutopia_lerobot.labware.parts.moments import Moments, moments
from labutopia_lerobot.labware.parts.mounting import Loose
from labutopia_lerobot.processes import Process
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, SOLIMP, SOLREF

FACETS = 16
"""Flat pieces around a wall: a neck of 22 mm radius is round to within 0.4 mm."""

FEET = 8
"""Small spheres on which a vessel stands."""

_GRADUATION = 0.1
"""What burettes of 25 and 50 ml are marked in, and shown to, here [ml] (ISO 385, class A: 50 ml in
0.1 ml with a tolerance of 0.05 ml; from memory)."""

_FOOT_RADIUS = 0.004
_FOOT_DEPTH = 0.0002  # how far the feet stand out below the bottom [m]


@dataclass(frozen=True)
class Vessel(Loose):
    """A vessel: a value, usable as a dictionary key; `add_to` makes its MuJoCo body.

    Attributes:
        name: Name of the body; prefix of the names of all its elements.
        profile: The wall's half cross-section, a `Profile`.
        grip_height: Height above the base at which a gripper closes [m].
        one_mark: Volume that the only graduation, a ring, marks [m^3]; None for a scale.
        material: What it is made of.
        stands: Whether it stands by itself; what does not has no feet, and its bottom is round.
        graduated: Whether anything is printed on it.
        numbered: Whether its graduations have numbers.
        joined: Side arms, necks, jackets, handles: drawn and touched, but sealed where they join
            the wall, and to the liquid they are not there.
        thread: On the outside of its neck, for a screw cap.
        fittings: What moves on it.
        clamped: Whether it hangs in a clamp or a ring, so that it stays where it is put.
    """

    name: str
    profile: Profile
    grip_height: float
    one_mark: float | None = None
    material: Material = BOROSILICATE
    stands: bool = True
    graduated: bool = True
    numbered: bool = False
    joined: tuple[Form, ...] = ()
    thread: Thread | None = None
    fittings: tuple[Fitting, ...] = ()
    clamped: bool = False

    @property
    @override
    def movable(self) -> bool:
        """Whether it can be picked up, pushed and knocked over."""
        return not self.clamped

    @property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """Its moving fittings."""
        return tuple(fitting.mechanism for fitting in self.fittings)

    @property
    def stopcocks(self) -> tuple[Stopcock, ...]:
        """What lets liquid out of it."""
        return tuple(fitting for fitting in self.fittings if isinstance(fitting, Stopcock))

    @property
    def column(self) -> bool:
        """Whether it is so narrow that its liquid stands in it as one column, as in a burette."""
        return any(cock.column for cock in self.stopcocks)

    @property
    def delivered(self) -> str:
        """Name of the reading of what has left it through its stopcock [ml], if it has a scale."""
        return f"{self.name}_delivered"

    @property
    @override
    def processes(self) -> tuple[Process, ...]:
        return tuple(
            Draining(
                self.delivered,
                self.name,
                self.profile,
                cock.mechanism.joint,
                cock.from_frame,
                cock.to_frame,
                cock.bore,
                _GRADUATION if self.graduated else 0.0,
                cock.column,
                cock.vented,
            )
            for cock in self.stopcocks
        )

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the hinges and slides of what moves on it."""
        return tuple(part.joint for part in self.mechanisms)

    @property
    def grip_width(self) -> float:
        """Outer diameter at the grip height [m]."""
        return 2 * self.profile.outer_radius(self.grip_height)

    @property
    def height(self) -> float:
        """Height of the lip above the base [m]."""
        return self.profile.height

    @property
    def rim(self) -> str:
        """Name of the frame in the middle of the mouth; z out of it."""
        return f"{self.name}_rim"

    @property
    def mouth_radius(self) -> float:
        """Inner radius of the mouth [m]."""
        return self.profile.inner_radius(self.height)

    @cached_property
    def footprint_radius(self) -> float:
        """Radius of the circle around its axis that it needs on the bench [m]: its largest."""
        arms = (np.hypot(*form.shell()[0][:, :2].T).max() for form in self.joined)
        return max(*(radius for radius, _ in self.profile.outer), *map(float, arms))

    @property
    def taper(self) -> float:
        """Greatest inward lean of its wall, going up [rad]; 0 for a beaker."""
        leans = (math.atan2(a[0] - b[0], b[1] - a[1]) for a, b in pairwise(self.profile.inner))
        return max(0.0, *leans)

    @property
    def capacity(self) -> float:
        """Brimful capacity [ml]."""
        return self.profile.capacity * 1e6

    @property
    def mass(self) -> float:
        """Its mass when empty [kg], without what moves on it."""
        return self.mass_properties.mass + moments(self.joined, self.material.density).mass

    @cached_property
    def mass_properties(self) -> MassProperties:
        """Mass, centre of mass and principal inertia of the wall."""
        return self.profile.mass_properties(self.material.density)

    def add_to(self, spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> mujoco.MjsBody:
        """Build one jointless body into a spec (angles in radians), at the origin of the parent.

        Its origin is the centre of the base, z up. Sites: `<name>_grasp` on the axis at the grip
        height, `<name>_rim` in the centre of the mouth.

        Returns:
            The body.
        """
        body = parent.add_body(name=self.name)
        mass, com_height, transverse, axial = self.mass_properties
        if self.joined:
            weight = moments(self.joined, self.material.density)
            (Moments.of_revolution(*self.mass_properties) + weight).give_to(body)
        else:
            body.explicitinertial = True
            body.mass, body.ipos = mass, (0, 0, com_height)
            body.inertia = (transverse, transverse, axial)
        for site, height in ((f"{self.name}_grasp", self.grip_height), (self.rim, self.height)):
            body.add_site(name=site, pos=(0, 0, height), group=COLLISION_GROUP)
        add_look(spec, body, self._look)
        self._add_base(body)
        for band, (lower, upper) in enumerate(pairwise(self.profile.inner)):
            self._add_wall(spec, body, band, lower, upper)
        self._add_hull(body)
        assemble(spec, body, self.name, self.joined)
        for geom in body.geoms:
            if geom.group == COLLISION_GROUP:
                geom.friction, geom.solref, geom.solimp = FRICTION, SOLREF, SOLIMP
        if self.thread is not None:
            self.thread.add_ridge_to(body, self.height)
        for fitting in self.fittings:
            fitting.add_to(spec, self.name, body)
        return body

    @property
    def _look(self) -> VesselLook:
        return VesselLook(
            self.name,
            self.profile,
            self.material,
            self.stands,
            self.graduated,
            self.numbered,
            self.one_mark,
            self.thread,
        )

    def _add_base(self, body: mujoco.MjsBody) -> None:
        """Close the bottom with a disc, and stand it on a ring of small spheres as on its rim."""
        if self.profile.open_below:
            return
        foot, wide, top = self.profile.outer[0][0], self.profile.inner[0][0], self.profile.bottom
        under = _FOOT_DEPTH if foot >= wide else self.profile.outer_height(wide)
        half = (top - under) / 2
        _add_collision_geom(
            body,
            name=f"{self.name}_floor",
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=(max(foot, wide), half, 0),
            pos=(0, 0, under + half),
        )
        small = min(_FOOT_RADIUS, foot / 3, 1.5 * top)
        ring = foot - small  # tilted, it then rolls on the edge of the disc
        for number in range(FEET if self.stands else 0):
            angle = 2 * np.pi * number / FEET
            _add_collision_geom(
                body,
                name=f"{self.name}_foot_{number:02d}",
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=(small, 0, 0),
                pos=(ring * np.cos(angle), ring * np.sin(angle), small),
            )

    def _add_wall(
        self, spec: mujoco.MjSpec, body: mujoco.MjsBody, band: int, lower: Point, upper: Point
    ) -> None:
        """Add one band of wall, between two corners of the cavity, as a ring of convex prisms."""
        mesh = f"{self.name}_facet_{band}"
        wall, half_angle = self.profile.wall, np.pi / FACETS
        corners = [
            (radius, sign * radius * np.tan(half_angle), height)
            for inner_radius, height in (lower, upper)
            for radius in (inner_radius, inner_radius + wall)
            for sign in (-1, 1)
        ]
        spec.add_mesh(name=mesh, uservert=np.ravel(corners))
        for facet in range(FACETS):
            angle = 2 * facet * half_angle
            _add_collision_geom(
                body,
                name=f"{self.name}_wall_{band * FACETS + facet:02d}",
                type=mujoco.mjtGeom.mjGEOM_MESH,
                meshname=mesh,
                quat=(np.cos(angle / 2), 0, 0, np.sin(angle / 2)),
            )

    def _add_hull(self, body: mujoco.MjsBody) -> None:
        """Enclose the vessel in two stacked cylinders of least volume, for distance queries.

        A wall without a corner in between needs one only.
        """
        outer = self.profile.outer

        def stack(split: int) -> list[tuple[float, float, float]]:
            halves = (outer[: split + 1], outer[split:])
            return [(max(r for r, _ in half), half[0][1], half[-1][1]) for half in halves if half]

        def volume(split: int) -> float:
            return sum(radius**2 * (top - bottom) for radius, bottom, top in stack(split))

        splits = range(1, len(outer) - 1)
        best = stack(min(splits, key=volume)) if splits else stack(len(outer))[:1]
        for part, (radius, bottom, top) in zip(("lower", "upper"), best, strict=False):
            body.add_geom(
                name=f"{self.name}_hull_{part}",
                type=mujoco.mjtGeom.mjGEOM_CYLINDER,
                size=(radius, (top - bottom) / 2, 0),
                pos=(0, 0, (top + bottom) / 2),
                rgba=(0, 0, 0, 0),
                group=HULL_GROUP,
                contype=0,
                conaffinity=0,
                mass=0,
            )


def _add_collision_geom(body: mujoco.MjsBody, **attributes: object) -> None:
    body.add_geom(
        group=COLLISION_GROUP,
        friction=FRICTION,
        solref=SOLREF,
        solimp=SOLIMP,
        mass=0,
        **attributes,
    )
