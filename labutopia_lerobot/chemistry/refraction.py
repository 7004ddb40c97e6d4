"""How much a solution bends light: the refractive index of water and of some things in it."""

import math
from collections.abc import Mapping

import numpy as np

_WATER = (
    (10.0, 1.33370),
    (15.0, 1.33341),
    (20.0, 1.33299),
    (25.0, 1.33252),
    (30.0, 1.33192),
    (40.0, 1.33051),
    (50.0, 1.32894),
    (60.0, 1.32718),
)
"""Degrees C -> index of water, sodium D line, relative to air (CRC Handbook, "Index of refraction
of water"; quoted from memory, no copy was at hand)."""

_INCREMENTS = {
    "Na^+": 9.6e-3,
    "K^+": 9.7e-3,
    "Cl^-": 0.0,
    "C12H22O11": 4.91e-2,
    "C6H12O6": 2.56e-2,
    "C2H5OH": 3.1e-3,
    "C3H5(OH)3": 1.06e-2,
}
"""By how much 1 mol/l raises it, linearly; of a salt the cation has all of it (CRC Handbook,
"Concentrative properties of aqueous solutions", of 10 % by mass of NaCl, KCl, sucrose, glucose,
ethanol and glycerol; quoted from memory, no copy was at hand)."""
_TRACE = 1.0
"""Of what is not known, all in all, that does not show in the fourth digit [mol/m^3]; ours."""


def refractive_index(concentrations: Mapping[str, float], kelvin: float) -> float:
    """Return the index; not a number where it is not known.

    Args:
        concentrations: Of dissolved species, by keys such as `Na^+(aq)` [mol/m^3].
        kelvin: Temperature; a solution is taken to lose as much with it as water does [K].
    """
    held = {key.removesuffix("(aq)"): c for key, c in concentrations.items()}
    celsius = kelvin - 273.15
    known = _WATER[0][0] - 10.0 <= celsius <= _WATER[-1][0]
    if not known or sum(c for key, c in held.items() if key not in _INCREMENTS) > _TRACE:
        return math.nan
    temperatures, indices = np.array(_WATER).T
    water = float(np.interp(celsius, temperatures, indices))
    return water + 1e-3 * sum(_INCREMENTS.get(key, 0.0) * c for key, c in held.items())
