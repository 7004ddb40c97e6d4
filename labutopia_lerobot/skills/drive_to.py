"""Drive to a bench: stow the arm, leave where one is, follow a planned path."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.navigation.docking import approach_to
from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.navigation.path_planner import (
    RADIUS,
    BlockedPlaceError,
    UnreachableGoalError,
)
from labutopia_lerobot.skills.driver import Driver
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.skills.way import (
    AT_REST,
    Way,
    base_at,
    in_hand,
    parking,
)
from labutopia_lerobot.world import Pose, Thing, World

_WAITING = 60.0
"""Time for others to get out of the way, beyond that for driving [s]; ours."""


@dataclass(frozen=True)
class DriveTo:
    """Navigation as in the paper: a map, A* over it, key waypoints, which the base follows.

    It ends where the robot can turn as a disc, straight behind the place from which its arm reaches
    the thing.

    Attributes:
        thing: What to drive to.
        carrying: Thing in the hand, if any.
        clearance: Distance that the middle of the base keeps from everything where there is room
            for that [m]; elsewhere it is the paper's.
        from_above: Whether the thing is to be taken from above.
    """

    thing: Thing
    carrying: Thing | None = None
    clearance: float = RADIUS
    from_above: bool = False

    def way(self, world: World) -> Way:
        """Return the way on which it drives from where the base is: a wide one if that leads there.

        Args:
            world: Where the base is.
        """
        wide, *narrow = self._ways(world)
        if not narrow:
            return wide
        try:
            wide.route(world, self.thing)
        except (BlockedPlaceError, UnreachableGoalError):
            return narrow[0]
        return wide

    def _ways(self, world: World) -> list[Way]:
        radii = dict.fromkeys((self.clearance, RADIUS))
        return [Way.of(world, radius=radius, from_above=self.from_above) for radius in radii]

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield stow, leave (if the base stands too near to something to turn) and drive."""
        hand = in_hand(world, self.carrying)
        yield Phase("stow", done=arrived(within=0.01), timeout_s=10.0, **hand)
        for way in self._ways(world):
            position, yaw = base_at(world)
            if way.turns_at(position):
                break
            try:
                out = approach_to(way.planner, way.occupancy, way.footprint, position, yaw)
            except BlockedPlaceError:
                if way.planner.clearance.radius == RADIUS and not way.planner.free(position):
                    raise
            else:
                yield parking("leave", Parking(out, yaw, way.limits), hand)
                break
        driver = Driver(self.way(world), self.thing, world)

        def there(world: World, target: Pose, elapsed: float) -> bool:
            still = bool(np.abs(world.base_velocity).max() < AT_REST)
            return driver.tracker.arrived(base_at(world)[0], within=0.02) and still

        yield Phase(
            "drive",
            done=there,
            drive=driver.velocity,
            routes=driver.routes,
            timeout_s=15.0 + 4.0 * driver.duration + (_WAITING if world.in_the_way else 0.0),
            **hand,
        )
