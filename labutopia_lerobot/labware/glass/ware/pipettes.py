"""Pipettes, burettes and other long tubes; pipettes are open below."""

from labutopia_lerobot.labware.glass.joined import barrel, stopcock
from labutopia_lerobot.labware.glass.material import BOROSILICATE, POLYETHYLENE, SODA_LIME
from labutopia_lerobot.labware.glass.outlines import burette, pipette, pulled
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "burette",
        "A burette with a stopcock.",
        burette,
        BOROSILICATE,
        "ISO 385, bores such that the scale is as long as there; from memory",
        {
            # diameter of the tube, height, stem, height of the stopcock, wall, bottom [mm]
            "10 ml": (9, 480, 6.5, 55, 1.2, 62),
            "25 ml": (12, 580, 7, 60, 1.2, 67),
            "50 ml": (13.5, 750, 7, 60, 1.2, 67),
        },
        grip=0.7,
        stands=False,
        graduated=True,
        joined=barrel(50),
        fitted=stopcock(50, 2.0, 12.5, (0.42, 50.0), column=True),
    ),
    Series(
        "volumetric_pipette",
        "A one-mark pipette with a bulb.",
        pipette,
        SODA_LIME,
        "ISO 648, length; bulbs such that they hold the volume; from memory",
        {
            # diameter of the bulb, height, stem, length of the bulb, wall, bottom
            "5 x 410 mm": (5, 410, 4.5, 60, 0.9, 0),
            "13 x 450 mm": (13, 450, 6.5, 85, 1.1, 0),
            "20 x 520 mm": (20, 520, 7, 105, 1.2, 0),
        },
        grip=0.75,
        stands=False,
    ),
    Series(
        "graduated_pipette",
        "A graduated pipette.",
        pulled,
        SODA_LIME,
        "ISO 835, length 360 mm; from memory",
        {
            # diameter, height, tip, length of the tip, wall, bottom
            "4 x 360 mm": (4, 360, 2.6, 20, 1.0, 0),
            "8 x 360 mm": (8, 360, 3.0, 25, 1.1, 0),
            "10 x 360 mm": (10, 360, 3.2, 30, 1.1, 0),
        },
        grip=0.75,
        stands=False,
        graduated=True,
    ),
    Series(
        "pasteur_pipette",
        "A Pasteur pipette with a drawn tip.",
        pulled,
        SODA_LIME,
        "ISO 7712, 150 and 230 mm; from memory",
        {
            "7 x 150 mm": (7, 150, 1.8, 50, 0.5, 0),
            "7 x 230 mm": (7, 230, 1.8, 120, 0.5, 0),
        },
        grip=0.8,
        stands=False,
    ),
    Series(
        "transfer_pipette",
        "A transfer pipette of polyethylene, without its bulb.",
        pulled,
        POLYETHYLENE,
        "3 ml of 150 mm as usual; from memory",
        {"8 x 150 mm": (8, 150, 2.6, 60, 0.5, 0)},
        grip=0.8,
        stands=False,
    ),
    Series(
        "glass_tube",
        "A piece of glass tubing.",
        pulled,
        BOROSILICATE,
        "ISO 4803, 8 x 1 mm; from memory",
        {"8 x 200 mm": (8, 200, 7.8, 1, 1.0, 0)},
        stands=False,
    ),
)
