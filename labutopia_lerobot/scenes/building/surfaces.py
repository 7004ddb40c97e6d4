"""Textures of floors and ceilings, made in code: multiplied with the colour of the finish."""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

SIZE = 512
"""Side of a floor's texture [pixels]; it continues itself over its edges."""

FLOOR_REPEATS = {"vinyl": 2.0, "tiles": 1.2, "epoxy": 2.0}
"""Floors, by the last word of their finish -> side of the pattern that is repeated [m]:
four tiles of 0.3 m."""
TILE = 0.6
"""Side of a ceiling's tile [m], a usual grid."""
_TILE_PIXELS = 24
_EVERY = (4, 5)
"""One luminaire of 1 x 2 tiles for so many tiles across and along."""


@cache
def floor_texture(floor: str) -> NDArray[np.uint8]:
    """Return the texture of a floor of `FLOOR_REPEATS`, shape (SIZE, SIZE, 3)."""
    rng = np.random.default_rng(list(floor.encode()))
    fine = ndimage.gaussian_filter(rng.standard_normal((SIZE, SIZE)), 0.8, mode="wrap")
    broad = ndimage.gaussian_filter(rng.standard_normal((SIZE, SIZE)), 40.0, mode="wrap")
    grey = 0.95 + 0.012 * broad / broad.std()
    if floor == "tiles":
        shade = np.kron(rng.uniform(-0.02, 0.02, (4, 4)), np.ones((SIZE // 4, SIZE // 4)))
        grey = grey + shade + 0.008 * fine / fine.std()
        joint = np.arange(SIZE) % (SIZE // 4) < 3
        grey[joint, :] = grey[:, joint] = 0.70
    elif floor == "vinyl":
        flecks = ndimage.gaussian_filter(rng.standard_normal((SIZE, SIZE)), 1.6, mode="wrap")
        flecks /= flecks.std()
        grey = grey - 0.06 * (flecks > 1.6) + 0.03 * (flecks < -1.7)
        grey[:3, :] -= 0.10  # the seam between two sheets
    else:
        grey = grey + 0.01 * fine / fine.std()
    return _picture(grey)


@cache
def ceiling_texture(width: float, depth: float) -> NDArray[np.uint8]:
    """Return the texture of a whole ceiling with its luminaires, shape (height, width, 3).

    Args:
        width: Of the room, along x [m].
        depth: Of the room, along y [m].
    """
    across, along = (max(1, round(side / TILE)) for side in (width, depth))
    grey = np.full((along * _TILE_PIXELS, across * _TILE_PIXELS), 0.86)
    for row in range(along):
        grey[row * _TILE_PIXELS, :] = 0.74
    for column in range(across):
        grey[:, column * _TILE_PIXELS] = 0.74
    for x in _spread(across, _EVERY[0]):
        for y in _spread(along, _EVERY[1], 2):
            rows = slice(y * _TILE_PIXELS + 1, (y + 2) * _TILE_PIXELS)
            grey[rows, x * _TILE_PIXELS + 1 : (x + 1) * _TILE_PIXELS] = 1.0
    return _picture(grey)


def _spread(tiles: int, every: int, length: int = 1) -> list[int]:
    """Return on which tiles luminaires begin, evenly over the ceiling."""
    count = max(1, round(tiles / every))
    step = tiles / count
    return [max(0, min(round((n + 0.5) * step - length / 2), tiles - length)) for n in range(count)]


def _picture(grey: NDArray[np.float64]) -> NDArray[np.uint8]:
    level = np.round(255 * np.clip(grey, 0.0, 1.0)).astype(np.uint8)
    return np.repeat(level[:, :, None], 3, axis=2)
