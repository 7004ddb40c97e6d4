"""A precipitate that has settled, as it is drawn: a layer that covers a vessel's bottom."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.surface import LiquidSurface, VesselPose

_AROUND = 24
"""Corners of its outline: a beaker of 90 mm is round to within 0.4 mm."""
_INSET = 1e-3
"""How far it ends before the wall, and lies above the glass [m]: it must not be hidden in it."""


class Sediment(NamedTuple):
    """What covers the bottom of a vessel, too thin for its thickness to be seen.

    Attributes:
        vessel: What it lies in.
        color: Its colour, and what part of the bottom it hides, as it is seen through the liquid,
            shape (4,).
    """

    vessel: VesselPose
    color: NDArray[np.float64]


def sediment_surface(sediment: Sediment) -> LiquidSurface:
    """Return the surface of a sediment: a disc."""
    profile, position_w, rotation_wb = sediment.vessel
    floor = profile.bottom + _INSET
    angles = 2 * np.pi * np.arange(_AROUND) / _AROUND
    around = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(_AROUND)])
    rim = (profile.inner_radius(floor) - _INSET) * around
    points = np.vstack([rim, np.zeros(3)])
    points[:, 2] = floor
    here = np.arange(_AROUND)
    after = (here + 1) % _AROUND
    middle = np.full(_AROUND, _AROUND)
    up = np.tile((0.0, 0.0, 1.0), (len(points), 1))
    return LiquidSurface(
        (position_w + points @ rotation_wb.T).astype(np.float32),
        (up @ rotation_wb.T).astype(np.float32),
        np.column_stack([middle, here, after, after]).astype(np.int32),
    )
