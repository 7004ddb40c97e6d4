"""What a robot that drives knows of a room beforehand."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.world.pose import FloatArray

ASIDE = 0.15
"""Greatest distance of a thing to the side of straight ahead of an arm [m]; ours."""
_TINY = 1e-12
"""Stands for no distance at all [m]: one may divide by it."""


@dataclass(frozen=True, eq=False)
class Dock:
    """A place of a base at a bench.

    Attributes:
        bench: Name of the bench: in a plan that of the piece, in a world that of its contacts.
        position: Middle of the base, shape (2,) [m], frame of the floor.
        yaw: Heading, to the bench [rad].
        before: Point straight behind it to which the robot drives as a disc, shape (2,) [m].
    """

    bench: str
    position: FloatArray
    yaw: float
    before: FloatArray


@dataclass(frozen=True, eq=False)
class Floor:
    """The floor of a room: where one can drive, and to where; world frame.

    Attributes:
        cells: Kinds of cells, as `navigation.occupancy` has them, shape (rows, columns).
        origin: South-west corner of cell (0, 0) [m].
        resolution: Width of a cell [m].
        docks: Places at benches.
        fixture_docks: Places before what belongs to the room and is reached into, such as a sink.
        walls: Least and greatest corners of what of the walls inside the room no arm reaches
            through, shape (n, 2, 2) [m].
    """

    cells: NDArray[np.int8]
    origin: tuple[float, float]
    resolution: float
    docks: tuple[Dock, ...]
    fixture_docks: tuple[Dock, ...] = ()
    walls: FloatArray = field(default_factory=lambda: np.zeros((0, 2, 2)))

    def wall_between(self, one: FloatArray, other: FloatArray) -> bool:
        """Return whether a wall is on the straight way between two points, shape (2,) [m]."""
        way = np.where(other == one, _TINY, other - one)
        along = (self.walls - one) / way
        enters, leaves = along.min(axis=1).max(axis=1), along.max(axis=1).min(axis=1)
        return bool(((enters < leaves) & (enters < 1.0) & (leaves > 0.0)).any())

    def dock_at(
        self,
        point: FloatArray,
        arm: float,
        ahead: tuple[float, float],
        *,
        reaching_in: bool = False,
    ) -> Dock | None:
        """Return the place from which an arm has a point most straight ahead, or None.

        Args:
            point: Shape (2,) [m].
            arm: How far before the middle of the base that of the arm is [m].
            ahead: Least and greatest distance of the point before the base of the arm [m].
            reaching_in: Whether the point may be that of a fixture.
        """
        best, least = None, ASIDE
        for dock in (*self.docks, *(self.fixture_docks if reaching_in else ())):
            c, s = math.cos(dock.yaw), math.sin(dock.yaw)
            x, y = point - dock.position
            if ahead[0] <= c * x + s * y - arm <= ahead[1] and abs(c * y - s * x) < least:
                best, least = dock, abs(c * y - s * x)
        return best
