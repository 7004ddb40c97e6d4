"""Put the foot of a held tube into a hole and let it go."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from labutopia_lerobot.places import Destination
from labutopia_lerobot.skills.posture import upright_in_hand
from labutopia_lerobot.skills.skill import Phase, arrived, carrier, waited
from labutopia_lerobot.world import BENCH, Pose, Thing, World


class Hole(Destination, Protocol):
    """A place in an opening: a bore, a rack."""

    @property
    def depth(self) -> float:
        """How deep it is [m]."""
        ...


@dataclass(frozen=True)
class Insert:
    """Carry the tube over the hole, line it up above the edge, lower it to the bottom, let go.

    Attributes:
        thing: The tube in the hand.
        into: The hole.
        hover: Height above the edge to which it is carried [m].
        align: Height above the edge at which it is lined up anew [m].
        press: How far below the bottom the foot aims, so that it surely comes [m].
        bottom: How near the bottom is near enough [m].
        retreat: How far the open hand draws back, along its own axis [m].
        yaw: How far to the left of the bearing of the hole a hand points that points down [rad].
    """

    thing: Thing
    into: Hole
    hover: float = 0.04
    align: float = 0.008
    press: float = 0.003
    bottom: float = 0.0015
    retreat: float = 0.12
    yaw: float = 0.0

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield above, lower, align, insert, settle, open and retract."""
        thing, shut, wide = self.thing, world.commanded_opening, world.robot.max_opening
        own = frozenset({thing.name})
        # The floor of a rack is thinner than what is kept clear of the bench.
        touches = own | {self.into.support, BENCH}
        point, edge = self.into.position_w(world), self.into.depth
        end = carrier(world, thing)(upright_in_hand(world, thing, point, self.yaw))
        above, near = end.moved(z=edge + self.hover), end.moved(z=edge + self.align)
        yield Phase("above", lambda w: above, shut, arrived(within=0.01), own, thing)
        yield Phase("lower", lambda w: near, shut, arrived(within=0.003), touches, thing, 0.15)
        point = self.into.position_w(world)
        end = carrier(world, thing)(upright_in_hand(world, thing, point, self.yaw))
        lined = end.moved(z=edge + self.align)
        yield Phase("align", lambda w: lined, shut, arrived(0.0015, 0.02), touches, thing, 0.05)
        down = end.moved(z=-self.press)
        yield Phase("insert", lambda w: down, shut, self._down, touches, thing, 0.05)
        here = world.gripper
        yield Phase("settle", lambda w: here, shut, waited(0.2), touches, thing)
        yield Phase("open", lambda w: here, wide, waited(0.5), touches)
        back = here.advanced(-self.retreat)
        yield Phase("retract", lambda w: back, wide, arrived(within=0.015), own, speed=0.15)

    def _down(self, world: World, target: Pose, elapsed: float) -> bool:
        height = world.pose(self.thing).position_w[2] - self.into.position_w(world)[2]
        return bool(height < self.bottom)
