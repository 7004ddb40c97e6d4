"""Beakers, flasks and a graduated cylinder in the sizes of LabUtopia's glassware.

Outer dimensions are those of the original's assets, where on record. The nominal volume of what
measures roughly is the largest of the series of ISO 3819 (beakers), ISO 1773 (conical flasks) or
ISO 4788 (graduated cylinders) that fills at most 90 % of the brimful capacity.
"""

from collections.abc import Mapping

from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel

_FLASKS = {
    # nominal volume: base radius, neck radius, height [m]
    "300 ml": (0.0463, 0.0225, 0.1645),  # conical_bottle02
    "500 ml": (0.0565, 0.0270, 0.1970),  # conical_bottle03
    "1000 ml": (0.0705, 0.0330, 0.2340),  # conical_bottle04
}
_BEAKERS = {
    # nominal volume: base radius, radius below the lip, lip radius, height [m]
    "150 ml": (0.0300, 0.0300, 0.0330, 0.0900),  # lab_003's beaker_2, whose lip is not on record
    "250 ml": (0.0340, 0.0360, 0.0430, 0.0900),  # beaker2
    "800 ml": (0.0490, 0.0500, 0.0610, 0.1270),  # beaker1
}
_WALL = 0.0018  # Duran tubing of 30 mm diameter has walls of 1.4, 2.0 or 2.8 mm (Schott catalogue)
_BOTTOM = 0.003  # bottoms are thicker than walls: there the glass gathers in the mould
_HEEL = 0.0015  # the bottom's edge is rounded off: how far the rim it stands on lies inside [m]


def erlenmeyer_flask(name: str, size: str = "300 ml") -> Vessel:
    """Return a wide-necked conical flask, to be gripped by its neck.

    Args:
        name: Name of the body; prefix of all its elements.
        size: Nominal volume: "300 ml", "500 ml" or "1000 ml".

    Raises:
        ValueError: There is no flask of that size.
    """
    base, neck, height = _look_up(size, _FLASKS, "Erlenmeyer flask")
    shoulder = 0.70 * height
    outer = ((base - _HEEL, 0.0), (base, _BOTTOM), (neck, shoulder), (neck, height))
    return Vessel(name, Profile(outer, _WALL, _BOTTOM), (shoulder + height) / 2)


def beaker(name: str, size: str = "250 ml") -> Vessel:
    """Return a low-form beaker, to be gripped around its body.

    Args:
        name: Name of the body; prefix of all its elements.
        size: Nominal volume: "150 ml", "250 ml" or "800 ml".

    Raises:
        ValueError: There is no beaker of that size.
    """
    base, body, lip, height = _look_up(size, _BEAKERS, "beaker")
    outer = ((base - _HEEL, 0.0), (base, _BOTTOM), (body, height - (lip - body)), (lip, height))
    return Vessel(name, Profile(outer, _WALL, _BOTTOM), 0.5 * height)


def graduated_cylinder(name: str) -> Vessel:
    """Return a 250 ml graduated cylinder on a broad glass foot, to be gripped around its tube.

    The original's graduated_cylinder_03: foot of 117 mm, 272 mm high, tube from 38 to 56 mm wide,
    of which ours has the mean below a lip of the greatest width.

    Args:
        name: Name of the body; prefix of all its elements.
    """
    foot, foot_height, tube, lip, height = 0.0585, 0.012, 0.0235, 0.0280, 0.2720
    below_lip = (tube, height - (lip - tube))
    outer = ((foot - _HEEL, 0.0), (foot, _BOTTOM), (tube, foot_height), below_lip, (lip, height))
    return Vessel(name, Profile(outer, _WALL, bottom=foot_height), 0.5 * height)


def volumetric_flask(name: str) -> Vessel:
    """Return a pear-shaped 250 ml volumetric flask, to be gripped by its neck.

    The original's dimensions are not on record. Ours holds its volume up to a mark in the neck, as
    ISO 1042 demands, 38 mm above the shoulder.

    Args:
        name: Name of the body; prefix of all its elements.
    """
    base, body, neck, shoulder, height = 0.0270, 0.0375, 0.0095, 0.1000, 0.2200
    pear = ((body, 0.0220), (body, 0.0460), (neck, shoulder))
    outer = ((base - _HEEL, 0.0), (base, _BOTTOM), *pear, (neck, height))
    grip_height = (shoulder + height) / 2
    return Vessel(name, Profile(outer, _WALL, _BOTTOM), grip_height, one_mark=250e-6)


def _look_up[Size](size: str, sizes: Mapping[str, Size], kind: str) -> Size:
    if size not in sizes:
        raise ValueError(f"no {kind} of size {size!r}; choose one of: {', '.join(sizes)}")
    return sizes[size]
