"""Places for things that need another: on a bench, before a desk, facing a board."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.scenes.generation.spots import Patch, points
from labutopia_lerobot.scenes.generation.where import StandingPieces, Walls
from labutopia_lerobot.scenes.plan import Heading, Placed
from labutopia_lerobot.scenes.space.boxes import Boxes
from labutopia_lerobot.scenes.space.extent import Extent, extent
from labutopia_lerobot.world import FloatArray

_APART = 0.03
"""Between two things on a bench [m]."""


@dataclass(frozen=True)
class On:
    """Places on a bench, on a table, in a hood.

    Attributes:
        kinds: What carries it.
    """

    kinds: tuple[str, ...]
    walkway = (0.0, 0.0, 0.0)
    on_floor = False
    edge = 1.0
    apart = 0.4

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        around = np.array([0.0, _APART, 0.0])
        for carrier, top in standing.tops(self.kinds):
            facing: Heading = 0 if top.behind else 180
            sole = kind.sole.placed(facing)
            sole = Boxes(sole.low - around, sole.high + around)
            x = points(top.x[0] - sole.low[0, 0], top.x[1] - sole.high[0, 0])
            y = points(top.y[0] - sole.low[0, 1], top.y[1] - sole.high[0, 1])
            yield _in_frame_of(carrier, x, y, facing, carrier.height + top.height, carrier.name)

    def describe(self, kind: Extent) -> str:
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

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        front, back = -kind.hull.low[0, 0], kind.hull.high[0, 0]
        for carrier, top in standing.tops(self.kinds):
            facing: Heading = 180 if top.behind else 0
            edge = top.x[1] + front if top.behind else top.x[0] - front
            away = np.array([-0.25, 0.05, 0.45])  # under it, at it, clear of its drawers
            x = np.round(edge + (away if top.behind else -away), 3)
            reach = max(-kind.hull.low[0, 1], back)
            y = points(top.y[0] + reach, top.y[1] - reach)
            yield _in_frame_of(carrier, x, y, facing, 0.0, None)

    def describe(self, kind: Extent) -> str:
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

    def patches(self, kind: Extent, walls: Walls, standing: StandingPieces) -> Iterator[Patch]:
        """Yield where it could be; see `Where`."""
        for faced in standing.of_kind(self.kind):
            hull = extent(self.kind).hull
            front = float(hull.low[0, 0] + kind.hull.low[0, 0])
            x = points(front - self.away[1], front - self.away[0])
            yield _in_frame_of(faced, x, points(-1.0, 1.0), 0, 0.0, None)

    def describe(self, kind: Extent) -> str:
        """Write how much room it needs."""
        depth, width = (kind.hull.high - kind.hull.low)[0, :2]
        return f"{width:.2f} x {depth:.2f} m at least {self.away[0]:g} m before a {self.kind}"


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
