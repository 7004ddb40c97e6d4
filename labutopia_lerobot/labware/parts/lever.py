"""A handle that turns on the door, and with it the tongue that keeps the door shut."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.openable import LYING, swung
from labutopia_lerobot.labware.parts.solid import CYLINDER, Vector, add_part
from labutopia_lerobot.world import Pose, World
from labutopia_lerobot.world.model import COLLISION_GROUP

_WIDEST = math.radians(80.0)
"""Angle at which it stops [rad]; ours."""
_FRICTION = 0.3
"""Dry friction [N m]: it stays where it is left; ours, 5 N at the middle of the bar."""
_DAMPING = 0.02
"""Grease in its bearing [N m s/rad]; ours."""
_TONGUE, _TONGUE_THICKNESS, _TONGUE_WIDTH = 0.085, 0.012, 0.016
"""Length from the axis, thickness and width of the tongue [m]; ours."""
_GAP = 0.004
"""Between the tongue and the door [m]."""
_PLAY = 0.002
"""Between the tongue and the keeper [m]: a fifth of a degree of the door."""

_DOWN_LEFT = (math.cos(math.pi / 4), 0.0, -math.sin(math.pi / 4), 0.0)  # z axis along -x
_ACROSS = (math.cos(math.pi / 4), 0.0, math.sin(math.pi / 4), 0.0)  # z axis along x


@dataclass(frozen=True)
class Lever:
    """A round bar that points to the hinge and is turned down, and a tongue that then goes up.

    The frame of its name lies in the middle of the bar: z along the bar, to the right of who stands
    before it and, once it is turned, up; x into the door.

    Attributes:
        name: Name of its body and of its frame.
        length: Length of the bar, from the axis on [m].
        diameter: Diameter of the bar [m].
        standoff: From the front of the door to the middle of the bar [m].
        turn: How far to turn it [rad]; the tongue is clear of the keeper from 47 degrees on.
    """

    name: str
    length: float = 0.13
    diameter: float = 0.014
    standoff: float = 0.055
    turn: float = math.radians(65.0)

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]; 0 keeps the door shut."""
        return f"{self.name}_hinge"

    @property
    def widest(self) -> float:
        """Angle at which it stops [rad]."""
        return _WIDEST

    @property
    def effort(self) -> float:
        """Torque with which a hand on the bar turns it [N m]."""
        return 1.0

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return f"{math.degrees(position):.3g} deg"

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to the bar gets when it is turned by another angle [rad]."""
        return swung(pose, world.frame(self.joint), by)

    def add_to(self, door: mujoco.MjsBody, pos: Vector, material: str) -> None:
        """Build its body onto a door whose front faces -x.

        Args:
            door: The door.
            pos: Where on the front its axis is [m].
            material: Name of a material of the spec.
        """
        body = door.add_body(name=self.name, pos=pos)
        body.add_joint(
            name=self.joint,
            type=mujoco.mjtJoint.mjJNT_HINGE,
            axis=(-1, 0, 0),
            range=(0.0, _WIDEST),
            frictionloss=_FRICTION,
            damping=_DAMPING,
        )
        door.add_site(name=self.joint, pos=pos, quat=_DOWN_LEFT, group=COLLISION_GROUP)
        radius, half, out = self.diameter / 2, self.length / 2, self.standoff
        middle = (-out, half, 0.0)
        body.add_site(name=self.name, pos=middle, quat=LYING, group=COLLISION_GROUP)
        bar, hub = (radius, half, 0.0), (1.5 * radius, (out + radius) / 2, 0.0)
        add_part(
            body, f"{self.name}_bar", bar, middle, material, mass=0.12, shape=CYLINDER, quat=LYING
        )
        at_hub = (-(out + radius) / 2, 0.0, 0.0)
        add_part(
            body, f"{self.name}_hub", hub, at_hub, material, mass=0.10, shape=CYLINDER, quat=_ACROSS
        )
        tongue = (_TONGUE_THICKNESS / 2, _TONGUE / 2, _TONGUE_WIDTH / 2)
        at_tongue = (-_GAP - _TONGUE_THICKNESS / 2, -_TONGUE / 2, 0.0)
        add_part(body, f"{self.name}_tongue", tongue, at_tongue, material, mass=0.12)

    def add_keeper(
        self, box: mujoco.MjsBody, front: Vector, door: float, edge: float, material: str
    ) -> None:
        """Build onto the box what holds the tongue: a lip before it, on a post beside the door.

        Args:
            box: What the door closes; its front faces -x.
            front: Point of the box's front behind the axis of the lever [m].
            door: Thickness of the door [m].
            edge: From the axis to the free edge of the door, to the right [m].
            material: Name of a material of the spec.
        """
        x, y, z = front
        behind = x - door - _GAP - _TONGUE_THICKNESS - _PLAY  # back of the lip
        thick, low, high = 0.016, 0.014, 0.050
        near, far = y - edge - 0.008, y - _TONGUE - 0.015
        height, middle = (low + high) / 2, z + (high - low) / 2
        lip = (thick / 2, (near - far) / 2, height)
        at_lip = (behind - thick / 2, (near + far) / 2, middle)
        add_part(box, f"{self.name}_keeper_lip", lip, at_lip, material)
        out = x - behind + thick
        post = (out / 2, 0.010, height)
        at_post = (x - out / 2, far - 0.008, middle)
        add_part(box, f"{self.name}_keeper_post", post, at_post, material)
