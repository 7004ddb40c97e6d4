"""Press the foot of a held tube into a cup that gives, and keep it there."""

from collections.abc import Iterator
from dataclasses import dataclass

from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates.readings import Readable
from labutopia_lerobot.skills.posture import upright_in_hand
from labutopia_lerobot.skills.skill import Phase, arrived, carrier, waited
from labutopia_lerobot.world import Pose, Thing, World


@dataclass(frozen=True)
class PressInto:
    """Carry the tube over the cup, lower it, press until the instrument runs, hold, and lift.

    Attributes:
        thing: The tube in the hand.
        into: Where its foot goes.
        running: What reads how fast the instrument runs.
        above: Reading from which it runs.
        seconds: How long it is held there from then on [s].
        depth: How far below the cup's rest the foot aims [m]; ours: arm and grip give by half of
            that at the force at which the cup of a vortex mixer stops.
        hover: Height above the cup from which the tube is lowered, and to which it is lifted [m].
    """

    thing: Thing
    into: Destination
    running: Readable
    above: float
    seconds: float
    depth: float = 0.006
    hover: float = 0.08

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield above, lower, press, hold and lift."""
        thing, shut = self.thing, world.commanded_opening
        own, touches = frozenset({thing.name}), frozenset({thing.name, self.into.support})
        point = self.into.position_w(world)  # the cup goes round, and the hand does not follow
        end = carrier(world, thing)(upright_in_hand(world, thing, point))
        over, near = end.moved(z=self.hover), end.moved(z=0.006)
        yield Phase("above", lambda w: over, shut, arrived(within=0.01), own, thing)
        yield Phase("lower", lambda w: near, shut, arrived(within=0.003), touches, thing, 0.10)
        end = carrier(world, thing)(upright_in_hand(world, thing, point))
        down = end.moved(z=-self.depth)
        yield Phase("press", lambda w: down, shut, self._runs, touches, thing, 0.02)
        yield Phase("hold", lambda w: down, shut, waited(self.seconds), touches, thing)
        up = end.moved(z=self.hover)
        yield Phase("lift", lambda w: up, shut, arrived(within=0.015), touches, thing, 0.10)

    def _runs(self, world: World, target: Pose, elapsed: float) -> bool:
        return world.reading(self.running.name).value >= self.above
