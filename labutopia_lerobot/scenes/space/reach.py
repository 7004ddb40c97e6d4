"""Who gets where: a robot drives in by the entrance and reaches for the fronts of things."""

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from labutopia_lerobot.labware.parts.top import Top
from labutopia_lerobot.scenes.occupancy import Occupancy
from labutopia_lerobot.scenes.plan import Opening, Placed, WorkPlace
from labutopia_lerobot.scenes.space.extent import extent
from labutopia_lerobot.world import FloatArray

ROBOT_RADIUS = 0.3
"""Half the width of a robot that drives [m]; the paper keeps 0.6 m ("Navigation Details")."""
REACH = 0.855
"""How far the arm of levels 1 to 4 reaches [m] (its maker's data sheet)."""
BENCH_SIDE = 0.5
"""How near to a bench its robot gets [m]: somebody who stands at it."""
_STAND = 0.3
"""How near to a work place a robot gets [m]: behind it, as its own disc is wider than the gap."""

_COSINES = {0: 1.0, 90: 0.0, 180: -1.0, 270: 0.0}


@dataclass(frozen=True, eq=False)
class Reach:
    """What a robot gets to.

    Attributes:
        middles: Where its middle gets, cell by cell, shape (n, 2) [m], room frame.
    """

    middles: FloatArray

    @classmethod
    def of(cls, occupancy: Occupancy, entrance: Opening) -> "Reach":
        """Return where a robot gets from an entrance."""
        free = occupancy.passable(ROBOT_RADIUS)
        regions, _ = ndimage.label(free, structure=np.ones((3, 3)))
        inside = ROBOT_RADIUS + 2 * occupancy.resolution
        here = occupancy.cell(
            entrance.x + inside * _COSINES[entrance.heading],
            entrance.y + inside * _COSINES[(entrance.heading + 270) % 360],
        )
        reached = (regions == regions[here]) & (regions > 0)
        return cls(occupancy.middles(reached))

    def gets_to(self, place: WorkPlace) -> bool:
        """Tell whether it gets to a work place."""
        away = np.hypot(*(self.middles - (place.x, place.y)).T)
        return bool((away < _STAND).any())

    def front_of(self, piece: Placed) -> bool:
        """Tell whether it can reach for the front of a piece, standing before it."""
        hull = extent(piece.kind).hull
        (x, _, _), (left, right) = hull.low[0], (hull.low[0, 1], hull.high[0, 1])
        return self._reaches(piece, float(x), (float(left), float(right)), REACH, behind=False)

    def side_of(self, piece: Placed, top: Top) -> bool:
        """Tell whether it gets to the side of a piece of furniture at which one works."""
        edge = top.x[1] if top.behind else top.x[0]
        return self._reaches(piece, edge, top.y, BENCH_SIDE, behind=top.behind)

    def _reaches(
        self, piece: Placed, edge: float, along: tuple[float, float], far: float, *, behind: bool
    ) -> bool:
        """Tell whether it gets within a distance of an edge across the depth of a piece."""
        c, s = -_COSINES[piece.heading], -_COSINES[(piece.heading + 270) % 360]
        away = self.middles - (piece.x, piece.y)
        x, y = c * away[:, 0] + s * away[:, 1], c * away[:, 1] - s * away[:, 0]
        before = (x - edge) if behind else (edge - x)
        beside = np.maximum(np.maximum(along[0] - y, y - along[1]), 0.0)
        return bool(((before > 0) & (np.hypot(before, beside) <= far)).any())
