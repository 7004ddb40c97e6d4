"""A planar laser scanner on a base: where it is and what it sees."""

import math
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.world import FloatArray


@dataclass(frozen=True)
class LaserScanner:
    """A scanner that looks around in a level plane.

    Attributes:
        place: Where its rays begin [m], base frame.
        field: Angle that it sees, half of it to either side of straight ahead [deg].
        beams: How many rays that is divided into, with both ends.
        nearest: Least distance that it reports [m]; what is nearer, it reports as this.
        farthest: Greatest distance [m]; where there is nothing nearer, it reports this.
    """

    place: tuple[float, float, float]
    field: float
    beams: int
    nearest: float
    farthest: float

    @property
    def angles(self) -> FloatArray:
        """Angles of the rays to the left of straight ahead [rad], from right to left (beams,)."""
        half = math.radians(self.field) / 2
        angles: FloatArray = np.linspace(-half, half, self.beams, dtype=np.float64)
        return angles

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the rays: their angles to the left of straight ahead [deg]."""
        return tuple(f"deg_{degrees:g}" for degrees in np.round(np.degrees(self.angles), 2))
