"""Set down a held vessel and let it go."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.places import Destination
from labutopia_lerobot.skills.posture import upright_in_hand
from labutopia_lerobot.skills.skill import Phase, arrived, carrier, waited
from labutopia_lerobot.world import FloatArray, Pose, Thing, World

_DEEP_SPEED = 0.015
"""Speed at which a thing touches down deep in something [m/s]; ours: an arm that reaches down there
hardly yields along its own axis, and pressed with 67 to 71 N at 0.03 m/s."""


@dataclass(frozen=True)
class Place:
    """The phases of the paper ("Place"): above, lower, align, pause, open, retract, done.

    Attributes:
        thing: The thing in the hand.
        on: Where its base goes.
        hover: Height above that from which it is lowered [m] (original: 0.2).
        align: Height above that at which it is lined up anew, before it touches down [m].
        press: How far below that the touch-down aims, so that it surely comes [m].
        retreat: How far the open hand draws back, along its own axis [m] (original: 0.15).
        through: What the thing is carried through on the way there, and the hand on the way back,
            such as the opening of an oven; None for the straight way.
        deep: Whether that is deep in something: a hand that holds it from above points as this
            robot's arm reaches deep (`Robot.deep_approach`).
    """

    thing: Thing
    on: Destination
    hover: float = 0.10
    align: float = 0.008
    press: float = 0.004
    retreat: float = 0.15
    through: Destination | None = None
    deep: bool = False

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield above, lower, align, settle, open, retract and done."""
        thing, shut = self.thing, world.commanded_opening
        wide = world.robot.max_opening
        support, own = frozenset({self.on.support}), frozenset({thing.name})
        point = self.on.position_w(world)
        carried = carrier(world, thing)
        end = carried(self._upright(world, point))
        above, near = end.moved(z=self.hover), end.moved(z=self.align)
        far = arrived(within=0.015)
        there = arrived(within=0.004)
        if self.through is not None:
            before = carried(self._upright(world, self.through.position_w(world)))
            yield Phase("before", lambda w: before, shut, far, own, thing)
        yield Phase("above", lambda w: above, shut, far, own, thing)
        yield Phase("lower", lambda w: near, shut, there, own | support, thing, speed=0.15)
        below = carrier(world, thing)(self._upright(world, point)).moved(z=-self.press)
        slow = _DEEP_SPEED if self.deep else 0.03
        yield Phase("align", lambda w: below, shut, self._landed, own | support, thing, speed=slow)
        here = world.gripper
        yield Phase("settle", lambda w: here, shut, waited(0.3), own | support, thing)
        yield Phase("open", lambda w: here, wide, waited(0.5), own | support)
        back = here.advanced(-self.retreat)
        yield Phase("retract", lambda w: back, wide, far, own, speed=0.15)
        if self.through is not None:
            back = before
            yield Phase("out", lambda w: back, wide, far, own)
        yield Phase("done", lambda w: back, wide, waited(0.1), own)

    def _upright(self, world: World, base_w: FloatArray) -> Pose:
        """Return the pose of the thing with its base at a point, shape (3,) [m], world frame."""
        yaw_above = world.robot.deep_approach.yaw if self.deep else 0.0
        return upright_in_hand(world, self.thing, base_w, yaw_above)

    def _landed(self, world: World, target: Pose, elapsed: float) -> bool:
        return world.touching(self.thing.name, self.on.support)
