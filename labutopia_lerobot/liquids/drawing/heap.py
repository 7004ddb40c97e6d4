"""Crystals on the bottom of a vessel, as they are drawn: a heap of grains."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.surface import LiquidSurface, VesselPose

_REPOSE = math.radians(30.0)
"""Angle of its slope; ours: dry grains come to rest at 25 to 35 degrees."""
_GRAINS, _AROUND = 160, 12
"""How many grains lie on the slope, and corners of the cone below them; ours."""
_EDGE = 0.7 * math.sqrt(math.pi / _GRAINS)
"""Edge of a grain, in radii of the heap: so big that together they cover it."""
_DARKEST = 0.65
"""Brightness of the darkest grain, 1 that of the substance: one sees that there are many; ours."""
_LIFT = 3e-4
"""How far it is drawn above the glass [m]."""
_GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
"""Angle from grain to grain, as seeds in a sunflower: no grain hides another."""

_UP = np.array([0.0, 0.0, 1.0])
_CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_FACES = np.array(
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
)


class Heap(NamedTuple):
    """Crystals that lie in the middle of a vessel's bottom.

    Attributes:
        vessel: What they lie in.
        volume: Of the heap, with what is between its grains [m^3].
        color: Its colour and opacity, as it is seen through the liquid, shape (4,).
    """

    vessel: VesselPose
    volume: float
    color: NDArray[np.float64]


def heap_surface(heap: Heap) -> LiquidSurface:
    """Return the surface of a heap: a cone, or what of one fits between the walls, of grains."""
    profile, position_w, rotation_wb = heap.vessel
    radius, height, layer = _size(heap.volume, 0.95 * profile.inner_radius(profile.bottom))
    floor = profile.bottom + _LIFT
    grains = _grains(radius, height, floor + layer)
    rim = _rim(radius)
    low, high = rim + floor * _UP, rim + (floor + layer) * _UP
    tip = np.tile((floor + layer + height) * _UP, (_AROUND, 1))
    after = np.roll(np.arange(_AROUND), -1)
    wall = np.stack([low, low[after], high[after], high], axis=1)
    slope = np.stack([high, high[after], tip, tip], axis=1)
    corners = np.concatenate([wall, slope, grains])  # (quads, 4, 3); what is drawn last is on top
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals = across / np.maximum(np.linalg.norm(across, axis=1), 1e-12)[:, None]
    return LiquidSurface(
        (position_w + corners.reshape(-1, 3) @ rotation_wb.T).astype(np.float32),
        (np.repeat(normals, 4, axis=0) @ rotation_wb.T).astype(np.float32),
        np.arange(4 * len(corners), dtype=np.int32).reshape(-1, 4),
    )


def heap_colors(heap: Heap) -> NDArray[np.float64]:
    """Return colour and opacity of its quads, shape (quads, 4): no two grains are alike."""
    bright = _DARKEST + (1.0 - _DARKEST) * _scattered(3)
    shades = np.concatenate([np.full(2 * _AROUND, _DARKEST), np.repeat(bright, len(_FACES))])
    opacity = np.full(len(shades), heap.color[3])
    return np.column_stack([shades[:, None] * heap.color[:3], opacity])


def _size(volume: float, widest: float) -> tuple[float, float, float]:
    """Return radius and height of the cone, and the height of the layer below it [m]."""
    slope = math.tan(_REPOSE)
    radius = (3.0 * volume / (math.pi * slope)) ** (1 / 3)
    if radius <= widest:
        return radius, slope * radius, 0.0
    cone = math.pi * widest**3 * slope / 3.0
    return widest, slope * widest, (volume - cone) / (math.pi * widest**2)


def _grains(radius: float, height: float, base: float) -> NDArray[np.float64]:
    """Return the faces of all grains, shape (quads, 4, 3), metres, frame of the vessel."""
    share = np.sqrt((np.arange(_GRAINS) + 0.5) / _GRAINS)
    angles = _GOLDEN * np.arange(_GRAINS)
    out = radius * (1.0 - 0.5 * _EDGE) * share
    places = np.column_stack(
        [out * np.cos(angles), out * np.sin(angles), base + height * (1.0 - share)]
    )
    cubes = _EDGE * radius * np.einsum("gij,cj->gci", _turned(), _CUBE)
    cubes[..., 2] = np.maximum(cubes[..., 2] + places[:, None, 2], base)
    cubes[..., :2] += places[:, None, :2]
    faces: NDArray[np.float64] = cubes[:, _FACES].reshape(-1, 4, 3)
    return faces


def _turned() -> NDArray[np.float64]:
    """Return how each grain is turned, shape (grains, 3, 3)."""
    about, lean = 2 * math.pi * _scattered(1), math.pi / 4 * _scattered(2)
    c, s, d, e = np.cos(about), np.sin(about), np.cos(lean), np.sin(lean)
    rows = [c, -s * d, s * e, s, c * d, -c * e, np.zeros(_GRAINS), e, d]
    return np.stack(rows, axis=1).reshape(-1, 3, 3)


def _scattered(which: int) -> NDArray[np.float64]:
    """Return a number in [0, 1) for each grain, the same ones always."""
    steps = (0.7548776662, 0.5698402910, 0.8191725134)  # of Roberts' sequences R2 and R3
    return np.asarray(np.arange(1, _GRAINS + 1) * steps[which - 1] % 1.0, dtype=np.float64)


def _rim(radius: float) -> NDArray[np.float64]:
    """Return the corners of the cone's outline, shape (corners, 3)."""
    angles = 2 * math.pi * np.arange(_AROUND) / _AROUND
    return radius * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(_AROUND)])
