"""Grasp a thing, from the side or from above, and lift it."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Literal

from labutopia_lerobot.predicates import gripped
from labutopia_lerobot.skills.posture import FROM_ABOVE, hand_at
from labutopia_lerobot.skills.skill import Condition, Phase, arrived, settled, waited
from labutopia_lerobot.world import BENCH, Approach, Graspable, Pose, World

_FINGER_GAP = 0.006
"""Least height of the finger tips above a thing's base in a grasp from above [m]: the planner keeps
the hand 4 mm off what the thing stands on."""

_SLOW_LIFT = 4.0
"""How long a lift is given to end where it is wanted [s]; ours: twice what the highest needs."""
_SHORT = 0.02
"""How much lower than wanted a slow lift may end [m]; ours."""


@dataclass(frozen=True)
class Pick:
    """The seven phases of the paper ("Pick"), with the sideways grasp of the original.

    What is flat, as a dish or a lid, is grasped from above. A grasp that misses is tried once more,
    from the start.

    Attributes:
        thing: What to pick up.
        lift: How far to raise it [m].
        support: What it stands on or in, and touches while it is lifted; None for whatever that is.
        standoff: Distance from which the last approach starts [m] (original: 0.1, before).
        hover: How far above that the hand comes first [m].
        squeeze: How much narrower than the thing the closed gripper is commanded [m]; at most half
            of its width, so that a thin rod is held gently.
        depth: How far beyond the middle of the pads its axis lies [m]; keeps the widest beaker,
            of 70 mm, off the palm; from above nothing is in its way.
        tries: How often it is grasped for.
        approach: `side`, or `above`: the hand points down, the fingers close around the rim; or how
            the hand points while it grasps at the side, for `deep` down as this robot reaches deep.
    """

    thing: Graspable
    lift: float
    support: str | None = BENCH
    standoff: float = 0.10
    hover: float = 0.10
    squeeze: float = 0.012
    depth: float = 0.004
    tries: int = 2
    approach: Literal["side", "above", "deep"] | Approach = "side"

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield hover, lower, reach, settle and close, again after a miss, then lift and hold."""
        thing = frozenset({self.thing.name})
        below = world.touched_by(self.thing.name) if self.support is None else {self.support}
        shut = self.thing.grip_width - min(self.squeeze, 0.5 * self.thing.grip_width)
        held = gripped(self.thing)
        wide = world.robot.max_opening
        away = arrived(within=0.015, within_rad=0.1)
        there = arrived(within=0.004)
        for missed in range(self.tries):
            yield Phase("hover", lambda w: self._before(w).moved(z=self.hover), wide, away)
            over = settled(0.015, 0.1) if self.approach == "deep" else away
            yield Phase("lower", self._before, wide, over)
            yield Phase("reach", self._grasp, wide, there, touches=thing, speed=0.15)
            here = self._grasp(world)
            still = partial(_stay, here)
            yield Phase("settle", still, wide, waited(0.2), touches=thing)
            yield Phase(
                "close",
                still,
                shut,
                lambda w, target, elapsed: elapsed > 0.3 and held.holds(w),
                touches=thing,
                timeout_s=2.0,
                may_fail=missed + 1 < self.tries,
            )
            if held.holds(world):
                break
            yield Phase("let go", still, wide, waited(0.5), touches=thing)
            back = partial(_stay, here.advanced(-self.standoff))
            yield Phase("back", back, wide, away, touches=thing, speed=0.15)
        raised = here.moved(z=self.lift)
        carrying = thing | below
        up = _raised(there)
        yield Phase("lift", lambda w: raised, shut, up, carrying, self.thing, speed=0.2)
        yield Phase("hold", lambda w: raised, shut, waited(0.1), thing, self.thing)

    def _grasp(self, world: World) -> Pose:
        """Gripper pose at the grasp."""
        thing = world.pose(self.thing)
        if self.approach == "above":
            height = max(self.thing.grip_height, world.robot.finger_reach + _FINGER_GAP)
            return hand_at(world, thing.position_w + height * thing.z_axis, FROM_ABOVE)
        centre = thing.position_w + self.thing.grip_height * thing.z_axis
        approach = self.approach if isinstance(self.approach, Approach) else None
        if self.approach == "deep":
            approach = world.robot.deep_approach
        return hand_at(world, centre, approach).advanced(-self.depth)

    def _before(self, world: World) -> Pose:
        return self._grasp(world).advanced(-self.standoff)


def _raised(there: Condition) -> Condition:
    """There; or as high but beside it, where an arm at the ends of its joints gets no nearer."""
    return lambda world, target, elapsed: (
        there(world, target, elapsed)
        or (elapsed > _SLOW_LIFT and world.gripper.position_w[2] > target.position_w[2] - _SHORT)
    )


def _stay(pose: Pose, world: World) -> Pose:
    """Return the pose, whatever the world does."""
    return pose
