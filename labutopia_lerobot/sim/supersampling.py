"""Smooth edges and soft shadows: a picture as the mean of many exposures.

Each exposure looks through another point of every pixel and is lit from another point of the lamp
(Haeberli and Akeley, "The accumulation buffer", SIGGRAPH 1990).
"""

import math
from dataclasses import dataclass

_GOLDEN_ANGLE = math.pi * (3.0 - math.sqrt(5.0))
"""Turn from each seed of a sunflower to the next, which fills a disc evenly [rad]
(Vogel, "A better way to construct the sunflower head", Math. Biosciences 44, 1979)."""
_PLASTIC = 1.32471795724474602596
"""Its first two negative powers make a sequence that fills a square evenly (Roberts, "The
unreasonable effectiveness of quasirandom sequences", 2018)."""
_GLASS_EVERY = 3
"""Clear glass is in the way of the light in every third exposure: it shades a little (ours)."""


@dataclass(frozen=True)
class Sample:
    """One of the exposures of a picture.

    Attributes:
        right: How far right of the middle of every pixel it looks through it [pixels].
        up: How far above [pixels].
        lamp: Point of the lamp that shines, in a disc of radius 1.
        glass_shades: Whether clear glass casts a shadow.
    """

    right: float
    up: float
    lamp: tuple[float, float]
    glass_shades: bool


def samples(count: int) -> tuple[Sample, ...]:
    """Return the exposures of a picture; the more, the smoother."""
    return tuple(_sample(number, count) for number in range(count))


def _sample(number: int, count: int) -> Sample:
    across, along = ((number + 0.5) / _PLASTIC**power % 1.0 - 0.5 for power in (1, 2))
    away, turn = math.sqrt((number + 0.5) / count), number * _GOLDEN_ANGLE
    lamp = away * math.cos(turn), away * math.sin(turn)
    return Sample(across, along, lamp, number % _GLASS_EVERY == 0)
