"""Light and film of the pictures that Filament draws.

Filament counts light in lux and candela; a camera's exposure and white balance make a picture of
it. Filament's own does so with noise that changes with time, so that one moment would not give the
same bits twice; so it hands out what fell on the film, linear, and the rest is done here.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.sim.linear_light import picture_of

_ENVIRONMENT, _LAMPS = 16_000.0, 200_000.0
"""Light from all around, and of all lamps together (MuJoCo, "Rendering", `fallback.*`): chosen so
that what is white and faces the lamps just does not saturate in the tasks of level 1."""

HEADLIGHT_LUX = 90_000.0
"""Illuminance of MuJoCo's headlight per unit of its diffuse brightness; chosen likewise."""

_WHITE_BALANCE = (0.96, 1.0, 1.08)
"""Gains of red, green and blue that make a white wall grey: Filament's surroundings are warm."""

_FILM_GAIN = 1.2
"""How much brighter films are than the pictures of policies: one sees into the shade (ours)."""


def light_for_filament(spec: mujoco.MjSpec) -> None:
    """Say in a spec how bright Filament is to make the lamps that it has; others ignore it."""
    for what, value in (("environment_light", _ENVIRONMENT), ("scene_light", _LAMPS)):
        spec.add_numeric(name=f"filament.fallback.{what}_intensity", data=[value], size=1)


def developed(linear: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the picture of what fell on the film, both of shape (height, width, 3)."""
    channels = [curve[linear[..., number]] for number, curve in enumerate(_CURVES)]
    return np.stack(channels, axis=-1)


def balanced(linear: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Return the light of a film's picture, 0 to 1, from what fell on it; (height, width, 3)."""
    light = linear * (np.array(_WHITE_BALANCE, np.float32) * np.float32(_FILM_GAIN / 255))
    seen: NDArray[np.float32] = np.minimum(light, np.float32(1.0))
    return seen


_CURVES = [picture_of(np.minimum(gain * np.arange(256) / 255, 1.0)) for gain in _WHITE_BALANCE]
