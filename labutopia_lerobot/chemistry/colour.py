"""What colour a solution has before white: 1 cm of it, where its bands are known.

Beer-Lambert: absorbances add. A band of absorption is a Gaussian in wavenumber of one width for
all, an estimate of ours: printed are maxima, seldom widths. What has a colour but no known bands
absorbs in each channel of linear sRGB what its colour at 0.1 mol/l says, which is that of a whole
vessel; so does what has a maximum out of sight, where the shape of the foot matters more.
"""

import colorsys
import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.chemistry.network import network

_WAVELENGTHS = np.arange(380.0, 781.0, 10.0, dtype=np.float64)
"""Of light [nm]."""

_WIDTH = 4000.0
"""Full width of a band at half its height [1/cm]; an estimate of ours, that of d-d bands."""

_STATED_CONCENTRATION = 0.1
"""Of the solution that a colour without bands is of [mol/l] (`SpeciesRecord`)."""

Floats = NDArray[np.float64]

Rgb = tuple[float, float, float]


def of_solution(amounts: Mapping[str, float], volume: float) -> Rgb:
    """Return the sRGB of what is dissolved, each channel in [0, 1].

    Args:
        amounts: By key [mol].
        volume: Of the solution [m^3].
    """
    litres = volume * 1000.0
    absorbance = np.zeros(len(_WAVELENGTHS))
    channels = np.zeros(3)
    for key, amount in amounts.items():
        absorbance += spectrum_of(key) * (amount / litres)
        channels += tint_of(key) * (amount / litres)
    light = (to_linear_srgb() @ 10.0**-absorbance) * 10.0**-channels
    red, green, blue = (float(round(one, 4)) for one in encoded(np.clip(light, 0.0, 1.0)))
    return (red, green, blue)


@cache
def spectrum_of(key: str) -> Floats:
    """Return the molar absorptivity of a species at each wavelength [l/(mol cm)].

    0 of what has no spectrum that counts: see `tint_of`.
    """
    one = network().species.get(key)
    if one is None or one.phase != "aq" or not one.absorption:
        return np.zeros(len(_WAVELENGTHS))
    return _spectrum(key) if one.colour is None or _is_in_sight(key) else 0.0 * _spectrum(key)


def absorptivity(key: str, nanometres: float) -> float:
    """Return the molar absorptivity of a species at one wavelength [l/(mol cm)].

    0 of what is colourless: next to nothing of that absorbs between 325 and 1000 nm. Not a number
    of what has a colour and no known bands.

    Args:
        key: Such as `Cu^2+(aq)`.
        nanometres: Of the light.
    """
    one = network().species.get(key)
    if one is None or (one.colour is not None and not one.absorption):
        return math.nan
    return float(_bands(key, np.asarray([nanometres]))[0])


@cache
def tint_of(key: str) -> Floats:
    """Return what a species absorbs in each channel of linear sRGB [l/mol], shape (3,).

    0 of what is colourless or has a spectrum that counts instead.
    """
    one = network().species.get(key)
    if one is None or one.phase != "aq" or not one.colour or spectrum_of(key).any():
        return np.zeros(3)
    return -np.log10(linear(np.array(rgb(one.colour)))) / _STATED_CONCENTRATION


@cache
def _is_in_sight(key: str) -> bool:
    """Whether every maximum is between 400 and 700 nm: of others one sees only the foot."""
    return all(400e-9 < band.wavelength < 700e-9 for band in network().species[key].absorption)


@cache
def _spectrum(key: str) -> Floats:
    """Return the molar absorptivity at each wavelength [l/(mol cm)]."""
    return _bands(key, np.asarray(_WAVELENGTHS))


def _bands(key: str, wavelengths: NDArray[Any]) -> Floats:
    """Return the sum of the bands of a species at wavelengths [nm], [l/(mol cm)]."""
    wavenumbers: Floats = 1e7 / wavelengths
    total = np.zeros(len(wavelengths))
    for band in network().species[key].absorption:
        distance = (wavenumbers - 1e-2 / band.wavelength) / _WIDTH
        total += 10.0 * band.absorptivity * np.exp(-4.0 * math.log(2.0) * distance**2)
    return np.asarray(total)


@cache
def to_linear_srgb() -> Floats:
    """Return the matrix from transmittances to linear sRGB; all 1 gives white.

    Colour matching functions: the fits of Wyman, Sloan and Shirley, Journal of Computer Graphics
    Techniques 2 (2013) 1. From XYZ: IEC 61966-2-1. The light is of equal energy, adapted to white.
    """

    def lobe(height: float, centre: float, left: float, right: float) -> Floats:
        sigma = np.where(centre > _WAVELENGTHS, left, right)
        return np.asarray(height * np.exp(-0.5 * ((_WAVELENGTHS - centre) * sigma) ** 2))

    x = (
        lobe(0.362, 442.0, 0.0624, 0.0374)
        + lobe(1.056, 599.8, 0.0264, 0.0323)
        - lobe(0.065, 501.1, 0.0490, 0.0382)
    )
    y = lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322)
    z = lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)
    xyz = np.array([x, y, z])
    white = np.array([[0.9505], [1.0], [1.089]])
    xyz *= white / xyz.sum(axis=1, keepdims=True)
    matrix = np.array(
        [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]
    )
    light = matrix @ xyz
    return np.asarray(light / light.sum(axis=1, keepdims=True))


def rgb(colour: str) -> Rgb:
    """Return ``#rrggbb`` as three numbers in [0, 1]."""
    return (int(colour[1:3], 16) / 255, int(colour[3:5], 16) / 255, int(colour[5:7], 16) / 255)


def linear(encoded_rgb: Floats) -> Floats:
    """Return linear sRGB of sRGB as screens take it, both in [0, 1]; never quite nothing."""
    values = np.maximum(encoded_rgb, 0.004)
    return np.asarray(
        np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)
    )


def encoded(light: Floats) -> Floats:
    """Return sRGB as screens take it of linear sRGB, both in [0, 1]."""
    values = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    return np.asarray(np.clip(values, 0.0, 1.0))


def word(colour: Rgb, *, clear: str = "colourless") -> str:
    """Return the plain word for a colour; borders are estimates of ours."""
    hue, lightness, _ = colorsys.rgb_to_hls(*colour)
    chroma = max(colour) - min(colour)
    degrees = hue * 360.0
    if chroma < 0.07:
        return clear if lightness > 0.85 else "grey" if lightness > 0.2 else "black"
    if lightness < 0.13:
        return "black"
    name = next(name for end, name in _HUES if degrees < end)
    if name == "red" and lightness > 0.72:
        name = "pink"
    if name in ("orange", "red") and lightness < 0.45:
        name = "brown"
    if name == "purple" and lightness > 0.7:
        name = "pink"
    return f"pale {name}" if chroma < 0.2 and name != "pink" else name


_HUES = (
    (12.0, "red"),
    (42.0, "orange"),
    (70.0, "yellow"),
    (165.0, "green"),
    (255.0, "blue"),
    (330.0, "purple"),
    (361.0, "red"),
)
"""Where each name ends on the circle of hues [degrees]; an estimate of ours."""
