"""Tubes: none stands by itself, and all go into racks and rotors."""

from labutopia_lerobot.labware.glass.material import BOROSILICATE, POLYPROPYLENE, SODA_LIME
from labutopia_lerobot.labware.glass.outlines import pointed, tube
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "test_tube",
        "A test tube with a round bottom.",
        tube,
        BOROSILICATE,
        "ISO 4142, diameter and height; from memory",
        {
            # of each: diameter, height; wall, bottom [mm]
            "10 x 75 mm": (10, 75, 0.8, 1.0),
            "12 x 75 mm": (12, 75, 1.0, 1.0),
            "12 x 100 mm": (12, 100, 1.0, 1.0),
            "16 x 130 mm": (16, 130, 1.0, 1.2),
            "16 x 160 mm": (16, 160, 1.0, 1.2),
            "18 x 180 mm": (18, 180, 1.2, 1.2),
            "20 x 150 mm": (20, 150, 1.2, 1.4),
            "25 x 150 mm": (25, 150, 1.2, 1.4),
            "25 x 200 mm": (25, 200, 1.2, 1.4),
            "30 x 200 mm": (30, 200, 1.4, 1.6),
        },
        grip=0.8,
        stands=False,
        closure="rubber_bung",
    ),
    Series(
        "culture_tube",
        "A disposable culture tube of soda-lime glass.",
        tube,
        SODA_LIME,
        "usual disposable sizes; from memory",
        {
            "12 x 75 mm": (12, 75, 0.7, 0.9),
            "13 x 100 mm": (13, 100, 0.7, 0.9),
            "16 x 150 mm": (16, 150, 0.8, 1.0),
        },
        grip=0.8,
        stands=False,
    ),
    Series(
        "centrifuge_tube",
        "A conical centrifuge tube of polypropylene, without its cap.",
        pointed,
        POLYPROPYLENE,
        "17 x 120 and 30 x 115 mm (Falcon form); from memory",
        {
            # diameter, height, height of the cone, wall, bottom
            "15 ml": (17, 120, 22, 0.9, 1.5),
            "50 ml": (30, 115, 15, 1.1, 2.0),
        },
        grip=0.8,
        stands=False,
        graduated=True,
    ),
    Series(
        "centrifuge_tube_glass",
        "A conical centrifuge tube of glass.",
        pointed,
        BOROSILICATE,
        "16 x 105 mm (DIN 58970 tubes are alike); from memory",
        {"12 ml": (17, 105, 30, 1.1, 1.5)},
        grip=0.8,
        stands=False,
        graduated=True,
    ),
    Series(
        "microtube",
        "A microtube of polypropylene, without its lid.",
        pointed,
        POLYPROPYLENE,
        "Eppendorf form: 8 x 30, 11 x 39 and 11 x 41 mm; from memory",
        {
            "0.2 ml": (6.2, 21, 12, 0.3, 0.5),
            "0.5 ml": (8, 30, 14, 0.7, 0.8),
            "1.5 ml": (11, 39, 17, 0.9, 1.0),
            "2 ml": (11, 41, 6, 0.9, 1.0),
        },
        grip=0.7,
        stands=False,
    ),
)
