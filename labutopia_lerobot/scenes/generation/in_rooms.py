"""Places for things in a room: at a wall, hung on it, in the middle, to work at."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.scenes.generation.spots import Patch, points
from labutopia_lerobot.scenes.generation.where import StandingPieces, Walls
from labutopia_lerobot.scenes.plan import Heading
from labutopia_lerobot.scenes.space.boxes import Boxes
from labutopia_lerobot.scenes.space.extent import Extent

HEADINGS: tuple[Heading, ...] = (0, 90, 180, 270)
_GAP = 0.01
"""Between a wall and what stands at it [m]."""
_COARSE = 0.1
"""Grid of what stands in the middle [m]."""


@dataclass(frozen=True)
class AtWall:
    """Places with the back to a wall.

    Attributes:
        outer: Whether that wall has to be an outer one, where windows are.
        before: How far other furniture keeps away before it [m].
        height: Above the floor [m], of what is hung.
    """

    outer: bool = False
    before: float = 0.9
    height: float = 0.0
    edge = 1.0
    apart = 0.0

    @property
    def walkway(self) -> tuple[float, float, float]:
        return self.before, 0.0, 0.0

    @property
    def on_floor(self) -> bool:
        return self.height == 0.0

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for heading in HEADINGS:
            if not self.outer or heading in walls.outer:
                x, y = _inside(_with_back_free(kind).placed(heading), walls)
                yield _against(heading, x, y, self.height)

    def describe(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        wall = "an outer wall" if self.outer else "wall"
        return f"{width:.2f} m of {wall}, {depth:.2f} m deep, with {self.before:g} m before it"


@dataclass(frozen=True)
class Peninsula:
    """Places with one end at a wall.

    Attributes:
        aisle: How far other furniture keeps away on both sides [m].
    """

    aisle: float = 1.0
    on_floor = True
    edge = 0.3
    apart = 1.5

    @property
    def walkway(self) -> tuple[float, float, float]:
        return self.aisle, self.aisle, 0.0

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for wall in HEADINGS:
            for heading in HEADINGS:
                if (wall - heading) % 180 == 90:
                    x, y = _inside(kind.hull.placed(heading), walls)
                    yield _against(wall, x, y, 0.0, heading)

    def describe(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        return f"{depth:.2f} m of wall, {width:.2f} m into the room, {self.aisle:g} m on both sides"


@dataclass(frozen=True)
class InMiddle:
    """Away from walls, as an island.

    Attributes:
        aisle: How far walls and other furniture keep away [m].
    """

    aisle: float = 1.0
    on_floor = True
    edge = -0.2
    apart = 1.5

    @property
    def walkway(self) -> tuple[float, float, float]:
        return self.aisle, self.aisle, self.aisle

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        around = np.array([self.aisle, self.aisle, 0.0])
        for heading in HEADINGS:
            hull = kind.hull.placed(heading)
            x, y = _inside(Boxes(hull.low - around, hull.high + around), walls)
            yield Patch(points(*x, _COARSE), points(*y, _COARSE), heading)

    def describe(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        return f"{width:.2f} x {depth:.2f} m with {self.aisle:g} m around it"


@dataclass(frozen=True)
class ToWorkAt:
    """A bench with a robot before it: its view is free, and it is turned any way."""

    walkway = (0.0, 0.0, 0.0)
    on_floor = True
    edge = 0.5
    apart = 0.0

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for heading in HEADINGS:
            x, y = _inside(kind.hull.placed(heading), walls)
            yield Patch(points(*x, _COARSE), points(*y, _COARSE), heading)

    def describe(self, kind: Extent) -> str:
        """Write how much room it needs."""
        return "3.6 x 3.5 m in which nothing is higher than the bench, for the robot's cameras"


def _with_back_free(kind: Extent) -> Boxes:
    """Return the hull of a kind, as deep as lids go that open towards its back."""
    back = np.max([kind.hull.high[0, 0], *(swing.room.high[:, 0].max() for swing in kind.swings)])
    high = kind.hull.high.copy()
    high[0, 0] = back
    return Boxes(kind.hull.low, high)


def _inside(hull: Boxes, walls: Walls) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return least and greatest x and y at which a box is in a region, a gap from its walls."""
    (x_low, y_low, _), (x_high, y_high, _) = hull.low[0], hull.high[0]
    return (
        (walls.x[0] + _GAP - x_low, walls.x[1] - _GAP - x_high),
        (walls.y[0] + _GAP - y_low, walls.y[1] - _GAP - y_high),
    )


def _against(
    wall: Heading,
    x: tuple[float, float],
    y: tuple[float, float],
    height: float,
    heading: Heading | None = None,
) -> Patch:
    """Return the points of a rectangle nearest to the wall that faces a way."""
    facing = wall if heading is None else heading
    ends = {0: (x, 0), 180: (x, -1), 90: (y, 0), 270: (y, -1)}
    (low, high), end = ends[wall]
    line = points(low, high, max(high - low, 1.0))[[end]] if high >= low else np.empty(0)
    if wall % 180 == 0:
        return Patch(line, points(*y), facing, height)
    return Patch(points(*x), line, facing, height)
