"""How well a solution conducts: its ions' molar conductivities, less what they hold each other up.

Kohlrausch: ions migrate independently, kappa = sum c lambda. At a finite concentration each is
slower by Onsager's two terms, of the square root of the ionic strength I: a share of lambda, for
the cloud of counter-ions that lags behind it, and a constant, for the water that this cloud drags
along (Robinson and Stokes, Electrolyte Solutions, chapter 7; 0.229 and 30.1 S cm^2/mol of water at
25 C). Both are divided by 1 + 1.3 sqrt(I), which is ions of 4 angstrom (Falkenhagen, Leist and
Kelbg, 1952). Ion pairs are not counted: copper sulfate of 0.01 mol/l conducts 14 % too well.
"""

import math
from collections.abc import Mapping

from labutopia_lerobot.chemistry.formula import parse

_LIMITING = {
    "H^+": 349.65,
    "Li^+": 38.66,
    "Na^+": 50.08,
    "K^+": 73.48,
    "NH4^+": 73.5,
    "Ag^+": 61.9,
    "Mg^2+": 53.0,
    "Ca^2+": 59.47,
    "Sr^2+": 59.4,
    "Ba^2+": 63.6,
    "Mn^2+": 53.5,
    "Fe^2+": 54.0,
    "Co^2+": 55.0,
    "Cu^2+": 53.6,
    "Zn^2+": 52.8,
    "Cd^2+": 54.0,
    "Pb^2+": 71.0,
    "Al^3+": 61.0,
    "Fe^3+": 68.0,
    "OH^-": 198.0,
    "F^-": 55.4,
    "Cl^-": 76.31,
    "Br^-": 78.1,
    "I^-": 76.8,
    "NO3^-": 71.42,
    "ClO3^-": 64.6,
    "ClO4^-": 67.3,
    "SCN^-": 66.0,
    "MnO4^-": 61.3,
    "HCO3^-": 44.5,
    "HSO4^-": 52.0,
    "CH3COO^-": 40.9,
    "HCOO^-": 54.6,
    "SO4^2-": 80.0,
    "CO3^2-": 69.3,
    "CrO4^2-": 85.0,
    "C2O4^2-": 74.11,
    "[Fe(CN)6]^3-": 100.9,
    "[Fe(CN)6]^4-": 110.4,
}
"""Of an equivalent at infinite dilution in water at 25 C [S cm^2/mol] (CRC Handbook, "Equivalent
conductivity of electrolytes in aqueous solution" and "Ionic conductivity and diffusion at infinite
dilution"; quoted from memory, no copy was at hand)."""
_LAGS, _DRAGGED, _SIZE = 0.229, 30.1, 1.3
_UNKNOWN = 0.02
"""Share of the ions, by charge, that may be of unknown conductivity: they are left out; ours."""


def conductivity(concentrations: Mapping[str, float]) -> float:
    """Return the conductivity at 25 C [S/m]; not a number where too little is known of the ions.

    Args:
        concentrations: Of dissolved species, by keys such as `Na^+(aq)` [mol/m^3].
    """
    ions = {key.removesuffix("(aq)"): 1e-3 * c for key, c in concentrations.items() if c > 0.0}
    charges = {key: parse(key).charge for key in ions}
    total = sum(c * abs(charges[key]) for key, c in ions.items())
    unknown = sum(c * abs(charges[key]) for key, c in ions.items() if key not in _LIMITING)
    if unknown > _UNKNOWN * total:
        return math.nan
    strength = 0.5 * sum(c * charges[key] ** 2 for key, c in ions.items())
    root = math.sqrt(strength) / (1.0 + _SIZE * math.sqrt(strength))
    counter = {sign: _mean_charge(ions, charges, -sign) for sign in (-1, 1)}
    kappa = 0.0
    for key, c in ions.items():
        charge = charges[key]
        if key in _LIMITING:
            lags = _LAGS * abs(charge) * counter[1 if charge > 0 else -1] * _LIMITING[key]
            slower = (lags + _DRAGGED * abs(charge)) * root
            kappa += c * abs(charge) * max(_LIMITING[key] - slower, 0.0)
    return 0.1 * kappa  # mol/l S cm^2/mol is mS/cm


def _mean_charge(ions: Mapping[str, float], charges: Mapping[str, int], sign: int) -> float:
    """Return the mean charge number of the ions of a sign, each counted by its charge."""
    these = [(c, charges[key] * sign) for key, c in ions.items() if charges[key] * sign > 0]
    total = sum(c * z for c, z in these)
    return sum(c * z * z for c, z in these) / total if total else 1.0
