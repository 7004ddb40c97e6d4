"""The surface of the liquid in a narrow tube, such as a burette: a column up to a level."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.particle_field import INSET
from labutopia_lerobot.liquids.drawing.surface import LiquidSurface, VesselPose

_AROUND = 12
"""Corners of its outline: a tube of 11 mm is round to within 0.2 mm."""


class Column(NamedTuple):
    """Liquid that fills a tube from its lower end up, whichever way that points.

    Attributes:
        tube: What it is in.
        volume: Of the liquid [m^3].
        color: Its colour and opacity, shape (4,).
    """

    tube: VesselPose
    volume: float
    color: NDArray[np.float64]


def column_surface(column: Column) -> LiquidSurface:
    """Return the surface of a column, closed at both ends by discs."""
    profile, position_w, rotation_wb = column.tube
    level = profile.fill_height(min(column.volume, profile.capacity))
    inner = np.array([point for point in profile.inner if point[1] < level])
    rings = np.vstack([inner, (profile.inner_radius(level), level)])
    rings[:, 0] = np.maximum(rings[:, 0] - INSET, 0.0)
    angles = 2 * np.pi * np.arange(_AROUND) / _AROUND
    around = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(_AROUND)])
    wall = rings[:, None, :1] * around + rings[:, None, 1:] * (0.0, 0.0, 1.0)
    ends = wall[[0, -1]]  # again, for their normals are others
    middles = rings[[0, -1], 1, None] * (0.0, 0.0, 1.0)
    points = np.vstack([wall.reshape(-1, 3), ends.reshape(-1, 3), middles])
    down, up = np.array([0.0, 0.0, -1.0]), np.array([0.0, 0.0, 1.0])
    normals = np.vstack(
        [np.tile(around, (len(rings), 1)), np.tile(down, (_AROUND, 1)), np.tile(up, (_AROUND, 1))]
    )
    normals = np.vstack([normals, down, up])
    here = np.arange(_AROUND)
    after = (here + 1) % _AROUND
    start = _AROUND * np.arange(len(rings) - 1)[:, None]
    sides = np.stack(
        [start + here, start + after, start + _AROUND + after, start + _AROUND + here], axis=-1
    )
    low, middle = _AROUND * len(rings), len(points) - 2
    bottom = np.column_stack([np.full(_AROUND, middle), low + after, low + here, low + here])
    high = low + _AROUND
    top = np.column_stack([np.full(_AROUND, middle + 1), high + here, high + after, high + after])
    return LiquidSurface(
        (position_w + points @ rotation_wb.T).astype(np.float32),
        (normals @ rotation_wb.T).astype(np.float32),
        np.vstack([sides.reshape(-1, 4), bottom, top]).astype(np.int32),
    )
