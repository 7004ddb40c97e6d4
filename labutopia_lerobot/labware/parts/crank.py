"""A crank: it takes a platform round a circle, which does not turn itself."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.assembly import assemble
from labutopia_lerobot.labware.parts.form import Rod
from labutopia_lerobot.labware.parts.rotor import Rotor
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world.model import COLLISION_GROUP, SOLIMP

_GEARED = (0.004, 1.0)
"""Of the constraint that keeps the platform's direction: as hard as the time step allows."""


@dataclass(frozen=True)
class Crank:
    """A rotor with a pin off its axis, and on the pin a platform that a gear keeps from turning.

    Attributes:
        rotor: What turns.
        platform: Name of the body that it carries.
        throw: From the axis to the pin [m]; it starts to the front.
    """

    rotor: Rotor
    platform: str
    throw: float

    def add_to(
        self, spec: mujoco.MjSpec, piece: str, box: mujoco.MjsBody, pos: Vector, lift: float
    ) -> mujoco.MjsBody:
        """Build the rotor, with its pin, and the platform, still without forms.

        Args:
            spec: What the box is in (angles in radians).
            piece: Name of the piece.
            box: What it turns on; it touches neither.
            pos: Where the axis meets the box [m].
            lift: How high above that the platform's origin is [m].

        Returns:
            The platform, turned as the box is; its origin lies on the axis of the pin.
        """
        rotor = self.rotor.add_to(spec, box, pos)
        pin = Rod((-self.throw, 0, 0), (-self.throw, 0, lift), 0.020, "dark_steel")
        assemble(spec, rotor, piece, [pin], 0.2)
        platform = rotor.add_body(name=self.platform, pos=(-self.throw, 0.0, lift))
        gear = f"{self.platform}_gear"
        platform.add_joint(name=gear, type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 0, 1))
        platform.add_site(name=self.platform, group=COLLISION_GROUP)
        spec.add_equality(
            name=gear,
            type=mujoco.mjtEq.mjEQ_JOINT,
            objtype=mujoco.mjtObj.mjOBJ_JOINT,
            name1=gear,
            name2=self.rotor.joint,
            data=[0.0, -1.0, *[0.0] * 10],
            solref=_GEARED,
            solimp=SOLIMP,
        )
        spec.add_exclude(bodyname1=box.name, bodyname2=self.platform)
        return platform
