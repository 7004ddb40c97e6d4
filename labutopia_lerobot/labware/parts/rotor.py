"""A rotor: what turns on and on in its bearings."""

import math
from dataclasses import dataclass

import mujoco

from labutopia_lerobot.labware.parts.mechanism import add_moving, in_degrees
from labutopia_lerobot.labware.parts.motor import Motor
from labutopia_lerobot.labware.parts.solid import Vector
from labutopia_lerobot.world.model import COLLISION_GROUP

_GAIN = 0.3
"""Of its motor, in parts of the effort [s/rad]; ours: its winding
brakes while it is off, and a hand turns it by a turn in three seconds."""


@dataclass(frozen=True)
class Rotor:
    """A body that turns, without an end unless it has stops; the frame of its name is the body's.

    Attributes:
        name: Name of its body and of its frame.
        friction: Of its bearings, with the brush or gear of its motor [N m].
        effort: Torque with which a hand turns it [N m].
        widest: A full turn, or where it stops [rad].
        stall: Torque that its motor has at most [N m]; 0 if it has none.
    """

    name: str
    friction: float = 0.005
    effort: float = 0.05
    widest: float = 2 * math.pi
    stall: float = 0.0

    @property
    def joint(self) -> str:
        """Name of its hinge [rad]."""
        return f"{self.name}_hinge"

    @property
    def motor(self) -> Motor:
        """What a drive turns it with."""
        return Motor(self.name, self.joint, self.stall, _GAIN * self.effort)

    def format_position(self, position: float) -> str:
        """Write an angle [rad] with a unit."""
        return in_degrees(position)

    def add_to(
        self,
        spec: mujoco.MjSpec,
        box: mujoco.MjsBody,
        pos: Vector,
        axis: Vector = (0, 0, 1),
        *,
        balanced: bool = False,
        begins: float = 0.0,
    ) -> mujoco.MjsBody:
        """Hang its body, still without forms, into its bearings.

        Args:
            spec: What the box is in (angles in radians).
            box: What it turns in; the two do not collide.
            pos: Where its origin is [m].
            axis: About which it turns, a unit vector.
            balanced: Whether a spring carries it.
            begins: Angle at which an episode begins [rad].

        Returns:
            The body, turned as the box is.
        """
        friction = self.friction
        body = add_moving(
            spec,
            box,
            self,
            pos,
            axis,
            balanced=balanced,
            begins=begins,
            endless=self.widest == 2 * math.pi,
            friction=friction,
            damping=0.0 if self.stall else 0.1 * self.effort,
        )
        if self.stall:
            self.motor.add_to(spec)
        body.add_site(name=self.name, group=COLLISION_GROUP)
        return body
