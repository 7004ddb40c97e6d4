"""Textures of surfaces, made in code: grey patterns that are multiplied with a colour."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

SIZE = 256
"""Side of a texture [pixels]; it continues itself over its edges."""


@dataclass(frozen=True)
class Pattern:
    """Random noise, smoothed along two directions.

    Attributes:
        depth: How much darker than the colour it gets, 0 to 1.
        length: How far the noise is alike along the grain, its standard deviation [pixels].
        width: The same across the grain [pixels].
        rings: Into how many lines, light and dark, the noise is cut; 0 leaves it as it is.
        flecks: Share of the surface that is as dark as it gets, the rest being half as dark at
            most; 0 for all shades equally often.
    """

    depth: float
    length: float
    width: float
    rings: int = 0
    flecks: float = 0.0


PATTERNS = {
    "speckled": Pattern(depth=0.13, length=0.45, width=0.45, flecks=0.08),
    "grained": Pattern(depth=0.34, length=90.0, width=8.0, rings=7),
    "brushed": Pattern(depth=0.20, length=70.0, width=0.8),
}
"""Laminate with a fine grain; wood; steel that was ground in one direction. All ours."""


@cache
def texture(name: str) -> NDArray[np.uint8]:
    """Return one of `PATTERNS` as a picture, shape (SIZE, SIZE, 3); always the same."""
    pattern = PATTERNS[name]
    noise = np.random.default_rng(list(name.encode())).standard_normal((SIZE, SIZE))
    frequencies = 2 * np.pi * np.fft.fftfreq(SIZE)
    smoothing = np.exp(
        -0.5 * (pattern.width * frequencies[:, None]) ** 2
        - 0.5 * (pattern.length * frequencies[None, :]) ** 2
    )
    smooth = np.fft.ifft2(np.fft.fft2(noise) * smoothing).real
    ranks = np.empty(smooth.size)
    ranks[np.argsort(smooth, axis=None)] = np.linspace(0.0, 1.0, smooth.size)
    level = ranks.reshape(smooth.shape)  # every shade equally often
    if pattern.rings:
        level = 0.5 + 0.5 * np.sin(2 * np.pi * pattern.rings * level)
    if pattern.flecks:
        level = np.where(level > 1.0 - pattern.flecks, 1.0, 0.5 * level)
    grey = np.round(255 * (1.0 - pattern.depth * level)).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)
