"""A lid on a hinge at its back edge."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.mechanism import add_moving, in_degrees
from labutopia_lerobot.labware.parts.openable import swung
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world import Pose, World
from labutopia_lerobot.world.model import COLLISION_GROUP

_SLOW = 0.7
"""Damping of a gas spring, in parts of the torque with which it lifts a shut lid [s/rad]; ours: the
lid rises within a second and a half, without a bounce."""
_ALONG_Y = (math.sqrt(0.5), -math.sqrt(0.5), 0.0, 0.0)  # z axis along y


@dataclass(frozen=True)
class Lid:
    """A lid that opens upwards and back; a gas spring carries it: it stays where it is left.

    The frame of its name lies at its front edge, x to the back, z up; that of its joint at the
    hinge, z along the axis about which it opens.

    Attributes:
        name: Name of its body and of its frame.
        widest: Where it stops [rad].
        reach: From the hinge to its front edge [m].
        friction: Of the hinge [N m].
        begins: How far it is open when an episode begins [rad].
        lift: Torque with which a stronger spring opens it as soon as nothing keeps it shut, half
            of it where it is wide open [N m]; 0 for none.
    """

    name: str
    widest: float
    reach: float
    friction: float = 0.15
    begins: float = 0.0
    lift: float = 0.0

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 is closed."""
        return f"{self.name}_hinge"

    @property
    def closed_within(self) -> float:
        """Position below which there is no gap [rad]; ours, as that of what feels whether it is."""
        return math.radians(2.0)

    @property
    def effort(self) -> float:
        """Torque with which a hand at its front edge opens it [N m]."""
        return 4.0 * self.friction

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return in_degrees(position)

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to the lid gets when it opens by another angle [rad]."""
        return swung(pose, world.frame(self.joint), by)

    def add_to(self, spec: mujoco.MjSpec, box: mujoco.MjsBody, hinge: Vector) -> mujoco.MjsBody:
        """Hang its body, still without forms, onto a box whose front faces -x.

        Args:
            spec: What the box is in (angles in radians).
            box: What it closes; the two do not collide.
            hinge: Where the middle of the hinge is [m].

        Returns:
            The body: its origin is the hinge, the closed lid lies along its -x.
        """
        body = add_moving(
            spec,
            box,
            self,
            hinge,
            (0, 1, 0),
            friction=self.friction,
            damping=0.3 * self.friction + _SLOW * self.lift,
            balanced=True,
            begins=self.begins,
        )
        if self.lift:
            (joint,) = body.joints
            joint.springref = 2 * self.widest
            joint.stiffness = [self.lift / joint.springref, 0.0, 0.0]
        body.add_site(name=self.name, pos=(-self.reach, 0, 0), group=COLLISION_GROUP)
        box.add_site(name=self.joint, pos=hinge, quat=_ALONG_Y, group=COLLISION_GROUP)
        return body
