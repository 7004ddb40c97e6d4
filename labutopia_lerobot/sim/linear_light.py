"""Light and the bytes of a picture: the curve of sRGB, both ways (IEC 61966-2-1)."""

import numpy as np
from numpy.typing import NDArray

_LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)
"""Luminance of linear red, green and blue (ITU-R BT.709)."""
_SATURATION, _CONTRAST, _MIDDLE = np.float32(1.4), np.float32(1.2), np.float32(0.45)
"""How far colours are from grey, how steep the curve is, and the light that it leaves (ours)."""


def picture_of(light: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return the levels of sRGB of linear light, 0 to 1, of the same shape."""
    curved = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    levels: NDArray[np.uint8] = np.rint(255 * curved).astype(np.uint8)
    return levels


def light_of(picture: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Return the linear light, 0 to 1, of levels of sRGB, of the same shape."""
    return _LIGHT[picture]


def _light() -> NDArray[np.float32]:
    level = np.arange(256) / 255
    light = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    return light.astype(np.float32)


_LIGHT = _light()
"""Linear light of every level."""


def graded(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return light as films show it: richer in colour and contrast, shape (..., 3).

    Pictures of policies are never graded.
    """
    luminance = light @ _LUMINANCE
    rich = luminance[..., None] + _SATURATION * (light - luminance[..., None])
    contrasted = _MIDDLE * (np.clip(rich, 0.0, None) / _MIDDLE) ** _CONTRAST
    seen: NDArray[np.float32] = np.clip(contrasted, 0.0, 1.0)
    return seen
