"""Grasp a vessel from the side and lift it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from labutopia_lerobot.predicates import gripped
from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.world import Pose, Thing, World

OPEN = 0.08
"""Fully open gripper [m] (Franka Hand data sheet: 80 mm stroke)."""

APPROACH = math.radians(-60.0)
"""Yaw of a horizontal grasp relative to the bearing from the robot [rad].

Pointing straight ahead, a Panda's wrist cannot reach low and level (joint 6 ends at 3.75 rad);
turned by 60 degrees all joints stay a fifth of their range from their ends over the whole start
region.
"""


class Graspable(Thing, Protocol):
    """A thing with a place for the fingers."""

    @property
    def grip_height(self) -> float:
        """Height of the grasp above the base [m]."""
        ...

    @property
    def grip_width(self) -> float:
        """Outer diameter at the grasp [m]."""
        ...


@dataclass(frozen=True)
class Pick:
    """The seven phases of the paper ("Pick"), with the horizontal grasp of the original.

    Attributes:
        thing: What to pick up.
        lift: How far to raise it [m].
        standoff: Distance from which the last approach starts [m] (original: 0.1, before).
        squeeze: How much narrower than the thing the closed gripper is commanded [m].
    """

    thing: Graspable
    lift: float
    standoff: float = 0.10
    hover: float = 0.10
    squeeze: float = 0.012

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield hover, lower, reach, settle, close, lift and hold."""
        thing = frozenset({self.thing.name})
        shut = self.thing.grip_width - self.squeeze
        held = gripped(self.thing)
        away = arrived(within=0.015, within_rad=0.1)
        there = arrived(within=0.004)
        yield Phase("hover", lambda w: self._before(w).moved(z=self.hover), OPEN, away)
        yield Phase("lower", self._before, OPEN, away)
        yield Phase("reach", self._grasp, OPEN, there, touches=thing, speed=0.15)
        here = self._grasp(world)
        yield Phase("settle", lambda w: here, OPEN, waited(0.2), touches=thing)
        yield Phase(
            "close",
            lambda w: here,
            shut,
            lambda w, target, elapsed: elapsed > 0.3 and held.holds(w),
            touches=thing,
            timeout_s=2.0,
        )
        raised = here.moved(z=self.lift)
        carrying = thing | {"bench"}
        yield Phase("lift", lambda w: raised, shut, there, carrying, self.thing, speed=0.2)
        yield Phase("hold", lambda w: raised, shut, waited(0.1), thing, self.thing)

    def _grasp(self, world: World) -> Pose:
        """Gripper pose at the grasp: horizontal, turned from the bearing of the thing."""
        thing = world.pose(self.thing)
        centre = thing.position_w + self.thing.grip_height * thing.z_axis
        dx, dy, _ = centre - world.robot_base.position_w
        yaw = math.atan2(dy, dx) + APPROACH
        forward = np.array([math.cos(yaw), math.sin(yaw), 0.0])
        up = np.array([0.0, 0.0, 1.0])
        return Pose(centre, np.column_stack([up, np.cross(forward, up), forward]))

    def _before(self, world: World) -> Pose:
        return self._grasp(world).advanced(-self.standoff)
