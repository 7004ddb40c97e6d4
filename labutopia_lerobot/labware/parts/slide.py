"""Sliding parts: sashes on counterweights, panes, trays, carriages, plungers."""

from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.form import towards
from labutopia_lerobot.labware.parts.mechanism import add_moving, in_millimetres
from labutopia_lerobot.labware.parts.motor import Motor
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world import Pose, World
from labutopia_lerobot.world.model import COLLISION_GROUP

_GAIN = 20.0
"""Of its motor, in parts of the effort [s/m]; ours: its winding
brakes while it is off, and a hand moves it by 40 mm/s."""


@dataclass(frozen=True)
class Slide:
    """A part on straight guides that stays where it is left.

    The frame of its name is that of its body; that of its joint lies where the body starts, z the
    way it goes.

    Attributes:
        name: Name of its body and of its frame.
        widest: Travel at which it stops [m].
        friction: Of its guides [N].
        effort: Force with which a hand moves it [N].
        stall: Force that its motor has at most [N]; 0 if it has none.
    """

    name: str
    widest: float
    friction: float = 1.0
    effort: float = 6.0
    stall: float = 0.0

    @property
    def joint(self) -> str:
        """Name of its slide [m]; 0 is where it is built."""
        return f"{self.name}_slide"

    @property
    def motor(self) -> Motor:
        """What a drive moves it with."""
        return Motor(self.name, self.joint, self.stall, _GAIN * self.effort)

    def format_position(self, position: float) -> str:
        """Write a travel [m] with a unit."""
        return in_millimetres(position)

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to it gets when it goes on by another travel [m]."""
        return Pose(pose.position_w + by * world.frame(self.joint).z_axis, pose.rotation_w)

    def add_to(
        self,
        spec: mujoco.MjSpec,
        box: mujoco.MjsBody,
        pos: Vector,
        along: Vector,
        *,
        balanced: bool = False,
        begins: float = 0.0,
    ) -> mujoco.MjsBody:
        """Hang its body, still without forms, into its guides.

        Args:
            spec: What the box is in (angles in radians).
            box: What it slides on; the two do not collide.
            pos: Where its origin starts [m].
            along: The way it goes, a unit vector.
            balanced: Whether a counterweight or a spring carries it.
            begins: Travel at which an episode begins [m].

        Returns:
            The body, turned as the box is.
        """
        body = add_moving(
            spec,
            box,
            self,
            pos,
            along,
            slides=True,
            friction=self.friction,
            damping=4.0 * self.friction,
            balanced=balanced,
            begins=begins,
        )
        if self.stall:
            self.motor.add_to(spec)
        body.add_site(name=self.name, group=COLLISION_GROUP)
        box.add_site(name=self.joint, pos=pos, quat=towards(along), group=COLLISION_GROUP)
        return body


@dataclass(frozen=True)
class Sash(Slide):
    """A pane that is pushed up, on counterweights; its frame lies at its lower edge."""

    friction: float = 8.0
    effort: float = 30.0

    def add_to(
        self,
        spec: mujoco.MjSpec,
        box: mujoco.MjsBody,
        pos: Vector,
        along: Vector = (0.0, 0.0, 1.0),
        *,
        balanced: bool = True,
        begins: float = 0.0,
    ) -> mujoco.MjsBody:
        """Hang its body into its guides; see `Slide.add_to`."""
        return super().add_to(spec, box, pos, along, balanced=balanced, begins=begins)
