"""Push a lid down with the closed gripper."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.predicates import closed
from labutopia_lerobot.predicates.openables import Openable
from labutopia_lerobot.skills.posture import hand_at
from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.world import Approach, Pose, World

_POSTURE = Approach(yaw=math.radians(-35.0), pitch=math.radians(65.0))
"""How the hand points: to the right, as for vessels, and down; ours: the default robot then keeps
all joints 0.5 rad from their ends from where a lid is open by 30 degrees."""
_AHEAD, _BEYOND = 0.15, 0.02
"""How far ahead of the lid the hand goes, and beyond where it is shut [rad]; ours."""


class Hinged(Openable, Protocol):
    """A lid; the frame of its name lies at its front edge, x to the back, z up."""

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to it gets when it opens by another angle [rad]."""
        ...


@dataclass(frozen=True)
class PushLid:
    """Come from above, push the lid down by its front edge until it is shut, and leave.

    Attributes:
        lid: The lid to shut.
        thickness: How high above the frame of the lid its upper side is [m].
        inward: How far behind its front edge it is pushed [m].
        standoff: Height from which the hand comes, and to which it leaves [m].
        posture: How the hand points.
        finger: Half the thickness of a finger, for a lid so wide open that its side pushes [m].
    """

    lid: Hinged
    thickness: float
    inward: float = 0.025
    standoff: float = 0.08
    posture: Approach = _POSTURE
    finger: float = 0.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield approach, close, touch, push, hold and leave."""
        touches, shut = frozenset({self.lid.name}), closed(self.lid)
        opening = world.commanded_opening
        before = self._at(world, 0.0).moved(z=self.standoff)
        yield Phase("approach", lambda w: before, opening, arrived(0.015, 0.1), timeout_s=8.0)
        yield Phase("close", lambda w: before, 0.0, _empty, timeout_s=2.0)
        upon = self._at(world, 0.0)
        yield Phase("touch", lambda w: upon, 0.0, arrived(0.006, 0.1), touches, speed=0.1)
        yield Phase(
            "push",
            lambda w: self._at(w, max(-_AHEAD, -w.joint(self.lid.joint) - _BEYOND)),
            0.0,
            lambda w, target, elapsed: shut.holds(w),
            touches,
            speed=0.12,
            timeout_s=15.0,
        )
        here = self._at(world, 0.0)
        yield Phase("hold", lambda w: here, 0.0, waited(0.3), touches)
        away = world.gripper.moved(z=self.standoff)
        yield Phase("leave", lambda w: away, 0.0, arrived(0.015, 0.1), touches)

    def _at(self, world: World, by: float) -> Pose:
        """Return the pose of the hand on the lid when it has opened by another angle [rad]."""
        frame = self.lid.carried(world.frame(self.lid.name), world, by)
        point = frame.position_w + self.inward * frame.x_axis + self.thickness * frame.z_axis
        hand = hand_at(world, point, self.posture).advanced(-world.robot.finger_reach)
        x, y, z = self.finger * abs(float(hand.x_axis @ frame.z_axis)) * frame.z_axis
        return hand.moved(x, y, z)


def _empty(world: World, target: Pose, elapsed: float) -> bool:
    """The closed gripper holds nothing."""
    return world.gripper_opening < 0.002
