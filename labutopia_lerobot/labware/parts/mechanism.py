"""Moving parts of an instrument: one joint, its range, and the force by which a hand moves it."""

import math
from typing import Protocol

import mujoco
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.solid import UNTURNED, Quaternion, Vector
from labutopia_lerobot.world.model import SOLIMP, SOLREF

_ARMATURE = 5e-5
"""Inertia that every hinge has beside its body's [kg m^2]: a finger is behind it. Without it the
stop of a rocker of 6 g would be as soft as its spring at 300 steps a second."""


class Mechanism(Protocol):
    """A part that moves on one hinge or slide; its position is 0 as it is built, and grows."""

    @property
    def name(self) -> str:
        """Name of its body."""
        ...

    @property
    def joint(self) -> str:
        """Name of its joint."""
        ...

    @property
    def widest(self) -> float:
        """Position at which it stops [rad or m]; a full turn for what turns on and on."""
        ...

    @property
    def effort(self) -> float:
        """Torque [N m] or force [N] at its joint with which a hand moves it."""
        ...

    def format_position(self, position: float) -> str:
        """Write a position with a unit."""
        ...


def in_degrees(position: float) -> str:
    """Write an angle [rad] with a unit."""
    return f"{math.degrees(position):.3g} deg"


def in_millimetres(position: float) -> str:
    """Write a travel [m] with a unit."""
    return f"{1e3 * position:.3g} mm"


def add_moving(
    spec: mujoco.MjSpec,
    parent: mujoco.MjsBody,
    mechanism: Mechanism,
    pos: Vector,
    axis: Vector,
    *,
    quat: Quaternion = UNTURNED,
    slides: bool = False,
    endless: bool = False,
    friction: float = 0.0,
    damping: float = 0.0,
    balanced: bool = False,
    begins: float = 0.0,
) -> mujoco.MjsBody:
    """Build the body of a mechanism, still without forms, and its joint.

    Args:
        spec: What the parent is in (angles in radians).
        parent: What it moves on; the two do not collide.
        mechanism: Whose names and range it has.
        pos: Origin of the body in the parent's frame [m]; a hinge goes through it.
        axis: Of the joint, in the body's frame.
        quat: Orientation of the body in the parent's frame, scalar-first.
        slides: Whether it slides; else it turns.
        endless: Whether it has no stops.
        friction: Dry friction [N m or N].
        damping: Of its grease [N m s/rad or N s/m].
        balanced: Whether a counterweight or a gas spring carries it.
        begins: Position at which an episode begins [rad or m].

    Returns:
        The body.
    """
    if begins and slides:
        x, y, z = (place + begins * part for place, part in zip(pos, axis, strict=True))
        pos = (x, y, z)
    elif begins:
        turn = Rotation.from_quat(quat, scalar_first=True)
        turn *= Rotation.from_rotvec([begins * part for part in axis])
        w, x, y, z = (float(part) for part in turn.as_quat(scalar_first=True))
        quat = (w, x, y, z)
    body = parent.add_body(name=mechanism.name, pos=pos, quat=quat, gravcomp=float(balanced))
    body.add_joint(
        name=mechanism.joint,
        type=mujoco.mjtJoint.mjJNT_SLIDE if slides else mujoco.mjtJoint.mjJNT_HINGE,
        axis=axis,
        range=(0.0, mechanism.widest),
        limited=mujoco.mjtLimited.mjLIMITED_FALSE if endless else mujoco.mjtLimited.mjLIMITED_TRUE,
        frictionloss=friction,
        damping=damping,
        armature=0.0 if slides else _ARMATURE,
        ref=begins,
        solref_limit=SOLREF,
        solimp_limit=SOLIMP,
    )
    spec.add_exclude(bodyname1=parent.name, bodyname2=mechanism.name)
    return body
