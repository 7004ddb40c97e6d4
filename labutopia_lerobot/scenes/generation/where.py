"""Where things belong: at a wall, hung on it, on a bench, before it, in the middle, to work at."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from labutopia_lerobot.scenes.generation.spots import Patch, points
from labutopia_lerobot.scenes.plan import Heading, Placed
from labutopia_lerobot.scenes.space.boxes import Boxes
from labutopia_lerobot.scenes.space.extent import Extent, extent
from labutopia_lerobot.world import FloatArray

if TYPE_CHECKING:
    from labutopia_lerobot.scenes.generation.footprint import Region
    from labutopia_lerobot.scenes.generation.sketch import Sketch

HEADINGS: tuple[Heading, ...] = (0, 90, 180, 270)
_GAP = 0.01
"""Between a wall and what stands at it [m]."""
_COARSE = 0.1
"""Grid of what stands in the middle [m]."""
_APART = 0.03
"""Between two things on a bench [m]."""


class Where(Protocol):
    """Where a piece belongs."""

    @property
    def walkway(self) -> tuple[float, float, float]:
        """How far other furniture keeps away before it, behind it and beside it [m]."""
        ...

    @property
    def on_floor(self) -> bool:
        """Whether it stands on the floor, and neither hangs nor stands on something."""
        ...

    @property
    def edge(self) -> float:
        """How much better it stands near an edge or a corner than in the open, -1 to 1."""
        ...

    @property
    def apart(self) -> float:
        """How far it had better be from what stands on the same ground [m]; 0: in a row."""
        ...

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where in a region a piece of a kind could be, whatever else is there."""
        ...

    def spelt(self, kind: Extent) -> str:
        """Write how much room a piece of a kind needs."""
        ...


@dataclass(frozen=True)
class AtWall:
    """With its back to a wall.

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

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for heading in HEADINGS:
            if not self.outer or heading in region.outer:
                x, y = _inside(_with_back_free(kind).placed(heading), region)
                yield _against(heading, x, y, self.height)

    def spelt(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        wall = "an outer wall" if self.outer else "wall"
        return f"{width:.2f} m of {wall}, {depth:.2f} m deep, with {self.before:g} m before it"


@dataclass(frozen=True)
class Peninsula:
    """With one end at a wall.

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

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for wall in HEADINGS:
            for heading in HEADINGS:
                if (wall - heading) % 180 == 90:
                    x, y = _inside(kind.hull.placed(heading), region)
                    yield _against(wall, x, y, 0.0, heading)

    def spelt(self, kind: Extent) -> str:
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

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        around = np.array([self.aisle, self.aisle, 0.0])
        for heading in HEADINGS:
            hull = kind.hull.placed(heading)
            x, y = _inside(Boxes(hull.low - around, hull.high + around), region)
            yield Patch(points(*x, _COARSE), points(*y, _COARSE), heading)

    def spelt(self, kind: Extent) -> str:
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

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for heading in HEADINGS:
            x, y = _inside(kind.hull.placed(heading), region)
            yield Patch(points(*x, _COARSE), points(*y, _COARSE), heading)

    def spelt(self, kind: Extent) -> str:
        """Write how much room it needs."""
        return "3.6 x 3.5 m in which nothing is higher than the bench, for the robot's cameras"


@dataclass(frozen=True)
class On:
    """On a bench, a table, in a hood.

    Attributes:
        kinds: What carries it.
    """

    kinds: tuple[str, ...]
    walkway = (0.0, 0.0, 0.0)
    on_floor = False
    edge = 1.0
    apart = 0.4

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        around = np.array([0.0, _APART, 0.0])
        for carrier, top in sketch.tops(self.kinds, region):
            facing: Heading = 0 if top.behind else 180
            sole = kind.sole.placed(facing)
            sole = Boxes(sole.low - around, sole.high + around)
            x = points(top.x[0] - sole.low[0, 0], top.x[1] - sole.high[0, 0])
            y = points(top.y[0] - sole.low[0, 1], top.y[1] - sole.high[0, 1])
            yield _in_frame_of(carrier, x, y, facing, carrier.height + top.height, carrier.name)

    def spelt(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.sole.high - kind.sole.low)[0, :2]
        return f"{width:.2f} x {depth:.2f} m on one of: {', '.join(self.kinds)}"


