"""Pour from the vessel in the hand into another."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.spatial.transform import Rotation

from labutopia_lerobot.skills.posture import UP, hand_at, horizontal, upright_in_hand
from labutopia_lerobot.skills.skill import Phase, Target, arrived, carrier, waited
from labutopia_lerobot.world import FloatArray, OpenVessel, Pose, Standing, World

_BASE_GAP = 0.010
"""Least height of the base of what is poured from above the other mouth [m]: with 2 mm less the
hand has to dodge the other vessel in mid-swing."""


_LOW = 0.10
"""Height up to which a vessel is poured from at full speed [m]."""
_SPARE = 0.015
"""How much higher a taller one is kept [m]; ours: as it leans, its base and the hand would pass
the other rim 5 and 4 mm above it, and policies that have learned that strike it. The lip of one
that tapers, whose hand is further up, stays: from 15 mm higher 4 ml of 100 miss the mouth."""
_LEAN = math.radians(60.0)
"""Angle to which a taller one leans first [rad]: less than a third full, none runs over there."""


class Pourable(OpenVessel, Standing, Protocol):
    """A vessel that can be poured from."""

    @property
    def taper(self) -> float:
        """Angle beyond the level at which its wall drains [rad]; 0 for a beaker."""
        ...


@dataclass(frozen=True)
class Pour:
    """The phases of the paper ("Pour"): start position, ready, tilt, pause, tilt back, stabilise.

    The vessel tilts to the left of the hand about the point of its lip that the liquid leaves; that
    point stays where it is, over the middle of the other vessel's mouth.

    Attributes:
        thing: The thing in the hand.
        into: What to pour into.
        drop: Height of the lip above the other mouth [m] (original: 0.1 to 0.2): the hand, 0.2 m
            wide, turns with the vessel and then reaches 0.09 m below the lip. Of a tall vessel the
            lip is higher, most until it leans so far that its base passes over the other mouth.
        hover: How much higher the start position is [m].
        angle: How far it is tilted [rad]: a little beyond the level, that a lip's bulge drains too;
            one that tapers is tilted further by as much as it tapers.
        short: How far before the middle of the other mouth the lip is [m]: liquid leaves it with
            some speed, and flies about that far on its way down.
        turn_speed: How fast it is tilted [rad/s]; faster, liquid shoots over the other vessel. One
            taller than `_LOW` leans at that speed, before anything flows, and then is tilted more
            slowly, by the square of its height: liquid gathers speed along its wall.
        pause_s: How long it is kept tilted [s].
    """

    thing: Pourable
    into: OpenVessel
    drop: float = 0.10
    hover: float = 0.05
    angle: float = math.radians(105.0)
    short: float = 0.025
    turn_speed: float = 0.7
    pause_s: float = 1.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield start, ready, tilt, pause, tilt back and stabilise."""
        thing, shut = self.thing, world.commanded_opening
        own = frozenset({thing.name})
        tall, speed = thing.height / _LOW, self.turn_speed
        spare = _SPARE if tall > 1.0 else 0.0
        drop, mouth = self.drop + (0.0 if thing.taper else spare), world.frame(self.into.rim)
        pivot = Pivot.over(world, thing, mouth, drop, self.short, _BASE_GAP + spare)
        ready = carrier(world, thing)(pivot.tilted(0.0))
        above = ready.moved(z=self.hover)
        there = arrived(within=0.006)
        yield Phase("start", lambda w: above, shut, arrived(within=0.015), own, thing)
        yield Phase("ready", lambda w: ready, shut, there, own, thing)
        if tall > 1.0:
            leaning = pivot.towards(world, _LEAN)
            yield Phase("lean", leaning, shut, there, own, thing, turn_speed=speed)
            speed /= tall**2
        angle = self.angle + thing.taper
        tilting, timeout_s = pivot.towards(world, angle), 2 * angle / speed
        yield Phase("tilt", tilting, shut, there, own, thing, turn_speed=speed, timeout_s=timeout_s)
        yield Phase("pause", tilting, shut, waited(self.pause_s), own, thing)
        back = pivot.towards(world, 0.0)
        yield Phase("tilt_back", back, shut, there, own, thing, turn_speed=1.2)
        yield Phase("stabilise", back, shut, waited(0.3), own, thing)


@dataclass(frozen=True)
class Pivot:
    """Turns a held vessel about a point of its lip, which is fixed but for its height.

    Attributes:
        thing: The vessel.
        upright: How it is turned when upright, shape (3, 3), world frame.
        axis: Horizontal axis that the hand points along, shape (3,), world frame.
        lip_w: The point when it is lowest, shape (3,), metres, world frame.
        drop: Height of that above the other mouth [m].
        gap: Least height of the vessel's base above the other mouth [m].
    """

    thing: Pourable
    upright: FloatArray
    axis: FloatArray
    lip_w: FloatArray
    drop: float
    gap: float

    @classmethod
    def over(
        cls,
        world: World,
        thing: Pourable,
        mouth: Pose,
        drop: float,
        short: float,
        gap: float = _BASE_GAP,
    ) -> "Pivot":
        """Return the pivot above a mouth by a height [m], and short of its middle [m]."""
        axis = horizontal(hand_at(world, mouth.position_w).z_axis)
        upright = upright_in_hand(world, thing, mouth.position_w).rotation_w
        left = np.cross(UP, axis)
        return cls(thing, upright, axis, mouth.position_w + drop * UP - short * left, drop, gap)

    @property
    def left(self) -> FloatArray:
        """Horizontal direction to which the vessel tilts, shape (3,), world frame."""
        return np.cross(UP, self.axis)

    def tilted(self, angle: float) -> Pose:
        """Return the pose of the vessel when it leans to the left by an angle [rad]."""
        turn = Rotation.from_rotvec(-angle * self.axis)
        lip = turn.apply(self.thing.mouth_radius * self.left + self.thing.height * UP)
        raised = self.lip_w + self._rise(angle) * UP
        return Pose(raised - lip, turn.as_matrix() @ self.upright)

    def _rise(self, angle: float) -> float:
        """Return how much higher the lip must be for the base to clear the other mouth [m]."""
        beside = self.thing.footprint_radius - self.thing.mouth_radius
        below = self.thing.height * math.cos(angle) + beside * math.sin(angle)
        return max(0.0, below + self.gap - self.drop)

    def towards(self, world: World, angle: float, lead: float = 0.4) -> Target:
        """Return the gripper pose a `lead` [rad] further on the way to an angle [rad].

        Along the straight line to the last pose the lip would leave its place.
        """
        carried = carrier(world, self.thing)

        def target(world: World) -> Pose:
            z_axis = world.pose(self.thing).z_axis
            lean = math.atan2(z_axis @ self.left, z_axis[2])
            return carried(self.tilted(lean + float(np.clip(angle - lean, -lead, lead))))

        return target
