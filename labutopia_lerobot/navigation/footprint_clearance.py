"""How far the rectangle that a base takes is from everything on a map."""

import math
from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from labutopia_lerobot.navigation.docking import FloorRectangle
from labutopia_lerobot.navigation.occupancy import FREE, Occupancy
from labutopia_lerobot.world import FloatArray


@dataclass(frozen=True, eq=False)
class FootprintClearance:
    """Distances of a footprint from the cells of a map that are not free.

    Cells count whole, so that the distance from what stands in them is up to a cell greater.

    Attributes:
        footprint: Of the base.
        cells: Middles of the cells that are not free and border on one that is, shape (n, 2) [m].
        half: Half the width of a cell [m].
    """

    footprint: FloorRectangle
    cells: FloatArray
    half: float

    @classmethod
    def of(cls, occupancy: Occupancy, footprint: FloorRectangle) -> "FootprintClearance":
        """Return that of a map; what is beside the map is not free."""
        free = np.pad(occupancy.cells == FREE, 1)
        rows, columns = np.nonzero(ndimage.binary_dilation(free, np.ones((3, 3))) & ~free)
        middles = (np.column_stack([columns, rows]) - 0.5) * occupancy.resolution
        return cls(footprint, middles + np.array(occupancy.origin), occupancy.resolution / 2)

    def at(self, position: FloatArray, yaw: float) -> float:
        """Return the distance at a place [m]; 0 where a corner is in something.

        Two convex shapes that do not overlap are nearest at a corner of one of them. A cell whose
        middle is farther from that of the base than the least, by both reaches to a corner, is not
        the nearest.

        Args:
            position: Middle of the base, shape (2,) [m], frame of the map.
            yaw: Of the base, to the left of x [rad].
        """
        if not len(self.cells):
            return math.inf
        c, s = math.cos(yaw), math.sin(yaw)
        turn = np.array([[c, -s], [s, c]])  # of row vectors, into the base's frame
        half = np.array([self.footprint.length, self.footprint.width]) / 2
        signs = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1]])
        own = (signs * half) @ turn.T + position
        far = np.hypot(*(self.cells - position).T)
        cells = self.cells[far <= far.min() + math.hypot(*half) + math.sqrt(2.0) * self.half]
        theirs = cells[:, None] + self.half * signs
        beside = np.maximum(np.abs((theirs - position) @ turn) - half, 0.0)
        before = np.maximum(np.abs(own[:, None] - cells) - self.half, 0.0)
        return float(min(np.hypot(*beside.T).min(), np.hypot(*before.T).min()))