@dataclass(frozen=True)
class Before:
    """Before a bench or desk, facing it, as seats do.

    Attributes:
        kinds: What it stands before.
    """

    kinds: tuple[str, ...]
    walkway = (0.0, 0.0, 0.0)
    on_floor = True
    edge = 0.0
    apart = 0.6

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        front, back = -kind.hull.low[0, 0], kind.hull.high[0, 0]
        for carrier, top in sketch.tops(self.kinds, region):
            facing: Heading = 180 if top.behind else 0
            edge = top.x[1] + front if top.behind else top.x[0] - front
            away = np.array([-0.25, 0.05, 0.45])  # under it, at it, clear of its drawers
            x = np.round(edge + (away if top.behind else -away), 3)
            reach = max(-kind.hull.low[0, 1], back)
            y = points(top.y[0] + reach, top.y[1] - reach)
            yield _in_frame_of(carrier, x, y, facing, 0.0, None)

    def spelt(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        return f"{width:.2f} x {depth:.2f} m before one of: {', '.join(self.kinds)}"


@dataclass(frozen=True)
class Facing:
    """Some way before a thing at a wall, with its front towards it, as a teacher's desk.

    Attributes:
        kind: What it faces.
        away: Least and greatest distance [m].
    """

    kind: str
    away: tuple[float, float] = (0.9, 1.6)
    walkway = (0.7, 0.7, 0.0)
    on_floor = True
    edge = 0.0
    apart = 0.0

    def patches(self, kind: Extent, region: "Region", sketch: "Sketch") -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for faced in sketch.of_kind(self.kind, region):
            hull = extent(self.kind).hull
            front = float(hull.low[0, 0] + kind.hull.low[0, 0])
            x = points(front - self.away[1], front - self.away[0])
            yield _in_frame_of(faced, x, points(-1.0, 1.0), 0, 0.0, None)

    def spelt(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        return f"{width:.2f} x {depth:.2f} m at least {self.away[0]:g} m before a {self.kind}"


def _with_back_free(kind: Extent) -> Boxes:
    """Return the hull of a kind, as deep as lids go that open towards its back."""
    back = np.max([kind.hull.high[0, 0], *(swing.room.high[:, 0].max() for swing in kind.swings)])
    high = kind.hull.high.copy()
    high[0, 0] = back
    return Boxes(kind.hull.low, high)


def _inside(hull: Boxes, region: "Region") -> tuple[tuple[float, float], tuple[float, float]]:
    """Return least and greatest x and y at which a box is in a region, a gap from its walls."""
    (x_low, y_low, _), (x_high, y_high, _) = hull.low[0], hull.high[0]
    return (
        (region.x[0] + _GAP - x_low, region.x[1] - _GAP - x_high),
        (region.y[0] + _GAP - y_low, region.y[1] - _GAP - y_high),
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


def _in_frame_of(
    carrier: Placed,
    x: FloatArray,
    y: FloatArray,
    facing: Heading,
    height: float,
    on: str | None,
) -> Patch:
    """Return points that are said in the frame of a piece, as points of the room.

    Args:
        carrier: The piece.
        x: In its frame [m].
        y: In its frame [m].
        facing: The way that the front faces in that frame, in which the piece's own faces 180.
        height: Of the base above the floor [m].
        on: What it stands on.
    """
    turn = (carrier.heading + 180) % 360
    heading: Heading = (facing + turn) % 360  # type: ignore[assignment]
    signs = {0: (1, 1), 90: (-1, 1), 180: (-1, -1), 270: (1, -1)}
    along_x, along_y = (x, y) if turn % 180 == 0 else (y, x)
    x_w = np.round(carrier.x + signs[turn][0] * along_x, 3)
    y_w = np.round(carrier.y + signs[turn][1] * along_y, 3)
    return Patch(x_w, y_w, heading, round(height, 3), on)
