"""What a robot that drives knows of a room beforehand."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.world.pose import FloatArray


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
    """

    cells: NDArray[np.int8]
    origin: tuple[float, float]
    resolution: float
    docks: tuple[Dock, ...]
