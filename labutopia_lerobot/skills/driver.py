"""Driving along a planned path among people: one waits for them, goes round, or makes way."""

import math
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.navigation.path_planner import (
    RADIUS,
    BlockedPlaceError,
    UnreachableGoalError,
)
from labutopia_lerobot.navigation.tracking import PathTracker
from labutopia_lerobot.skills.way import CLEAR_OF_PEOPLE, Way, base_at
from labutopia_lerobot.world import CONTROL_HZ, FloatArray, Obstacle, Thing, World

_AHEAD, _STEP = 1.6, 0.1
"""How far ahead one looks along the path, and in which steps [m]; ours: from full speed one stops
in half of that."""
_SOON = (0.0, 0.5, 1.0, 1.5)
"""Times at which one reckons where a person is, who walks straight on [s]; ours."""
_NEARER = 0.05
"""How much nearer to a person than it is a base may come on a way round [m]; ours: a cell of the
map, to which that way keeps its distance."""
_PATIENCE = 4.0
"""Time after which one who waits looks for a way round [s]; ours: people turn round after two."""
_LOOKS = 2
"""How often one looks for a way round before one makes way; ours: people rest for three seconds."""
_OUT_OF_THE_WAY = 1.6
"""Distance from people to which one makes way [m]; ours: a step, half a person, and the disc."""
_PASSED, _UNTIL = 1.0, 10.0
"""How far somebody has then to have walked before one goes on [m], and the longest that one waits
for it [s]; ours: half a way of 2 m, and a slow one with a rest."""


class Driver:
    """Yields the velocities that bring a base before a thing, from rest to rest.

    Attributes:
        routes: What it has planned, the present route last.
        tracker: Follows the present path.
        duration: Time that the first path takes [s].

    Args:
        way: Map and limits.
        thing: What to drive to.
        world: Where the base is.
    """

    def __init__(self, way: Way, thing: Thing, world: World) -> None:
        self._way, self._thing = way, thing
        self.routes = [way.route(world, thing)]
        path = self.routes[0].path
        self.tracker, self.duration = PathTracker(path, way.limits), path.duration(way.limits)
        self._waited, self._looked = 0.0, 0
        self._nearest = math.inf
        self._driven = [base_at(world)[0].copy()]
        self._making_way: _MakingWay | None = None

    def arrived(self, world: World, within: float) -> bool:
        """Return whether the base is before the thing.

        Args:
            world: Where the base is.
            within: How near [m].
        """
        here = base_at(world)[0]
        return self._making_way is None and self.tracker.arrived(here, within)

    def velocity(self, world: World) -> FloatArray:
        """Return the velocity of the next control period, base frame, shape (3,)."""
        walking = [other for other in world.in_the_way if other.walks]
        if not walking:
            return self.tracker.velocity(*base_at(world))
        here, yaw = base_at(world)
        if self._making_way is not None:
            if not self._making_way.over(world, walking):
                return self._making_way.back.velocity(here, yaw)
            self._making_way = None
            self._go_round(world, [])
        if math.dist(here, self._driven[-1]) > _STEP:
            self._driven.append(here.copy())
        free = min(self._free(world, other) for other in walking)
        self._waited = 0.0 if free > 0.0 else self._waited + 1.0 / CONTROL_HZ
        self._looked = 0 if free > 0.0 else self._looked
        if self._waited > _PATIENCE:
            self._waited, self._looked = 0.0, self._looked + 1
            if not self._go_round(world, walking) and self._looked >= _LOOKS:
                self._make_way(world, walking)
        fastest = math.sqrt(2.0 * self._way.limits.along * free) if math.isfinite(free) else free
        return self.tracker.velocity(*base_at(world), fastest=fastest)

    def _free(self, world: World, other: Obstacle) -> float:
        """Return how far the path ahead is free of a person [m], infinite if all of it is.

        One may always drive away from a person: only what brings one nearer counts.
        """
        here = world.pose(other).position_w[:2]
        speed = world.velocity(other)[:2]
        places = np.array([here + time * speed for time in _SOON])
        far, points = self.tracker.ahead(_AHEAD, _STEP)
        away = np.hypot(*(points[:, None] - places).transpose(2, 0, 1)).min(axis=1)
        near = float(np.hypot(*(points[0] - here)))
        least = min(RADIUS + other.footprint_radius + CLEAR_OF_PEOPLE, near, self._nearest)
        met = far[away < least]
        return max(0.0, float(met[0]) - _STEP) if len(met) else math.inf

    def _go_round(self, world: World, walking: list[Obstacle]) -> bool:
        """Plan anew, round where they are now; keep the path if there is no way round.

        Returns:
            Whether there is.
        """
        try:
            self.routes.append(self._way.route(world, self._thing, walking))
        except (BlockedPlaceError, UnreachableGoalError):
            return False
        self.tracker = PathTracker(self.routes[-1].path, self._way.limits)
        here = base_at(world)[0]
        near = [math.dist(here, place) for place in _places(world, walking)]
        self._nearest = min(near, default=math.inf) - _NEARER
        return True

    def _make_way(self, world: World, walking: list[Obstacle]) -> None:
        """Go straight back where one came from, until one is not in their way.

        Two who wait for each other would stand for ever.
        """
        (here, yaw), places = base_at(world), _places(world, walking)
        clearance, back = self._way.planner.clearance, here
        for place in reversed(self._driven):
            if math.isinf(clearance.line_price(here, place)):
                break
            back = place
            if min(math.dist(place, other) for other in places) > _OUT_OF_THE_WAY:
                break
        self._making_way = _MakingWay(world.time, places, Parking(back, yaw, self._way.limits))


@dataclass(frozen=True, eq=False)
class _MakingWay:
    """For whom one has gone back.

    Attributes:
        since: When [s].
        places: Where they stood, shape (2,) each [m], world frame.
        back: Brings the base to where it is out of their way.
    """

    since: float
    places: list[FloatArray]
    back: Parking

    def over(self, world: World, walking: list[Obstacle]) -> bool:
        """Return whether one of them has passed, or one has waited for long."""
        gone = map(math.dist, self.places, _places(world, walking))
        return max(gone) > _PASSED or world.time > self.since + _UNTIL


def _places(world: World, others: list[Obstacle]) -> list[FloatArray]:
    return [world.pose(other).position_w[:2] for other in others]
