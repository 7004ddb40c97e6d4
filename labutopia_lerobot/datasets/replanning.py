"""The routes of an episode: those that were planned, and planning those of a dataset again."""

import math
from collections.abc import Sequence

from labutopia_lerobot.datasets.routes import PlannedPath, Routes, map_of
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.path import Path
from labutopia_lerobot.navigation.route import Route
from labutopia_lerobot.skills import DriveTo
from labutopia_lerobot.skills.way import Way
from labutopia_lerobot.world import CONTROL_HZ

_SPACING = 0.1
"""Greatest distance of the points of a path that are kept [m]; ours: planned are five times as
many."""


def routes_of(env: LabEnv, planned: Sequence[Route]) -> Routes | None:
    """Return the routes of the present episode; None where nobody drives.

    Args:
        env: Where it is played.
        planned: By whom plays it.
    """
    workcell = env.workcell
    if not workcell.task.drives:
        return None
    floor = workcell.world.floor
    occupancy = Occupancy(floor.cells, floor.origin, floor.resolution)
    paths = [_plain(route) for route in planned]
    return Routes(room=workcell.room, map=map_of(occupancy), paths=paths)


class Replanning:
    """Plans the paths of a recorded episode again, each when it was planned.

    Args:
        recorded: What the dataset says.
    """

    def __init__(self, recorded: Routes | None) -> None:
        paths = [] if recorded is None else recorded["paths"]
        self._due = [(path["t"], path["thing"], path["around"]) for path in paths]
        self._planned: list[Route] = []

    def look(self, env: LabEnv) -> None:
        """Plan what was planned now, if it can be; every control step is to be looked at."""
        world = env.workcell.world
        things = {piece.name: piece for piece in env.workcell.task.start}
        people = {other.name: other for other in world.in_the_way}
        while self._due and self._due[0][0] < world.time + 0.5 / CONTROL_HZ:
            _, thing, around = self._due.pop(0)
            try:
                gone_round = [people[name] for name in around]
                self._planned.append(self._way(env, thing).route(world, things[thing], gone_round))
            except (KeyError, UserError):  # the dataset is wrong: the path will be missing
                return

    def _way(self, env: LabEnv, thing: str) -> Way:
        """Return the way on which the expert of the task drives to a thing."""
        world = env.workcell.world
        for skill in env.workcell.task.skills:
            if isinstance(skill, DriveTo) and skill.thing.name == thing:
                return skill.way(world)
        return Way.of(world)

    def routes(self, env: LabEnv) -> Routes | None:
        """Return what the dataset should say."""
        return routes_of(env, self._planned)


def _plain(route: Route) -> PlannedPath:
    path, dock = route.path, route.dock
    x, y = dock.position
    return PlannedPath(
        t=round(route.time, 4),
        thing=route.thing.name,
        around=[other.name for other in route.around],
        waypoints=[[round(float(c), 3) for c in point] for point in path.waypoints],
        path=_points(path),
        dock=[round(float(x), 3), round(float(y), 3), round(dock.yaw, 4)],
    )


def _points(path: Path) -> list[list[float]]:
    steps = max(1, math.ceil(path.length / _SPACING))
    points = []
    for step in range(steps + 1):
        along = path.length * step / steps
        (x, y), (ahead_x, ahead_y) = path.at(along), path.direction(along)
        heading = math.atan2(ahead_y, ahead_x)
        points.append([round(float(x), 3), round(float(y), 3), round(heading, 4)])
    return points
