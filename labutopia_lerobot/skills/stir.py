"""Stir in a vessel with the rod in the hand."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.skills.posture import UP, upright_in_hand
from labutopia_lerobot.skills.skill import Phase, Target, arrived, carrier, waited
from labutopia_lerobot.world import OpenVessel, Pose, Thing, World


@dataclass(frozen=True)
class Stir:
    """The phases of the paper ("Stir"): lift, go over, insert, circle, retract, hold.

    The tip circles counterclockwise, seen from above, about the axis of the vessel.

    Attributes:
        rod: The rod in the hand; the origin of its frame is its tip.
        vessel: Where to stir.
        turns: How often the tip goes round, at most where something is waited for.
        radius: Radius of the circle as a share of the mouth's (original: 9 mm of 28 mm).
        turn_s: How long one turn takes [s] (original: 3.5).
        bottom_gap: Height of the tip above the base of the vessel while stirring [m].
        rise: How far the rod is lifted at first [m].
        clearance: Height of the tip above the mouth at the end [m].
        until: Fact that is waited for, if any.
    """

    rod: Thing
    vessel: OpenVessel
    turns: float = 5.1
    radius: float = 1 / 3
    turn_s: float = 2.0
    bottom_gap: float = 0.012
    rise: float = 0.02
    clearance: float = 0.10
    until: Predicate | None = None

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield lift, over, insert, circle, retract and hold."""
        rod, shut = self.rod, world.commanded_opening
        own = frozenset({rod.name})
        inside = own | {self.vessel.name}  # to the planner a vessel is solid
        there = arrived(within=0.004)
        raised = world.gripper.moved(z=self.rise)
        # A stretched arm may not get it any higher, and need not.
        yield Phase("lift", lambda w: raised, shut, there, own, rod, timeout_s=2.0, may_fail=True)
        above = self._tip_at(world, height=world.pose(rod).position_w[2])
        yield Phase("over", above, shut, there, own, rod)
        mouth = world.frame(self.vessel.rim).position_w[2]
        deep = mouth - self.vessel.height + self.bottom_gap
        yield Phase("insert", self._tip_at(world, deep), shut, there, inside, rod, speed=0.12)
        circling = self._tip_circling(world, deep)
        timeout_s = 2 * self.turns * self.turn_s
        yield Phase("circle", circling, shut, self._stirred, inside, rod, timeout_s=timeout_s)
        out = self._tip_at(world, mouth + self.clearance)
        yield Phase("retract", out, shut, there, inside, rod, speed=0.12)
        yield Phase("hold", out, shut, waited(0.1), own, rod)

    def _stirred(self, world: World, target: Pose, elapsed: float) -> bool:
        until = self.until
        return elapsed >= self.turns * self.turn_s or (until is not None and until.holds(world))

    def _tip_at(self, world: World, height: float) -> Target:
        """Return the gripper pose with the tip on the vessel's axis, `height` [m] up the world."""
        point = world.frame(self.vessel.rim).position_w * (1, 1, 0) + height * UP
        hand = carrier(world, self.rod)(upright_in_hand(world, self.rod, point))
        return lambda w: hand

    def _tip_circling(self, world: World, height: float) -> Target:
        """Return the gripper pose with the tip on the circle, which moves on with the time."""
        middle, began = self._tip_at(world, height)(world), world.time
        radius = self.radius * self.vessel.mouth_radius
        ahead, left = radius * world.robot_base.x_axis, radius * world.robot_base.y_axis

        def target(world: World) -> Pose:
            angle = 2 * math.pi * (world.time - began) / self.turn_s
            return middle.moved(*(math.cos(angle) * ahead + math.sin(angle) * left))

        return target
