"""Doors and drawers: a part that moves on one joint, and the bar to move it by."""

import math
from dataclasses import dataclass
from typing import Literal

import mujoco
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.parts.catch import Catch
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_part
from labutopia_lerobot.world import Pose, World
from labutopia_lerobot.world.model import COLLISION_GROUP

LYING = (math.cos(math.pi / 4), math.sin(math.pi / 4), 0.0, 0.0)  # z axis along -y
_ACROSS = (math.cos(math.pi / 4), 0.0, math.sin(math.pi / 4), 0.0)  # z axis along x


@dataclass(frozen=True)
class Handle:
    """A round bar on two posts in front of a door or drawer.

    The frame of its name lies in the middle of the bar: z along the bar, up or to the right of who
    stands before it; x into the door or drawer.

    Attributes:
        name: Name of its body and of its frame.
        length: Length of the bar [m].
        diameter: Diameter of the bar [m].
        standoff: From the front of the door or drawer to the middle of the bar [m].
    """

    name: str
    length: float
    diameter: float = 0.014
    standoff: float = 0.048

    def add_to(self, parent: mujoco.MjsBody, pos: Vector, material: str, *, lying: bool) -> None:
        """Build its body onto a door or drawer whose front faces -x.

        Args:
            parent: The door or drawer.
            pos: Where on the front it is [m].
            material: Name of a material of the spec.
            lying: Whether the bar is horizontal.
        """
        x, y, z = pos
        body = parent.add_body(
            name=self.name,
            pos=(x - self.standoff, y, z),
            quat=LYING if lying else (1.0, 0.0, 0.0, 0.0),
        )
        body.add_site(name=self.name, group=COLLISION_GROUP)
        radius, half = self.diameter / 2, self.length / 2
        # Drawn steel of 14 mm weighs 1.2 kg/m; the bar is a tube of a third of that.
        bar = (radius, half, 0.0)
        add_part(body, f"{self.name}_bar", bar, (0, 0, 0), material, mass=0.08, shape=CYLINDER)
        for end, sign in (("near", -1), ("far", 1)):
            add_part(
                body,
                f"{self.name}_post_{end}",
                (0.8 * radius, self.standoff / 2, 0.0),
                (self.standoff / 2, 0.0, sign * (half - radius)),
                material,
                mass=0.02,
                shape=CYLINDER,
                quat=_ACROSS,
            )


@dataclass(frozen=True)
class Door[Grip]:
    """A door on an upright hinge; its joint and the frame of that name, z along the axis.

    Attributes:
        name: Name of its body.
        handle: What to hold it by.
        widest: Angle at which it stops [rad].
        closed_within: Angle below which there is no gap [rad].
        catch: Mechanism that keeps it shut, if any; the builder of the door adds it.
        hinge: On which side it hangs, for who stands before it.
    """

    name: str
    handle: Grip
    widest: float
    closed_within: float
    catch: Catch | None = None
    hinge: Literal["left", "right"] = "left"

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 is closed."""
        return f"{self.name}_hinge"

    @property
    def effort(self) -> float:
        """Torque with which a hand at the handle opens it [N m]."""
        return 5.0

    def add_to(
        self,
        spec: mujoco.MjSpec,
        box: mujoco.MjsBody,
        pos: Vector,
        *,
        ajar: float,
        friction: float,
        damping: float,
    ) -> mujoco.MjsBody:
        """Hang its body, still empty, on an edge of a box whose front faces -x.

        Args:
            spec: What the box is in (angles in radians).
            box: What it closes; the two do not collide.
            pos: Lower end of the hinge [m].
            ajar: How far it stands open at the start [rad].
            friction: Dry friction of hinge and seal [N m].
            damping: Of the hinge [N m s/rad].

        Returns:
            The body; its origin is at `pos`, the closed door lies along its -y, or along its y
            where the hinge is on the right.
        """
        left = self.hinge == "left"
        half = -ajar / 2 if left else ajar / 2
        body = box.add_body(name=self.name, pos=pos, quat=(math.cos(half), 0, 0, math.sin(half)))
        # MuJoCo reads `ref` as the joint's position in the pose that is built, and starts there.
        body.add_joint(
            name=self.joint,
            type=mujoco.mjtJoint.mjJNT_HINGE,
            axis=(0, 0, -1 if left else 1),
            range=(0.0, self.widest),
            ref=ajar,
            frictionloss=friction,
            damping=damping,
        )
        opens = (0, 1, 0, 0) if left else (1, 0, 0, 0)  # z axis down or up: it opens
        box.add_site(name=self.joint, pos=pos, quat=opens)
        spec.add_exclude(bodyname1=box.name, bodyname2=self.name)
        return body

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return f"{math.degrees(position):.3g} deg"

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to the door gets when it opens by another angle [rad]."""
        return swung(pose, world.frame(self.joint), by)


def swung(pose: Pose, hinge: Pose, by: float) -> Pose:
    """Return a pose turned about the z axis of a hinge's frame by an angle [rad]."""
    turn = Rotation.from_rotvec(by * hinge.z_axis).as_matrix()
    return Pose(
        hinge.position_w + turn @ (pose.position_w - hinge.position_w), turn @ pose.rotation_w
    )


@dataclass(frozen=True)
class Drawer:
    """A drawer on straight slides; its joint and the frame of that name, z the way it opens.

    Attributes:
        name: Name of its body.
        handle: What to hold it by.
        widest: Travel at which it stops [m].
        closed_within: Travel below which there is no gap [m].
    """

    name: str
    handle: Handle
    widest: float
    closed_within: float

    @property
    def joint(self) -> str:
        """Name of its slide [m]; 0 is closed."""
        return f"{self.name}_slide"

    @property
    def effort(self) -> float:
        """Force with which a hand at the handle opens it [N]."""
        return 20.0

    def format_position(self, position: float) -> str:
        """Write a travel [m] with a unit."""
        return f"{position:.3g} m"

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to the drawer gets when it opens by another travel [m]."""
        return Pose(pose.position_w + by * world.frame(self.joint).z_axis, pose.rotation_w)
