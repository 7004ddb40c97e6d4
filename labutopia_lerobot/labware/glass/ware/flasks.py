"""Flasks: conical, round, flat-bottomed, volumetric."""

from labutopia_lerobot.labware.glass.material import BOROSILICATE, POLYPROPYLENE
from labutopia_lerobot.labware.glass.outlines import conical, globe, pear, round_globe
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "erlenmeyer_narrow",
        "A narrow-necked Erlenmeyer flask.",
        conical,
        BOROSILICATE,
        "ISO 1773 narrow neck, sizes as DURAN's; walls ours; from memory",
        {
            # nominal volume: diameter, height, neck, wall, bottom [mm]
            "25 ml": (42, 75, 22, 1.0, 1.5),
            "50 ml": (51, 90, 22, 1.0, 1.6),
            "100 ml": (64, 105, 22, 1.2, 1.8),
            "200 ml": (79, 131, 34, 1.4, 2.0),
            "250 ml": (85, 145, 34, 1.5, 2.2),
            "300 ml": (87, 156, 34, 1.5, 2.2),
            "500 ml": (105, 180, 34, 1.6, 2.5),
            "1000 ml": (131, 220, 42, 1.8, 2.8),
            "2000 ml": (166, 280, 50, 2.2, 3.2),
        },
        grip=0.85,
        graduated=True,
        closure="rubber_bung",
    ),
    Series(
        "erlenmeyer_wide",
        "A wide-necked Erlenmeyer flask.",
        conical,
        BOROSILICATE,
        "ISO 24450 (wide neck), sizes as DURAN's; walls ours; from memory",
        {
            "50 ml": (51, 85, 34, 1.2, 1.6),
            "100 ml": (64, 105, 34, 1.3, 1.8),
            "250 ml": (85, 140, 50, 1.5, 2.2),
            "500 ml": (105, 175, 50, 1.6, 2.5),
            "1000 ml": (131, 220, 50, 1.8, 2.8),
        },
        grip=0.85,
        graduated=True,
    ),
    Series(
        "erlenmeyer_plastic",
        "An Erlenmeyer flask of polypropylene.",
        conical,
        POLYPROPYLENE,
        "as ISO 1773, its walls as moulded ones; from memory",
        {
            "50 ml": (53, 92, 28, 1.3, 1.6),
            "125 ml": (69, 115, 34, 1.4, 1.8),
            "250 ml": (85, 145, 38, 1.5, 2.0),
            "500 ml": (105, 182, 40, 1.7, 2.2),
        },
        grip=0.85,
        graduated=True,
        closure="rubber_bung",
    ),
    Series(
        "round_bottom_flask",
        "A round-bottomed flask: it lies in a ring or a mantle.",
        round_globe,
        BOROSILICATE,
        "ISO 1773, sizes as DURAN's; walls ours, thinner at the bottom; from memory",
        {
            "50 ml": (51, 95, 26, 1.2, 1.2),
            "100 ml": (64, 110, 26, 1.3, 1.3),
            "250 ml": (85, 144, 34, 1.5, 1.5),
            "500 ml": (105, 175, 34, 1.6, 1.6),
            "1000 ml": (131, 210, 42, 1.8, 1.8),
            "2000 ml": (166, 260, 50, 2.2, 2.2),
        },
        grip=0.9,
        stands=False,
        closure="rubber_bung",
    ),
    Series(
        "flat_bottom_flask",
        "A flat-bottomed boiling flask.",
        globe,
        BOROSILICATE,
        "ISO 1773, sizes as DURAN's; walls ours; from memory",
        {
            # diameter, height, neck, flat of the bottom, wall, bottom
            "50 ml": (51, 95, 22, 30, 1.2, 1.6),
            "100 ml": (64, 110, 22, 36, 1.3, 1.8),
            "250 ml": (85, 144, 34, 48, 1.5, 2.0),
            "500 ml": (105, 175, 34, 58, 1.6, 2.2),
            "1000 ml": (131, 210, 42, 72, 1.8, 2.5),
            "2000 ml": (166, 260, 50, 90, 2.2, 3.0),
        },
        grip=0.9,
        closure="rubber_bung",
    ),
    Series(
        "volumetric_flask",
        "A volumetric flask with a ring on its neck.",
        pear,
        BOROSILICATE,
        "ISO 1042, diameter and height; neck and shoulder such that the ring is on it; from memory",
        {
            # diameter, height, neck, shoulder, wall, bottom
            "10 ml": (27, 90, 9, 34, 1.2, 1.6),
            "25 ml": (40, 110, 12, 38, 1.3, 1.8),
            "50 ml": (50, 140, 14, 47, 1.3, 1.8),
            "100 ml": (60, 170, 16, 65, 1.4, 2.0),
            "250 ml": (80, 220, 17, 90, 1.5, 2.2),
            "500 ml": (100, 260, 21, 113, 1.7, 2.4),
            "1000 ml": (125, 300, 26, 143, 1.9, 2.8),
        },
        grip=0.8,
        one_mark=True,
        closure="ground_stopper",
    ),
)
