"""How fast what is in a vessel becomes one, of heat as of what is dissolved.

Side by side it does by turning over, from layer to layer by diffusion of eddies.
"""

import math

_TURNOVER = 5.0
"""Time in which what is in a vessel at rest mixes by itself [s]; ours: 0.05 m at the 1 to 2 cm/s
that a difference of 2 to 5 K drives, sqrt(g beta dT L)."""
_SWIRL = 0.05
"""Way on which what moves mixes [m]; ours: the width of a vessel."""
_TREMBLE = 0.03
"""Speed up to which a liquid stirs nothing up [m/s]; ours: particles at rest move by up to 0.022
(docs/liquids.md)."""


_MOLECULAR = 1.5e-9
"""Diffusivity of a salt in water [m^2/s]: 1.2 to 2.0e-9 (CRC Handbook)."""
_LENGTH = 5e-3
"""Mixing length [m]: 0.14 of the radius in the middle of a round pipe (Nikuradse 1932, in
Schlichting, Boundary-Layer Theory, chapter on turbulent pipe flow), here of a beaker 70 mm wide."""
_REST = 0.006
"""Mean speed up to which a vessel has no eddies [m/s]; ours, as `dissolving` has it."""
_CONVECTION = 2e-3
"""Speed of what is at rest [m/s]; ours: a difference of 0.05 K drives as much over 0.05 m,
sqrt(g beta dT L). With half of it the electrode of `level4/titrate` lags behind the end point."""


def mixed_share(speed: float, period: float) -> float:
    """Return which part of what a particle has comes into common with all at its height.

    Of heat, with all of its vessel.

    Args:
        speed: Mean speed of what is in the vessel [m/s].
        period: Time [s].
    """
    return -math.expm1(-period * _rate(speed))


def exchanged_between_layers(speed: float, layer: float) -> float:
    """Return how far what is in common diffuses before it is given back, by the layer's square.

    Diffusivity of molecules and eddies, the latter speed times mixing length (Prandtl; Bird,
    Stewart and Lightfoot, Transport Phenomena, section 5.4). Only the share that `mixed_share` has
    of everything diffuses, so much the further.

    Args:
        speed: Mean speed of what is in the vessel [m/s].
        layer: Height of a layer [m].
    """
    eddies = _LENGTH * (_CONVECTION + max(speed - _REST, 0.0))
    return (_MOLECULAR + eddies) / (_rate(speed) * layer**2)


def _rate(speed: float) -> float:
    return 1.0 / _TURNOVER + speed / _SWIRL


def stirred_share(speed: float, period: float) -> float:
    """Return which part of what floats in a particle comes to the mean of its vessel.

    Args:
        speed: Mean speed of what is in the vessel [m/s].
        period: Time [s].
    """
    return -math.expm1(-period * max(speed - _TREMBLE, 0.0) / _SWIRL)
