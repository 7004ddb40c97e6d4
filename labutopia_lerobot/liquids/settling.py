"""Precipitates sink in a vessel that stands still, and are stirred up in one that does not."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.compound import substances
from labutopia_lerobot.liquids.mixing import stirred_share
from labutopia_lerobot.substances.substance import WATER
from labutopia_lerobot.world import FloatArray

_GRAIN = 1e-5
"""Diameter of a precipitate's grain [m]; ours: fresh ones have 1 to 20 micrometres."""

_DENSITY = 2500.0
"""Of a solid whose density the table does not know [kg/m^3]; ours, that of most salts."""

_GRAVITY = 9.81


def sinking_speeds(species: Sequence[str], grains: Mapping[str, float] | None = None) -> FloatArray:
    """Return how fast grains of each species sink in water [m/s], shape (species,); 0 if no solid.

    Stokes' law for a sphere (Bird, Stewart and Lightfoot, Transport Phenomena, section 2.6); of
    grains that are no precipitate's, with the drag of Schiller and Naumann (1933).

    Args:
        species: Their keys.
        grains: Diameter of a grain, of species that are filled in as crystals [m].
    """
    known = {one.formula: one.density for one in substances().values() if one.phase == "solid"}
    speeds = np.zeros(len(species))
    for index, key in enumerate(species):
        if key.endswith("(s)"):
            denser = (known.get(key.removesuffix("(s)")) or _DENSITY) - WATER.density
            grain = (grains or {}).get(key, _GRAIN)
            speeds[index] = max(denser, 0.0) * _GRAVITY * grain**2 / (18.0 * WATER.viscosity)
            if grain > _GRAIN:
                speeds[index] = _dragged(float(speeds[index]), grain)
    return speeds


def _dragged(stokes: float, grain: float) -> float:
    """Return how fast a coarse grain [m] sinks, from how fast it would by Stokes' law [m/s]."""
    speed = stokes
    for _ in range(50):  # it halves its error each time
        reynolds = WATER.density * speed * grain / WATER.viscosity
        speed = 0.5 * (speed + stokes / (1.0 + 0.15 * reynolds**0.687))
    return speed


def let_sink(
    contents: FloatArray,
    heights: NDArray[np.float64],
    sinking: FloatArray,
    layer: float,
    speed: float,
    period: float,
) -> None:
    """Let the solids of one vessel sink from layer to layer, or stir them up, in place.

    Args:
        contents: Amount of each solid that every particle holds, shape (m, solids) [mol].
        heights: Of the particles, shape (m,) [m].
        sinking: How fast each solid sinks, shape (solids,) [m/s].
        layer: Height of a layer [m].
        speed: Mean speed in the vessel [m/s].
        period: Time [s].
    """
    up = stirred_share(speed, period) * (sinking < speed)  # what sinks faster is not carried
    if up.any():
        contents += up * (contents.mean(axis=0) - contents)
    levels = np.floor((heights - heights.min()) / layer)
    _, rank, count = np.unique(levels, return_inverse=True, return_counts=True)
    leaving = -np.expm1(-sinking * period / layer) * contents * (rank > 0)[:, None]
    arriving = np.zeros((len(count) + 1, contents.shape[1]))
    for column, amounts in enumerate(leaving.T):  # what is lowest adds nothing to the last row
        into = np.where(rank > 0, rank - 1, len(count))
        arriving[:, column] = np.bincount(into, weights=amounts, minlength=len(count) + 1)
    contents += (arriving[:-1] / count[:, None])[rank] - leaving
