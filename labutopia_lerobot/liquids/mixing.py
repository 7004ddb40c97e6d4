"""How fast what is in a vessel becomes one, of heat as of what is dissolved."""

import math

_TURNOVER = 5.0
"""Time in which what is in a vessel at rest mixes by itself [s]; ours: 0.05 m at the 1 to 2 cm/s
that a difference of 2 to 5 K drives, sqrt(g beta dT L)."""
_SWIRL = 0.05
"""Way on which what moves mixes [m]; ours: the width of a vessel."""
_TREMBLE = 0.03
"""Speed up to which a liquid stirs nothing up [m/s]; ours: particles at rest move by up to 0.022
(docs/liquids.md)."""


def mixed_share(speed: float, period: float) -> float:
    """Return which part of what a particle has comes to the mean of its vessel.

    Args:
        speed: Mean speed of what is in the vessel [m/s].
        period: Time [s].
    """
    return -math.expm1(-period * (1.0 / _TURNOVER + speed / _SWIRL))


def stirred_share(speed: float, period: float) -> float:
    """Return which part of what floats in a particle comes to the mean of its vessel.

    Args:
        speed: Mean speed of what is in the vessel [m/s].
        period: Time [s].
    """
    return -math.expm1(-period * max(speed - _TREMBLE, 0.0) / _SWIRL)
