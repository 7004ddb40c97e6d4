"""What is printed on glass: scale, numbers and label, as one mesh just off the surface.

Seen from 0.25 m in a picture of 256 pixels a millimetre is a pixel high: numbers are 8 to
10 mm high, and only walls of 58 mm and more have room for them: beakers from 150 ml on.
"""

from typing import TYPE_CHECKING

import numpy as np

from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.parts.mesh import SEGMENTS, Mesh, join, revolve

if TYPE_CHECKING:
    from labutopia_lerobot.labware.glass.vessel import Vessel

_STEPS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 25, 50, 100, 200, 500, 1000, 2000)
"""Of scales [ml]: the smallest with fewer than ten graduations is taken."""


_TALL, _THICK = 0.008, 0.0015
"""Least height of a number and thickness of its strokes [m]; ours."""
_LEAST = 0.029
"""Radius below which numbers would go around a corner [m]."""
_SEGMENTS = {
    # strokes that are printed, of: above, upper left and right, middle, lower ones, below
    "0": "1110111",
    "1": "0010010",
    "2": "1011101",
    "3": "1011011",
    "4": "0111010",
    "5": "1101011",
    "6": "1101111",
    "7": "1010010",
    "8": "1111111",
    "9": "1111011",
}
_STROKES = (
    # azimuth, to the right, and height of the ends, in widths and heights of a digit
    ((-0.5, 1.0), (0.5, 1.0)),
    ((-0.5, 0.5), (-0.5, 1.0)),
    ((0.5, 0.5), (0.5, 1.0)),
    ((0.5, 0.5), (-0.5, 0.5)),
    ((-0.5, 0.0), (-0.5, 0.5)),
    ((0.5, 0.0), (0.5, 0.5)),
    ((0.5, 0.0), (-0.5, 0.0)),
)


def printing(vessel: "Vessel") -> Mesh:
    """Return the printing of a vessel: the graduation, and a label at the back."""
    profile = vessel.profile
    if vessel.one_mark is not None:
        strips = [(profile.fill_height(vessel.one_mark), 0.0012, 0.0, 2 * np.pi)]
    else:
        step = next(ml for ml in _STEPS if vessel.capacity < 10 * ml)
        levels = np.arange(step, 0.85 * vessel.capacity, step) * 1e-6
        strips = [(profile.fill_height(float(level)), 0.0012, 0.0, 0.5) for level in levels]
    strips.append((0.3 * vessel.height, 0.16 * vessel.height, np.pi, 0.9))
    patches = []
    for middle, tall, azimuth, wide in strips:
        heights = (middle - tall / 2, middle + tall / 2)
        edge = [(profile.outer_radius(height) + 2e-4, height) for height in heights]
        segments = max(5, round(SEGMENTS * wide / (2 * np.pi)))
        patches.append(revolve(edge, segments, azimuth - wide / 2, wide))
    if vessel.numbered and vessel.one_mark is None:
        patches += _numbers(vessel, step)
    return join(*patches)


def _numbers(vessel: "Vessel", step: float) -> list[Mesh]:
    """Return the numbers beside the graduations, as many as do not touch each other."""
    profile, patches, free = vessel.profile, list[Mesh](), 0.0
    tall = min(max(_TALL, 0.085 * vessel.height), 1.3 * _TALL)
    for level in np.arange(step, 0.85 * vessel.capacity, step):
        middle = profile.fill_height(1e-6 * float(level))
        low, high = middle - tall / 2, middle + tall / 2
        if low > free and high < vessel.height and profile.outer_radius(high) >= _LEAST:
            patches += _number(profile, f"{level:g}", low, tall)
            free = middle + 0.75 * tall
    return patches


def _number(profile: Profile, text: str, low: float, tall: float) -> list[Mesh]:
    """Return a number to the right of the graduations; its lower edge and height in metres."""
    patches = []
    radius = profile.outer_radius(low + tall / 2)
    wide = 0.5 * tall / radius
    for place, digit in enumerate(text):
        start = 0.32 + (0.5 + 1.7 * place) * wide
        for stroke, printed in zip(_STROKES, _SEGMENTS[digit], strict=True):
            if printed == "1":
                (left, bottom), (right, top) = stroke
                around = max(abs(right - left) * wide, _THICK / radius)
                heights = (low + bottom * tall - _THICK / 2, low + top * tall + _THICK / 2)
                edge = [(profile.outer_radius(height) + 2e-4, height) for height in heights]
                middle = start + wide * (left + right) / 2
                patches.append(revolve(edge, 2, middle - around / 2, around))
    return patches
