"""Graduated and mixing cylinders: what one measures in."""

from labutopia_lerobot.labware.glass.joined import spout
from labutopia_lerobot.labware.glass.material import BOROSILICATE, POLYPROPYLENE
from labutopia_lerobot.labware.glass.outlines import footed
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "graduated_cylinder",
        "A tall-form graduated cylinder on a round foot.",
        footed,
        BOROSILICATE,
        "ISO 4788 tall form, its foot round for hexagonal; from memory; walls by weighings",
        {
            # foot, height, tube, height of the foot, wall, bottom
            "5 ml": (34, 115, 12, 6, 1.1, 6),
            "10 ml": (38, 140, 14, 7, 1.2, 7),
            "25 ml": (48, 170, 20, 7, 1.3, 7),
            "50 ml": (56, 200, 25, 7.5, 1.3, 7.5),
            "100 ml": (66, 260, 30, 9, 1.4, 9),
            "250 ml": (85, 335, 41, 12, 1.8, 12),
            "500 ml": (105, 360, 53, 13, 2.0, 13),
            "1000 ml": (125, 465, 65, 14, 2.0, 14),
            "2000 ml": (150, 500, 84, 15, 2.5, 15),
        },
        graduated=True,
        joined=spout(),
    ),
    Series(
        "graduated_cylinder_plastic",
        "A tall-form graduated cylinder of polypropylene.",
        footed,
        POLYPROPYLENE,
        "ISO 6706 cylinders are alike; from memory",
        {
            "10 ml": (38, 140, 14, 7, 1.2, 7),
            "25 ml": (50, 195, 19, 8, 1.4, 8),
            "50 ml": (60, 200, 26, 9, 1.5, 9),
            "100 ml": (75, 250, 31, 10, 1.6, 10),
            "250 ml": (95, 315, 42, 12, 1.8, 12),
            "500 ml": (115, 360, 55, 13, 2.0, 13),
            "1000 ml": (140, 440, 67, 14, 2.2, 14),
        },
        graduated=True,
        joined=spout("natural"),
    ),
    Series(
        "mixing_cylinder",
        "A mixing cylinder with a ground stopper.",
        footed,
        BOROSILICATE,
        "ISO 4788; stoppers as usual; from memory",
        {
            "25 ml": (48, 170, 20.5, 8, 1.4, 8),
            "100 ml": (66, 250, 30, 10, 1.5, 10),
        },
        graduated=True,
        closure="ground_stopper",
    ),
)
