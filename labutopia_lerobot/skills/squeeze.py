"""Squeeze liquid out of a soft bottle that stands where it is."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.predicates.squeezing import Squeezable
from labutopia_lerobot.skills.posture import hand_at
from labutopia_lerobot.skills.skill import Phase, arrived, waited
from labutopia_lerobot.world import CONTROL_HZ, Graspable, Pose, World


class SoftBottle(Graspable, Squeezable, Protocol):
    """A bottle with a soft wall, a spout and a place for the fingers."""


@dataclass(frozen=True)
class Squeeze:
    """Hover, lower, reach, settle, then squeeze and release until enough is out, and withdraw.

    The gripper closes slowly, so that the jet is one of a wash bottle and not a burst, until enough
    has left or it is as narrow as it will get. Then it lets the bottle breathe, and squeezes again
    if need be.

    Attributes:
        bottle: What to squeeze.
        amount_ml: How much is to leave it [ml].
        standoff: Distance from which the last approach starts, and to which the hand leaves [m].
        hover: How much higher than that the first approach ends [m].
        deep: How much narrower than the bottle the gripper is commanded at most [m]; the wall
            pushes back and gives way by about three quarters of that.
        speed: How fast the command narrows [m/s]: 21 ml leave a 250 ml bottle in 2.5 s.
        pause_s: How long it is kept squeezed [s], for the jet to end.
        depth: How far beyond the middle of the pads the bottle's axis lies [m], as in `Pick`.
        strokes: How often it is squeezed at most.
    """

    bottle: SoftBottle
    amount_ml: float
    standoff: float = 0.10
    hover: float = 0.14
    deep: float = 0.050
    speed: float = 0.012
    pause_s: float = 0.5
    depth: float = 0.004
    strokes: int = 4

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield hover, lower, reach, settle, the strokes (squeeze, hold, release) and withdraw."""
        touches, wide = frozenset({self.bottle.name}), world.robot.max_opening
        grasp = self._grasp(world)
        before = grasp.advanced(-self.standoff)
        above = before.moved(z=self.hover)
        away, there = arrived(within=0.015, within_rad=0.1), arrived(within=0.004)
        yield Phase("hover", lambda w: above, wide, away)
        yield Phase("lower", lambda w: before, wide, away)
        yield Phase("reach", lambda w: grasp, wide, there, touches, speed=0.15)
        yield Phase("settle", lambda w: grasp, wide, waited(0.2), touches)
        for _ in range(self.strokes):
            shut = self.bottle.grip_width
            yield Phase("close", lambda w: grasp, shut, waited(0.4), touches)
            while shut > self.bottle.grip_width - self.deep and not self._enough(world):
                shut -= self.speed / CONTROL_HZ
                yield Phase("squeeze", lambda w: grasp, shut, waited(0.0), touches)
            yield Phase("hold", lambda w: grasp, shut, waited(self.pause_s), touches)
            yield Phase("release", lambda w: grasp, wide, waited(0.8), touches)
            if self._enough(world):
                break
        yield Phase("withdraw", lambda w: before, wide, away, touches, speed=0.15)
        yield Phase("done", lambda w: before, wide, waited(0.1))

    def _grasp(self, world: World) -> Pose:
        """Gripper pose around the body of the bottle."""
        bottle = world.pose(self.bottle)
        centre = bottle.position_w + self.bottle.grip_height * bottle.z_axis
        return hand_at(world, centre).advanced(-self.depth)

    def _enough(self, world: World) -> bool:
        return world.reading(self.bottle.squeezed).value >= self.amount_ml
