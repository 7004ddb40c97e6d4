"""Moving fittings of ware: stopcocks, pistons, hinged lids."""

import math
from dataclasses import dataclass
from typing import Protocol

import mujoco

from labutopia_lerobot.labware.glass.draining import Bore
from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Form, towards
from labutopia_lerobot.labware.parts.mechanism import Mechanism, add_moving, in_degrees
from labutopia_lerobot.labware.parts.slide import Slide
from labutopia_lerobot.labware.parts.solid import Quaternion, Vector
from labutopia_lerobot.labware.parts.valve import Tap
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP, SOLREF


class Fitting(Protocol):
    """A part that moves on a piece of ware, and goes wherever that goes."""

    @property
    def mechanism(self) -> Mechanism:
        """Its joint: how far it goes and how hard a hand moves it."""
        ...

    def add_to(self, spec: mujoco.MjSpec, piece: str, body: mujoco.MjsBody) -> None:
        """Build its body onto the body of the piece of ware."""
        ...


@dataclass(frozen=True)
class Stopcock:
    """A plug with a wing: along the line it is open, across it is shut.

    Friction holds it at any angle; its stops are at 0 and 90 degrees.

    Attributes:
        mechanism: The wing.
        at: Where on the surface of the barrel its axis is [m].
        turn: Orientation of the shut wing, scalar-first; z points into the barrel.
        bore: The way of the liquid through it.
        inlet: Where liquid leaves the cavity [m].
        outlet: Where it comes out [m].
        leaving: The way that it comes out, a unit vector.
        column: Whether it is at the end of a tube so narrow that liquid stands in it as a column.
        vented: Whether air gets in when the mouth is closed.
    """

    mechanism: Tap
    at: Vector
    turn: Quaternion
    bore: Bore
    inlet: Vector
    outlet: Vector
    leaving: Vector = (0.0, 0.0, -1.0)
    column: bool = False
    vented: bool = False

    def add_to(self, spec: mujoco.MjSpec, piece: str, body: mujoco.MjsBody) -> None:
        """Build its body onto the body of the piece of ware."""
        self.mechanism.add_to(spec, piece, body, self.at, self.turn)
        for name, pos in ((self.from_frame, self.inlet), (self.to_frame, self.outlet)):
            body.add_site(name=name, pos=pos, quat=towards(self.leaving), group=COLLISION_GROUP)

    @property
    def from_frame(self) -> str:
        """Name of the frame where liquid leaves the cavity."""
        return f"{self.mechanism.name}_inlet"

    @property
    def to_frame(self) -> str:
        """Name of the frame where it comes out; z the way that it does."""
        return f"{self.mechanism.name}_outlet"


_THUMB = 0.03
"""Mass felt at a plunger beside its own [kg]: a thumb is behind it."""


@dataclass(frozen=True)
class Piston:
    """A plunger in a barrel: pushed in as it is built, it is pulled upwards.

    Attributes:
        mechanism: Its slide.
        at: Where its origin is when it is pushed in [m].
        forms: What it is made of, in its own frame.
        mass: What it weighs [kg].
    """

    mechanism: Slide
    at: Vector
    forms: tuple[Form, ...]
    mass: float

    def add_to(self, spec: mujoco.MjSpec, piece: str, body: mujoco.MjsBody) -> None:
        """Build its body onto the body of the piece of ware."""
        plunger = self.mechanism.add_to(spec, body, self.at, (0.0, 0.0, 1.0))
        assemble(spec, plunger, piece, self.forms, self.mass)
        plunger.joints[0].armature = _THUMB


@dataclass(frozen=True)
class Flap:
    """Lid on a moulded hinge: it opens upwards and back, and stays where it is left.

    Attributes:
        name: Name of its body.
        widest: Where it stops [rad].
    """

    name: str
    widest: float = math.radians(175.0)

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 is closed."""
        return f"{self.name}_hinge"

    @property
    def effort(self) -> float:
        """Torque with which a thumb opens it [N m]."""
        return 0.03

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return in_degrees(position)


_NOSE = 0.0006
"""Radius of the nose of a snap lid, and of the bead on the rim that it passes [m]; ours."""
_BITE = 0.00012
"""Distance by which nose and bead must give way to each other [m]; ours: see `SnapLid`."""


@dataclass(frozen=True)
class SnapLid:
    """A hinged lid whose nose snaps over a bead at the rim: contact alone keeps it shut.

    Between 0.1 and 2.6 N at the nose opens it (a test measures it); makers do not say.

    Attributes:
        mechanism: Its hinge, at +x of the rim.
        at: Where the hinge is [m].
        reach: From the hinge to the nose [m].
        forms: What it is made of, in its own frame: the hinge is the origin, it lies along -x.
        mass: What it weighs [kg].
    """

    mechanism: Flap
    at: Vector
    reach: float
    forms: tuple[Form, ...]
    mass: float

    def add_to(self, spec: mujoco.MjSpec, piece: str, body: mujoco.MjsBody) -> None:
        """Build its body onto the body of the piece of ware."""
        flap = self.mechanism
        lid = add_moving(spec, body, flap, self.at, (0, 1, 0), friction=2e-4, damping=2e-4)
        assemble(spec, lid, piece, self.forms, self.mass)
        x, y, z = self.at
        apart = 2 * _NOSE - _BITE  # sideways: to pass each other both give way
        nose = (-self.reach, 0.0, -0.0012 - _NOSE)
        bead = (x - self.reach + apart, y, z - 0.0012 + _NOSE)
        for on, geom, pos in ((lid, "nose", nose), (body, "bead", bead)):
            on.add_geom(
                name=f"{flap.name}_{geom}",
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=(_NOSE, 0.0, 0.0),
                pos=pos,
                group=COLLISION_GROUP,
                contype=0,
                conaffinity=0,
                mass=0.0,
            )
        spec.add_pair(
            name=f"{flap.name}_snap",
            geomname1=f"{flap.name}_nose",
            geomname2=f"{flap.name}_bead",
            condim=1,
            solref=SOLREF,
            solimp=SOLIMP,
        )
