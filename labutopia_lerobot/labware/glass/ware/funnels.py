"""Funnels: open below, but those with a stopcock.

Plugs of stopcocks are 14.5 mm wide with a hole of 2.5 mm, as usual (NS 14.5); from memory.
"""

from labutopia_lerobot.labware.glass.joined import arm, barrel, plate, stopcock, together
from labutopia_lerobot.labware.glass.material import BOROSILICATE, POLYPROPYLENE, PORCELAIN
from labutopia_lerobot.labware.glass.outlines import funnel, separating, thistle
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "funnel_conical",
        "A conical funnel of 60 degrees with a long stem.",
        funnel,
        BOROSILICATE,
        "ISO 4798, diameter and height; from memory",
        {
            # diameter, height, stem, length of the stem, wall, bottom [mm]
            "45 x 85 mm": (45, 85, 7, 45, 1.5, 0),
            "75 x 150 mm": (75, 150, 9, 84, 1.8, 0),
            "100 x 190 mm": (100, 190, 11, 102, 2.0, 0),
            "150 x 280 mm": (150, 280, 17, 148, 2.4, 0),
        },
        grip=0.3,
        stands=False,
    ),
    Series(
        "funnel_plastic",
        "A conical funnel of polypropylene.",
        funnel,
        POLYPROPYLENE,
        "as ISO 4798; from memory",
        {
            "60 x 95 mm": (60, 95, 9, 45, 1.6, 0),
            "100 x 150 mm": (100, 150, 13, 68, 2.0, 0),
        },
        grip=0.3,
        stands=False,
    ),
    Series(
        "funnel_powder",
        "A powder funnel with a wide, short stem.",
        funnel,
        BOROSILICATE,
        "DIN 12446 funnels are alike; from memory",
        {
            "80 x 80 mm": (80, 80, 23, 30, 1.8, 0),
            "100 x 100 mm": (100, 100, 28, 35, 2.0, 0),
        },
        grip=0.2,
        stands=False,
    ),
    Series(
        "funnel_buchner",
        "A Buchner funnel with a filter plate.",
        funnel,
        PORCELAIN,
        "DIN 12905, cone for cylinder; from memory",
        {
            "70 x 110 mm": (70, 110, 13, 55, 3.0, 0),
            "90 x 140 mm": (90, 140, 15, 65, 3.5, 0),
        },
        grip=0.25,
        stands=False,
        joined=plate(0.72, 3.0, "ceramic"),
    ),
    Series(
        "funnel_thistle",
        "A thistle funnel with a stem of 300 mm.",
        thistle,
        BOROSILICATE,
        "as usual; from memory",
        {"40 x 345 mm": (40, 345, 7, 1.2, 0)},
        grip=0.6,
        stands=False,
    ),
    Series(
        "filter_crucible",
        "A Gooch crucible with a filter plate.",
        funnel,
        PORCELAIN,
        "ISO 4793 grades; 40 x 45 mm as usual; from memory",
        {"40 x 45 mm": (40, 45, 24, 6, 2.0, 0)},
        grip=0.7,
        joined=plate(0.16, 2.5, "ceramic"),
    ),
    Series(
        "separating_funnel",
        "A pear-shaped separating funnel with a stopcock.",
        separating,
        BOROSILICATE,
        "ISO 4800, sizes as Squibb's; walls ours; from memory",
        {
            # diameter, height, neck, stem, length of the stem, wall, bottom
            "100 ml": (62, 240, 21, 10, 80, 1.6, 82),
            "250 ml": (82, 300, 32, 12, 90, 1.8, 92),
            "500 ml": (102, 350, 32, 13, 95, 2.0, 97),
        },
        grip=0.95,
        stands=False,
        joined=barrel(62),
        fitted=stopcock(62, 2.5, 14.5, (2.0, 62.0)),
        closure="ground_stopper",
    ),
    Series(
        "dropping_funnel",
        "A dropping funnel with a stopcock and a tube that equalises the pressure.",
        separating,
        BOROSILICATE,
        "DIN 12566; walls ours; from memory",
        {"100 ml": (50, 260, 21, 12, 90, 1.6, 92)},
        grip=0.95,
        stands=False,
        joined=together(barrel(62), arm(0.86, 22, 8), arm(0.30, 28, 8)),
        fitted=stopcock(62, 2.5, 14.5, (2.0, 62.0), vented=True),
        closure="ground_stopper",
    ),
)
