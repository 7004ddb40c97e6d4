"""Obstacles on no map, in the way of a robot that drives: a stool, somebody who walks."""

import math
from collections.abc import Mapping

import numpy as np

from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.path import DrivingLimits
from labutopia_lerobot.navigation.path_planner import (
    BlockedPlaceError,
    PathPlanner,
    UnreachableGoalError,
)
from labutopia_lerobot.robots.mobile_base import MobileBase
from labutopia_lerobot.scenes.ground import Ground
from labutopia_lerobot.scenes.left_stool import LeftStool
from labutopia_lerobot.scenes.passer_by import WAY, PasserBy
from labutopia_lerobot.world import FloatArray

_STOOL, _PASSER_BY = LeftStool("left_stool"), PasserBy("passer_by")

SETS: dict[str, tuple[LeftStool | PasserBy, ...]] = {
    "stool": (_STOOL,),
    "passer_by": (_PASSER_BY,),
    "both": (_STOOL, _PASSER_BY),
}
"""Values of the axis `dynamic`."""

_TRIES = 150
_AWAY = 0.70
"""Least distance from where the robot starts, turns and works [m]; ours: its disc and a hand's
breadth."""
_MARGIN = 0.05
"""Distance from furniture that people and stools keep at least [m]; ours."""
_ROOM = 0.20
"""Distance from a person that the robot keeps beyond both discs where it passes [m]; ours."""
_BESIDE = (0.3, 2.0)
"""Greatest distance from the robot's way, at the first try and at the last [m]; ours: it is in the
way, or beside it where there is no room."""


def place_in_the_way(
    pieces: tuple[LeftStool | PasserBy, ...],
    layout: Mapping[Piece, Placement],
    base: MobileBase,
    ground: Ground,
    base_pose: FloatArray,
    floor: float,
    rng: np.random.Generator,
) -> dict[Piece, Placement] | None:
    """Draw where they stand and walk: across the way to the first thing, and none is shut off.

    Args:
        pieces: The obstacles.
        layout: Where the things of the task stand.
        base: Of the robot.
        ground: What of the room it gets to.
        base_pose: Where it starts: x, y [m] and heading [rad].
        floor: Height of the floor above the bench [m], negative.
        rng: Where the placements come from.

    Returns:
        Their placements, or None if there is no room for them.
    """
    field = _Field(base, ground, layout, base_pose[:2])
    if not field.leads_somewhere:
        return None
    placed: dict[Piece, Placement] = {}
    for piece in pieces:
        found = field.stand(piece, rng) if isinstance(piece, LeftStool) else field.walk(piece, rng)
        if found is None:
            return None
        x, y, yaw = found
        placed[piece] = Placement(x, y, yaw, floor)
    return placed


class _Field:
    """The floor on which things are put in the way, one after the other."""

    def __init__(
        self,
        base: MobileBase,
        ground: Ground,
        layout: Mapping[Piece, Placement],
        start: FloatArray,
    ) -> None:
        floor = ground.floor
        self._map = Occupancy(floor.cells, floor.origin, floor.resolution)
        self._clear = self._map.clearance()
        found = (
            at.dock or floor.dock_at(np.array([at.x, at.y]), base.arm[0], base.ahead)
            for at in layout.values()
        )
        docks = [dock for dock in found if dock is not None]
        self._kept = np.array([start, *(p for dock in docks for p in (dock.before, dock.position))])
        self._linked = [start, *(dock.before for dock in docks)]
        way = _planned(self._map, start, docks[0].before) if docks else None
        self._way = np.empty((0, 2)) if way is None else way

    @property
    def leads_somewhere(self) -> bool:
        """Whether there is a way to the first thing."""
        return len(self._way) > 0

    def stand(
        self, piece: LeftStool, rng: np.random.Generator
    ) -> tuple[float, float, float] | None:
        """Return where a stool stands and how it is turned, and keep it in mind."""
        for beside in np.linspace(*_BESIDE, _TRIES):
            point = self._near_the_way(beside, rng)
            if not self._fits(point[None], piece.footprint_radius):
                continue
            marked = self._with(point, piece.footprint_radius)
            if marked is not None:
                self._map, self._clear = marked, marked.clearance()
                return float(point[0]), float(point[1]), rng.uniform(-math.pi, math.pi)
        return None

    def walk(self, piece: PasserBy, rng: np.random.Generator) -> tuple[float, float, float] | None:
        """Return where a walk begins and its direction.

        From either of its ends the person leaves the robot a way.
        """
        for beside in np.linspace(*_BESIDE, _TRIES):
            middle, yaw = self._near_the_way(beside, rng), rng.uniform(-math.pi, math.pi)
            along = np.array([math.cos(yaw), math.sin(yaw)])
            line = middle + np.linspace(-WAY / 2, WAY / 2, 25)[:, None] * along
            room = piece.footprint_radius + _ROOM
            if self._fits(line, piece.footprint_radius) and all(
                self._with(end, room) is not None for end in line[[0, -1]]
            ):
                return float(line[0, 0]), float(line[0, 1]), yaw
        return None

    def _near_the_way(self, beside: float, rng: np.random.Generator) -> FloatArray:
        """Return a point at most so far from the robot's way along either axis [m]."""
        point: FloatArray = self._way[int(rng.integers(len(self._way)))]
        return point + rng.uniform(-beside, beside, 2)

    def _fits(self, points: FloatArray, radius: float) -> bool:
        """Return whether a disc can be at points, away from where the robot starts and works."""
        away = np.hypot(*(points[:, None] - self._kept).T)
        clear = [self._clear[self._map.cell(*point)] for point in points]
        return bool(away.min() >= radius + _AWAY and min(clear) >= radius + _MARGIN)

    def _with(self, point: FloatArray, radius: float) -> Occupancy | None:
        """Return the map with a disc on it, or None if that shuts anything off."""
        marked = self._map.copy()
        marked.add_disc(point, radius)
        start, *others = self._linked
        shut = any(_planned(marked, start, other) is None for other in others)
        return None if shut else marked


def _planned(occupancy: Occupancy, start: FloatArray, goal: FloatArray) -> FloatArray | None:
    """Return points of the robot's way, shape (n, 2) [m], or None if there is none."""
    planner = PathPlanner.of(occupancy, DrivingLimits(1.0, 1.0, 1.0, 1.0))
    try:
        return planner.plan(start, goal).points
    except (BlockedPlaceError, UnreachableGoalError):
        return None
