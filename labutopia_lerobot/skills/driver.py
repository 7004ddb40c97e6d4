"""Driving along a planned path among people: one waits for them, and goes round them."""

import math
from dataclasses import dataclass

import numpy as np

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
"""How much nearer to a person than it is a base may come on a way round, while they stay where they
are [m]; ours: a cell of the map, to which that way keeps its distance."""
_PATIENCE = 4.0
"""Time after which one who waits looks for a way round [s]; ours: people turn round after two."""


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
        self._waited = 0.0
        self._passing: dict[str, _Passing] = {}

    def velocity(self, world: World) -> FloatArray:
        """Return the velocity of the next control period, base frame, shape (3,)."""
        walking = [other for other in world.in_the_way if other.walks]
        if not walking:
            return self.tracker.velocity(*base_at(world))
        free = min(self._free(world, other) for other in walking)
        self._waited = 0.0 if free > 0.0 else self._waited + 1.0 / CONTROL_HZ
        if self._waited > _PATIENCE:
            self._waited = 0.0
            self._go_round(world, walking)
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
        passing = self._passing.get(other.name)
        if passing is not None and math.dist(passing.place, here) < _STEP:
            near = min(near, passing.nearest)
        least = min(RADIUS + other.footprint_radius + CLEAR_OF_PEOPLE, near)
        met = far[away < least]
        return max(0.0, float(met[0]) - _STEP) if len(met) else math.inf

    def _go_round(self, world: World, walking: list[Obstacle]) -> None:
        """Plan anew, round where they are now; keep the path if there is no way round."""
        for tight in (False, True):
            try:
                self.routes.append(self._way.route(world, self._thing, walking, tight=tight))
            except (BlockedPlaceError, UnreachableGoalError):
                continue
            self.tracker = PathTracker(self.routes[-1].path, self._way.limits)
            here = base_at(world)[0]
            self._passing = {}
            for other in walking:
                place = world.pose(other).position_w[:2]
                self._passing[other.name] = _Passing(place, math.dist(here, place) - _NEARER)
            return


@dataclass(frozen=True, eq=False)
class _Passing:
    """Somebody whom one goes round.

    Attributes:
        place: Where, shape (2,) [m], world frame.
        nearest: How near one may come while they stay there [m].
    """

    place: FloatArray
    nearest: float
