"""The temperature of liquids: every particle has one, and shares it with those around."""

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.mixing import mixed_share
from labutopia_lerobot.processes import Warmth
from labutopia_lerobot.substances.substance import WATER, Substance
from labutopia_lerobot.world import FloatArray


def capacities(amounts: FloatArray, substances: tuple[Substance, ...], volume: float) -> FloatArray:
    """Return what warms each particle by 1 K [J/K], shape (n,).

    Args:
        amounts: Part of each particle that is each substance, shape (n, substances).
        substances: Those substances.
        volume: Of a particle [m^3].
    """
    each = np.array([substance.density * substance.specific_heat for substance in substances])
    capacity: FloatArray = volume * (amounts @ each)
    return capacity


def warmth(
    amounts: FloatArray, own: FloatArray, substances: tuple[Substance, ...], volume: float
) -> Warmth:
    """Return how warm particles are together.

    Args:
        amounts: Part of each that is each substance, shape (n, substances).
        own: Temperature of each, shape (n,), K.
        substances: Those substances.
        volume: Of a particle [m^3].
    """
    weight, share = capacities(amounts, substances, volume), amounts.mean(axis=0)
    boiling = share @ [substance.boiling_point for substance in substances]
    water = share @ [substance == WATER for substance in substances]
    total = float(weight.sum())
    mean = float(weight @ own) / total
    return Warmth(len(own) * volume, total, mean, float(boiling), float(water))


def mix(
    temperatures: FloatArray,
    capacity: FloatArray,
    inside: NDArray[np.int64],
    speeds: FloatArray,
    period: float,
) -> None:
    """Let what is in each vessel come closer to its mean, in place; heat is neither lost nor made.

    Args:
        temperatures: Shape (n,), K.
        capacity: Shape (n,), J/K.
        inside: Which vessel each particle is in, shape (n,); -1 none.
        speeds: Mean speed in each vessel [m/s].
        period: Time [s].
    """
    for vessel, speed in enumerate(speeds):
        held = inside == vessel
        if held.any():
            own, weight = temperatures[held], capacity[held]
            if own.min() == own.max():
                continue
            mean = weight @ own / weight.sum()
            temperatures[held] = own + mixed_share(speed, period) * (mean - own)
