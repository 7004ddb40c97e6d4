"""Drive to a bench: stow the arm, leave where one is, follow a planned path."""

import math
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
from labutopia_lerobot.places import reached_at
from labutopia_lerobot.skills.driver import Driver
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.skills.way import (
    AT_REST,
    INWARDS,
    InHand,
    Way,
    base_at,
    in_hand,
    parking,
)
from labutopia_lerobot.world import Dock, Pose, Thing, World

_WAITING = 60.0
"""Time for others to get out of the way, beyond that for driving [s]; ours."""
_SURELY = 0.05
"""How much nearer than that it comes where it has to come nearer [m]; ours: a cell of the map."""


@dataclass(frozen=True)
class DriveTo:
    """Navigation as in the paper: a map, A* over it, key waypoints, which the base follows.

    It ends where the robot can turn as a disc, straight behind the place from which its arm reaches
    the thing. Where an aisle is narrow, that may be too far from the thing: then it turns there,
    and comes nearer.

    Attributes:
        thing: What to drive to.
        carrying: Thing in the hand, if any.
        clearance: Distance that the middle of the base keeps from everything where there is room
            for that [m]; elsewhere it is the paper's.
        from_above: Whether the thing is to be taken from above.
        within: Greatest distance from the thing at which it may end [m].
    """

    thing: Thing
    carrying: Thing | None = None
    clearance: float = RADIUS
    from_above: bool = False
    within: float = math.inf

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
        """Yield stow, leave (if the base stands too near to something to turn), drive, and nearer.

        The last only where it has not come near enough.
        """
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
        yield from self._nearer(world, driver.routes[-1].dock, hand)

    def _nearer(self, world: World, dock: Dock, hand: InHand) -> Iterator[Phase]:
        """Yield turn and nearer, straight in, if the base is too far from the thing."""
        here = base_at(world)[0]
        to_go = reached_at(world, self.thing)[:2] - here
        if float(np.hypot(*to_go)) < self.within:
            return
        inwards = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
        aside = float(to_go[1] * inwards[0] - to_go[0] * inwards[1])
        left = float(to_go @ inwards) - math.sqrt((self.within - _SURELY) ** 2 - aside**2)
        limits = Way.of(world, INWARDS).limits
        yield parking("turn", Parking(here, dock.yaw, limits), hand)
        yield parking("nearer", Parking(here + left * inwards, dock.yaw, limits), hand)
