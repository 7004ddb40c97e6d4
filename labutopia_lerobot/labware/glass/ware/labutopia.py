"""The glass of the original LabUtopia, which the tasks of the paper use.

Outer dimensions are those of the original's assets, where on record. The nominal volume of what
measures roughly is the largest of the series of ISO 3819 (beakers), ISO 1773 (conical flasks) or
ISO 4788 (graduated cylinders) that fills at most 90 % of the brimful capacity.
"""

from labutopia_lerobot.labware.glass.material import BOROSILICATE
from labutopia_lerobot.labware.glass.outlines import Outline
from labutopia_lerobot.labware.glass.series import Series

_WALL = 1.8  # Duran tubing of 30 mm diameter has walls of 1.4, 2.0 or 2.8 mm (Schott catalogue)
_BOTTOM = 3.0  # bottoms are thicker than walls: there the glass gathers in the mould
_HEEL = 1.5  # the bottom's edge is rounded off: how far the rim it stands on lies inside [mm]


def _foot(diameter: float) -> Outline:
    return (diameter / 2 - _HEEL, 0.0), (diameter / 2, _BOTTOM)


def _beaker(diameter: float, height: float, base: float, lip: float) -> Outline:
    below_lip = (diameter / 2, height - (lip - diameter) / 2)
    return *_foot(base), below_lip, (lip / 2, height)


def _conical(diameter: float, height: float, neck: float) -> Outline:
    return *_foot(diameter), (neck / 2, 0.70 * height), (neck / 2, height)


def _cylinder(diameter: float, height: float, tube: float, lip: float, foot: float) -> Outline:
    below_lip = (tube / 2, height - (lip - tube) / 2)
    return *_foot(diameter), (tube / 2, foot), below_lip, (lip / 2, height)


def _pear_shaped(
    diameter: float, height: float, base: float, neck: float, shoulder: float
) -> Outline:
    pear = ((diameter / 2, 22.0), (diameter / 2, 46.0), (neck / 2, shoulder))
    return *_foot(base), *pear, (neck / 2, height)


SERIES = (
    Series(
        "beaker",
        "A low-form beaker of the original.",
        _beaker,
        BOROSILICATE,
        "the original's beaker_2 of lab_003, whose lip is not on record, beaker2 and beaker1",
        {
            # diameter below the lip, height, diameters of base and lip, wall, bottom
            "150 ml": (60.0, 90.0, 60.0, 66.0, _WALL, _BOTTOM),
            "250 ml": (72.0, 90.0, 68.0, 86.0, _WALL, _BOTTOM),
            "800 ml": (100.0, 127.0, 98.0, 122.0, _WALL, _BOTTOM),
        },
        graduated=True,
        numbered=False,
    ),
    Series(
        "conical_flask",
        "A wide-necked conical flask of the original, to be gripped by its neck.",
        _conical,
        BOROSILICATE,
        "the original's conical_bottle02, 03 and 04",
        {
            # diameter, height, diameter of the neck, wall, bottom
            "300 ml": (92.6, 164.5, 45.0, _WALL, _BOTTOM),
            "500 ml": (113.0, 197.0, 54.0, _WALL, _BOTTOM),
            "1000 ml": (141.0, 234.0, 66.0, _WALL, _BOTTOM),
        },
        grip=0.85,
        graduated=True,
        numbered=False,
    ),
    Series(
        "measuring_cylinder",
        "A graduated cylinder of the original on a broad glass foot.",
        _cylinder,
        BOROSILICATE,
        "the original's graduated_cylinder_03: foot of 117 mm, 272 mm high, tube from 38 to 56 mm "
        "wide, of which ours has the mean below a lip of the greatest width",
        {
            # diameter, height, diameters of tube and lip, height of the foot, wall, bottom
            "250 ml": (117.0, 272.0, 47.0, 56.0, 12.0, _WALL, 12.0),
        },
        graduated=True,
        numbered=False,
    ),
    Series(
        "pear_shaped_flask",
        "A pear-shaped volumetric flask, to be gripped by its neck.",
        _pear_shaped,
        BOROSILICATE,
        "ours, the original's is not on record: it holds its volume up to a mark in the neck, as "
        "ISO 1042 demands, 38 mm above the shoulder",
        {
            # diameter, height, diameters of base and neck, height of the shoulder, wall, bottom
            "250 ml": (75.0, 220.0, 54.0, 19.0, 100.0, _WALL, _BOTTOM),
        },
        grip=160 / 220,
        one_mark=True,
    ),
)
