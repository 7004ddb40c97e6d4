"""Shake what is in the hand from side to side."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from scipy.spatial.transform import Rotation

from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.skills.posture import horizontal, upright_in_hand
from labutopia_lerobot.skills.skill import Phase, arrived, carrier, waited
from labutopia_lerobot.world import Pose, Thing, World


@dataclass(frozen=True)
class Shake:
    """The phases of the paper ("Shake"): go to the start, pause, left and right, return, pause.

    The thing turns about the horizontal axis along which the hand points, through the point of
    the grasp: left and right are those of somebody who looks along the fingers.

    Attributes:
        thing: The thing in the hand.
        at: Where its base is at the start and at the end.
        angle: How far it is tilted to each side [rad].
        cycles: How many times it goes left and right (paper: "repeated three times"), at most where
            something is waited for.
        until: Fact that is waited for, if any.
    """

    thing: Thing
    at: Destination
    angle: float = math.radians(22.0)
    cycles: int = 3
    until: Predicate | None = None

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield start, pause, left and right for every cycle, return and stabilise."""
        thing, shut = self.thing, world.commanded_opening
        own = frozenset({thing.name})
        point = self.at.position_w(world)
        start = carrier(world, thing)(upright_in_hand(world, thing, point))
        there = arrived(within=0.01)
        yield Phase("start", lambda w: start, shut, there, own, thing)
        yield Phase("pause", lambda w: start, shut, waited(0.3), own, thing)
        left, right = _tilted(start, self.angle), _tilted(start, -self.angle)
        for _ in range(self.cycles):
            if self.until is not None and self.until.holds(world):
                break
            yield Phase("left", lambda w: left, shut, there, own, thing, turn_speed=3.0)
            yield Phase("right", lambda w: right, shut, there, own, thing, turn_speed=3.0)
        yield Phase("return", lambda w: start, shut, there, own, thing, turn_speed=3.0)
        yield Phase("stabilise", lambda w: start, shut, waited(0.3), own, thing)


def _tilted(hand: Pose, to_the_left: float) -> Pose:
    """Turn a gripper pose about the horizontal part of its forward axis, by an angle [rad]."""
    turn = Rotation.from_rotvec(-to_the_left * horizontal(hand.z_axis))
    return Pose(hand.position_w, turn.as_matrix() @ hand.rotation_w)
