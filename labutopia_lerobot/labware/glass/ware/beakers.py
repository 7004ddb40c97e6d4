"""Beakers, jugs and buckets: what one pours from."""

from labutopia_lerobot.labware.glass.joined import handle, jacket, spout, together
from labutopia_lerobot.labware.glass.material import (
    BOROSILICATE,
    POLYETHYLENE,
    POLYPROPYLENE,
    QUARTZ,
)
from labutopia_lerobot.labware.glass.outlines import beaker, conical_beaker, straight, tapered
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "beaker_low",
        "A low-form beaker.",
        beaker,
        BOROSILICATE,
        "ISO 3819 low form, sizes as DURAN's; walls ours; from memory",
        {
            # nominal volume: diameter, height, wall, bottom [mm]
            "5 ml": (22, 30, 1.0, 1.4),
            "10 ml": (26, 35, 1.0, 1.4),
            "25 ml": (34, 50, 1.2, 1.6),
            "50 ml": (42, 60, 1.3, 1.8),
            "100 ml": (50, 70, 1.4, 2.0),
            "150 ml": (60, 80, 1.4, 2.2),
            "250 ml": (70, 95, 1.5, 2.4),
            "400 ml": (80, 110, 1.6, 2.6),
            "600 ml": (90, 125, 1.8, 2.8),
            "800 ml": (100, 135, 1.9, 2.9),
            "1000 ml": (105, 145, 2.0, 3.0),
            "2000 ml": (132, 185, 2.3, 3.4),
            "3000 ml": (152, 210, 2.5, 3.6),
            "5000 ml": (170, 270, 2.8, 4.0),
        },
        graduated=True,
        joined=spout(),
    ),
    Series(
        "beaker_tall",
        "A tall-form (Berzelius) beaker.",
        beaker,
        BOROSILICATE,
        "ISO 3819 tall form, sizes as DURAN's; walls ours; from memory",
        {
            "50 ml": (38, 70, 1.3, 1.8),
            "100 ml": (48, 80, 1.4, 2.0),
            "150 ml": (54, 95, 1.4, 2.2),
            "250 ml": (60, 120, 1.5, 2.4),
            "400 ml": (70, 130, 1.6, 2.6),
            "600 ml": (80, 150, 1.8, 2.8),
            "800 ml": (90, 175, 1.9, 2.9),
            "1000 ml": (95, 180, 2.0, 3.0),
            "2000 ml": (120, 240, 2.3, 3.4),
        },
        graduated=True,
        joined=spout(),
    ),
    Series(
        "beaker_conical",
        "A conical (Philips) beaker.",
        conical_beaker,
        BOROSILICATE,
        "250 ml of 85 x 120 mm as usual, the others alike; from memory",
        {
            # diameter, height, mouth, wall, bottom
            "100 ml": (65, 90, 38, 1.4, 2.0),
            "250 ml": (85, 120, 50, 1.5, 2.4),
            "500 ml": (105, 155, 62, 1.8, 2.8),
        },
        grip=0.85,
        graduated=True,
    ),
    Series(
        "beaker_quartz",
        "A low-form beaker of quartz.",
        beaker,
        QUARTZ,
        "as ISO 3819 low form; from memory",
        {
            "50 ml": (42, 60, 1.5, 2.0),
            "100 ml": (50, 70, 1.5, 2.0),
            "250 ml": (70, 95, 1.8, 2.4),
        },
        joined=spout(),
    ),
    Series(
        "beaker_plastic",
        "A polypropylene beaker with a blue scale.",
        tapered,
        POLYPROPYLENE,
        "ISO 7056 beakers are alike; from memory",
        {
            # diameter at the mouth, height, diameter of the base, wall, bottom
            "50 ml": (46, 60, 40, 1.2, 1.5),
            "100 ml": (56, 72, 48, 1.2, 1.5),
            "250 ml": (76, 95, 66, 1.5, 1.8),
            "500 ml": (94, 118, 82, 1.7, 2.0),
            "1000 ml": (118, 147, 102, 2.0, 2.4),
            "2000 ml": (148, 187, 128, 2.3, 2.8),
        },
        graduated=True,
        joined=spout("natural"),
    ),
    Series(
        "medicine_cup",
        "A polypropylene cup to measure out.",
        tapered,
        POLYPROPYLENE,
        "38 x 40 mm, as usual, on a narrower base; from memory",
        {"30 ml": (40, 42, 34, 0.8, 1.0)},
        graduated=True,
    ),
    Series(
        "bucket",
        "A polyethylene bucket, without its bail.",
        tapered,
        POLYETHYLENE,
        "as usual in households; from memory",
        {
            "5 l": (225, 200, 175, 2.0, 2.5),
            "10 l": (280, 265, 215, 2.2, 2.8),
        },
        grip=0.9,
    ),
    Series(
        "beaker_jacketed",
        "A jacketed beaker with two hose's olives.",
        straight,
        BOROSILICATE,
        "250 ml of 100 x 110 mm as usual; from memory",
        {"100 ml": (54, 85, 1.6, 12), "250 ml": (74, 110, 1.8, 14)},
        grip=0.5,
        joined=lambda profile: jacket(0.02, 0.92, 2e3 * profile.outer[-1][0] + 18)(profile),
    ),
    Series(
        "jug_plastic",
        "A jug of polypropylene with a spout and a handle.",
        tapered,
        POLYPROPYLENE,
        "1 l of 115 x 180 mm as usual; from memory",
        {
            # diameter at the mouth, height, diameter of the base, wall, bottom
            "500 ml": (96, 135, 82, 1.8, 2.2),
            "1000 ml": (118, 165, 100, 2.0, 2.4),
        },
        graduated=True,
        joined=together(spout("natural"), handle(0.30, 0.85, 30, 10, "natural")),
    ),
)
