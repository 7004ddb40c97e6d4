"""Clear glass to the eye: see-through where it faces one, dark at its outline, with streaks.

A wall seen edge on is looked through for a long way, and mirrors more than it lets through
(Fresnel; Hecht, "Optics", 4.6). Fixed shading knows nothing of that. But a vessel is round: a
texture that goes around it says how a wall looks by its angle to the line of sight, and the
code that draws the vessel turns it about its axis until the beginning of the texture faces the eye.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

GLEAM = "gleam"
"""Name of the texture; walls in it are to be turned towards the eye."""

CLEAR = 0.4
"""Walls that are less opaque than this are clear glass."""

_SIZE = 256, 8
_FACING = 0.14
"""Opacity of what faces the eye, as a part of that of the outline."""
_OUTLINE_POWER = 7.0
"""Narrowness of the outline: its opacity grows with this power of the sine of the angle."""
_OUTLINE = (0.66, 0.82, 0.79)
"""Colour of the outline beside that of the wall: glass is greenish where it is thick."""
_STREAKS = ((-0.62, 0.09, 0.60), (0.80, 0.05, 0.34))
"""Ceiling lights in the wall: angle from the line of sight [rad], half width [rad], strength."""


def gleam(spec: mujoco.MjSpec) -> str:
    """Return the name of the texture, added where the spec has none yet."""
    if spec.texture(GLEAM) is None:
        width, height = _SIZE
        texture = spec.add_texture(
            name=GLEAM,
            type=mujoco.mjtTexture.mjTEXTURE_2D,
            nchannel=4,
            width=width,
            height=height,
        )
        texture.data = np.tile(_around(width), (height, 1, 1)).tobytes()
    return GLEAM


def coordinates(segments: int, points: int) -> NDArray[np.float64]:
    """Return the texture's coordinates of the vertices that `revolve` makes, shape (n, 2)."""
    around = np.repeat(np.linspace(0.0, 1.0, segments + 1), points)
    return np.column_stack([around, np.full_like(around, 0.5)])


def _around(width: int) -> NDArray[np.uint8]:
    """Return colour and opacity over the azimuth, from that towards the eye, shape (width, 4)."""
    azimuth = 2 * np.pi * (np.arange(width) + 0.5) / width
    edge = np.abs(np.sin(azimuth)) ** _OUTLINE_POWER
    opacity = _FACING + (1 - _FACING) * edge
    color = 1.0 - edge[:, None] * (1.0 - np.array(_OUTLINE))
    for middle, half_width, strength in _STREAKS:
        deviation = np.angle(np.exp(1j * (azimuth - middle)))
        streak = np.exp(-((deviation / half_width) ** 4))
        opacity = np.maximum(opacity, strength * streak)
        color = color + streak[:, None] * (1.0 - color)
    levels: NDArray[np.uint8] = np.rint(255 * np.column_stack([color, opacity])).astype(np.uint8)
    return levels
