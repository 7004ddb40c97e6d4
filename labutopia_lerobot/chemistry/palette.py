"""How solutions of a fixed list of species look, many at once: clear, coloured or clouded."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry import colour
from labutopia_lerobot.chemistry.colour import Floats, Rgb
from labutopia_lerobot.chemistry.network import network

_CLEAR = np.array([0.80, 0.87, 0.92, 0.40])
"""Clear water before a light wall, and its opacity; ours, that of other clear liquids."""

_THICK = 3.0
"""Thickness of liquid that one looks through, in cm; ours: half a beaker's width."""

_DEEPEST, _MILKY = 0.90, 0.985
"""Opacity of what lets no light through, and of what scatters all of it; ours."""

_SCATTERING = 130.0
"""What a suspension scatters out of the way [m^2/kg]; ours: spheres of 1 micrometre of 4500 kg/m^3,
of whose cross-section 3 / (2 r rho) a fifth turns light around (1 - g = 0.2, Bohren and Huffman,
Absorption and Scattering of Light by Small Particles)."""


class Palette:
    """The looks of solutions.

    Args:
        species: Keys of what may be in them, in the order of all rows.
        scattering: What solids scatter that are no precipitates, by species [m^2/kg].
    """

    def __init__(self, species: Sequence[str], scattering: Mapping[str, float]) -> None:
        made = network().species
        self._spectra = np.array([colour.spectrum_of(key) for key in species])
        self._tints = np.array([colour.tint_of(key) for key in species])
        solid = [key.endswith("(s)") for key in species]
        masses = [made[key].composition.molar_mass for key in species]
        self._solid = np.where(solid, masses, 0.0)
        looks = [colour.rgb(made[key].colour or "#ffffff") for key in species]
        self._looks = np.array(looks)
        self._scattering = np.array([scattering.get(key, _SCATTERING) for key in species])

    def colour(self, amounts: NDArray[np.float64]) -> Rgb:
        """Return the sRGB of 1 cm of a solution, or as stated, as it is dissolved.

        Args:
            amounts: Shape (species,) [mol/m^3].
        """
        red, green, blue = colour.encoded(self._light(amounts[None], 1.0))[0].tolist()
        return (red, green, blue)

    def seen(self, amounts: NDArray[np.float64]) -> Floats:
        """Return how solutions look in a vessel, colour and opacity, shape (n, 4).

        Args:
            amounts: Shape (n, species) [mol/m^3].
        """
        through = self._light(amounts, _THICK)
        grams = amounts * self._solid
        away = self._away(amounts)
        cloud = 1.0 - np.exp(-away * 0.01 * _THICK)
        seen = grams * self._scattering @ self._looks
        solid = np.divide(seen, away, out=np.ones_like(seen), where=away > 0.0)
        milk = solid * colour.encoded(self._light(amounts, 1.0))
        rgb = (1.0 - cloud) * _CLEAR[:3] * colour.encoded(through) + cloud * milk
        opacity = _CLEAR[3] + (_DEEPEST - _CLEAR[3]) * (1.0 - through.min(axis=1, keepdims=True))
        return np.hstack([rgb, opacity + (_MILKY - opacity) * cloud])

    def lying(self, amounts: NDArray[np.float64], around: NDArray[np.float64]) -> Floats:
        """Return how a heap of solids looks in a solution, colour and opacity, shape (4,).

        Args:
            amounts: Of each species in the heap, shape (species,), not all 0.
            around: Amounts of the solution around it, shape (species,) [mol/m^3].
        """
        grams = amounts * self._solid
        own = colour.linear(grams @ self._looks / grams.sum())
        seen = colour.encoded(own * self._light(around[None], 0.5 * _THICK)[0])
        return np.append(seen, np.exp(-self._away(around[None])[0, 0] * 0.01 * _THICK))

    def settled(self, amounts: NDArray[np.float64], around: NDArray[np.float64]) -> Floats:
        """Return how a layer of solids on a bottom looks in a solution, shape (4,): as `lying`.

        Args:
            amounts: Of each species on the bottom, shape (species,), not all 0 [mol/m^2].
            around: Amounts of the solution around it, shape (species,) [mol/m^3].
        """
        look = self.lying(amounts, around)
        look[3] *= -np.expm1(-self._away(amounts[None])[0, 0])
        return look

    def _away(self, amounts: NDArray[np.float64]) -> Floats:
        """Return what solids scatter out of the way, shape (n, 1) [1/m]; of a layer, in all."""
        return np.asarray((amounts * self._solid @ self._scattering)[:, None])

    def _light(self, amounts: NDArray[np.float64], centimetres: float) -> Floats:
        """Return the linear sRGB that comes through, shape (n, 3).

        Bands are seen through so much of a solution. A stated colour is taken for that of a whole
        vessel, an estimate of ours: of copper(II) red 140 is stated, and the foot of its band gives
        173 in 3 cm and 223 in 1 cm, so that three times the stated would be far too much.
        """
        molar = 1e-3 * np.maximum(amounts, 0.0)
        bands = 10.0 ** -(centimetres * molar @ self._spectra) @ colour.to_linear_srgb().T
        return np.asarray(np.clip(bands * 10.0 ** -(molar @ self._tints), 0.0, 1.0))
