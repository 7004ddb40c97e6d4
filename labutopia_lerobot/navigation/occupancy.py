"""Map of where a robot can drive: cells, as data and as a picture.

As in the paper (appendix "Navigation Details"): what is between 0.1 and 1.6 m above the floor is
projected onto it. What is beside the floor is undefined. Neither can be driven over.
"""

import hashlib
import io
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from labutopia_lerobot.world import FloatArray

FREE, OCCUPIED, UNDEFINED = 0, 1, -1
"""Kinds of cells."""

LOWEST, HIGHEST = 0.1, 1.6
"""Between them things stand in the way of a robot [m] (paper, "Navigation Details")."""

FINE, COARSE = 0.05, 0.5
"""Width of a cell [m]: ours, and that of the paper."""

_HALF_DIAGONAL = math.sqrt(0.5)
"""Of a cell, in widths: no point of it is further from its middle."""

_GREYS = {FREE: 254, OCCUPIED: 0, UNDEFINED: 205}
"""Greys of cells, as ROS writes maps (map_server, "Image Format")."""


@dataclass(frozen=True, eq=False)
class Occupancy:
    """A map of a room.

    Attributes:
        cells: FREE, OCCUPIED or UNDEFINED, shape (rows, columns): rows go north (y), columns east
            (x); int8.
        origin: Where the south-west corner of cell (0, 0) is, (x, y) [m], room frame.
        resolution: Width of a cell [m].
    """

    cells: NDArray[np.int8]
    origin: tuple[float, float]
    resolution: float

    @classmethod
    def empty(cls, size: tuple[float, float], resolution: float = FINE) -> "Occupancy":
        """Return the map of a room in which nothing stands; the cells that are cut are undefined.

        Args:
            size: Width and depth of the room [m].
            resolution: Width of a cell [m].
        """
        columns, rows = (math.ceil(round(side / resolution, 6)) for side in size)
        cells = np.zeros((rows, columns), np.int8)
        cells[math.floor(round(size[1] / resolution, 6)) :] = UNDEFINED
        cells[:, math.floor(round(size[0] / resolution, 6)) :] = UNDEFINED
        return cls(cells, (0.0, 0.0), resolution)

    @property
    def sha256(self) -> str:
        """Digest of all that it says: kinds of cells, their number, origin and width."""
        frame = np.array([*self.cells.shape, *self.origin, self.resolution], "<f8")
        return hashlib.sha256(frame.tobytes() + self.cells.tobytes()).hexdigest()

    def copy(self) -> "Occupancy":
        """Return the same map, to be changed on its own."""
        return Occupancy(self.cells.copy(), self.origin, self.resolution)

    def placed(self, quarters: int, corner: tuple[float, float]) -> "Occupancy":
        """Return the map in a frame in which it is turned and moved.

        Args:
            quarters: Quarters of a turn to the left about its origin.
            corner: Where its south-west corner is then: least x and y [m].
        """
        turned = np.rot90(self.cells, -quarters)  # rows go north, which NumPy calls down
        return Occupancy(np.ascontiguousarray(turned), corner, self.resolution)

    def add(self, low: FloatArray, high: FloatArray) -> None:
        """Mark where solid boxes stand, as far as they are at a robot's height.

        Args:
            low: Least corners of the boxes [m], shape (n, 3), room frame.
            high: Greatest corners [m], shape (n, 3).
        """
        rows, columns = self.cells.shape
        tall = (high[:, 2] > LOWEST) & (low[:, 2] < HIGHEST)
        low, high = ((c[tall, :2] - self.origin) / self.resolution for c in (low, high))
        first = np.floor(np.round(low, 3)).astype(int)
        end = np.ceil(np.round(high, 3)).astype(int)
        first, end = np.clip(first, 0, (columns, rows)), np.clip(end, 0, (columns, rows))
        for (left, bottom), (right, top) in zip(first, end, strict=True):
            block = self.cells[bottom:top, left:right]
            block[block == FREE] = OCCUPIED

    def add_disc(self, middle: FloatArray, radius: float) -> None:
        """Mark where something round stands: every cell that it reaches into.

        Args:
            middle: Shape (2,) [m], frame of the map.
            radius: Of it [m].
        """
        rows, columns = self.cells.shape
        x = self.origin[0] + (np.arange(columns) + 0.5) * self.resolution - middle[0]
        y = self.origin[1] + (np.arange(rows) + 0.5) * self.resolution - middle[1]
        half = self.resolution / 2
        away = np.hypot(*(np.maximum(np.abs(a) - half, 0.0) for a in np.meshgrid(x, y)))
        self.cells[(away < radius) & (self.cells == FREE)] = OCCUPIED

    def passable(self, radius: float) -> NDArray[np.bool_]:
        """Return where the middle of a disc of a radius [m] can be, shape (rows, columns)."""
        least = radius / self.resolution + _HALF_DIAGONAL
        free: NDArray[np.bool_] = self._widths_away() >= least
        return free

    def clearance(self) -> FloatArray:
        """Return how far the middle of each cell is from what is not free, at least [m].

        Shape (rows, columns); negative in what is not free. A disc can be where this is its radius.
        """
        return (self._widths_away() - _HALF_DIAGONAL) * self.resolution

    def _widths_away(self) -> FloatArray:
        """Return the distances of middles of cells from those that are not free, in widths."""
        blocked = np.pad(self.cells != FREE, 1, constant_values=True)
        distance: FloatArray = ndimage.distance_transform_edt(~blocked)[1:-1, 1:-1]
        return distance

    def cell(self, x: float, y: float) -> tuple[int, int]:
        """Return row and column of a point [m], room frame; the nearest if it is outside."""
        rows, columns = self.cells.shape
        row = math.floor((y - self.origin[1]) / self.resolution)
        column = math.floor((x - self.origin[0]) / self.resolution)
        return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1)

    def middles(self, cells: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return the middles of the cells that are said, shape (n, 2) [m], room frame."""
        rows, columns = np.nonzero(cells)
        return np.column_stack([columns, rows]) * self.resolution + (
            np.array(self.origin) + self.resolution / 2
        )

    @property
    def png(self) -> bytes:
        """The map as a PNG, a pixel a cell, north up, in the greys of ROS."""
        greys = np.full(self.cells.shape, _GREYS[UNDEFINED], np.uint8)
        for value, grey in _GREYS.items():
            greys[self.cells == value] = grey
        written = io.BytesIO()
        Image.fromarray(greys[::-1]).save(written, "PNG")
        return written.getvalue()

    @classmethod
    def of_png(
        cls, png: bytes, origin: tuple[float, float], resolution: float = FINE
    ) -> "Occupancy":
        """Return the map of which `png` is the picture.

        Args:
            png: The picture.
            origin: Where the south-west corner of its lowest, leftmost pixel is, (x, y) [m].
            resolution: Width of a pixel [m].

        Raises:
            ValueError: If it is no picture in the greys of `png`.
        """
        try:
            greys = np.asarray(Image.open(io.BytesIO(png), formats=["PNG"]))[::-1]
        except (OSError, SyntaxError, Image.DecompressionBombError) as error:
            raise ValueError(f"It is no PNG of a map: {error}") from None
        if greys.ndim != 2 or not np.isin(greys, list(_GREYS.values())).all():
            raise ValueError(f"A map has these greys, a byte each: {_GREYS}")
        cells = np.zeros(greys.shape, np.int8)
        for value, grey in _GREYS.items():
            cells[greys == grey] = value
        return cls(cells, origin, resolution)

    def save(self, path: Path, plan_sha256: str) -> None:
        """Write a NumPy archive of `cells`, `origin`, `resolution` and `plan_sha256`.

        Args:
            path: Where to.
            plan_sha256: Digest of the plan of the room that it is of.
        """
        np.savez_compressed(
            path,
            cells=self.cells,
            origin=self.origin,
            resolution=self.resolution,
            plan_sha256=plan_sha256,
        )
