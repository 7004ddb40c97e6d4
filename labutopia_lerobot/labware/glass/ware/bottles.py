"""Bottles, jars and vials."""

from labutopia_lerobot.labware.glass.material import AMBER_GLASS, BOROSILICATE, POLYETHYLENE
from labutopia_lerobot.labware.glass.outlines import bottle, straight
from labutopia_lerobot.labware.glass.series import Series
from labutopia_lerobot.labware.glass.thread import GL32, GL45

SERIES = (
    Series(
        "reagent_bottle",
        "A laboratory bottle with a GL 45 neck.",
        bottle,
        BOROSILICATE,
        "ISO 4796-1, sizes as DURAN's without cap; walls ours; from memory",
        {
            # nominal volume: diameter, height, neck, wall, bottom [mm]
            "100 ml": (56, 100, 41, 2.0, 2.8),
            "250 ml": (70, 138, 41, 2.2, 3.0),
            "500 ml": (86, 176, 41, 2.4, 3.2),
            "1000 ml": (101, 225, 41, 2.6, 3.5),
            "2000 ml": (136, 260, 41, 3.0, 4.0),
            "5000 ml": (182, 330, 41, 3.5, 5.0),
        },
        grip=0.9,
        graduated=True,
        thread=GL45,
        closure="screw_cap_gl45",
    ),
    Series(
        "reagent_bottle_amber",
        "A laboratory bottle of amber glass with a GL 45 neck.",
        bottle,
        AMBER_GLASS,
        "ISO 4796-1, sizes as DURAN's without cap; walls ours; from memory",
        {
            "100 ml": (56, 100, 41, 2.0, 2.8),
            "250 ml": (70, 138, 41, 2.2, 3.0),
            "500 ml": (86, 176, 41, 2.4, 3.2),
            "1000 ml": (101, 225, 41, 2.6, 3.5),
        },
        grip=0.9,
        graduated=True,
        thread=GL45,
        closure="screw_cap_gl45",
    ),
    Series(
        "reagent_bottle_small",
        "A laboratory bottle with a GL 32 neck.",
        bottle,
        BOROSILICATE,
        "ISO 4796-1, sizes as DURAN's without cap; walls ours; from memory",
        {
            "25 ml": (36, 74, 28.4, 1.6, 2.2),
            "50 ml": (46, 87, 28.4, 1.8, 2.5),
        },
        grip=0.3,
        graduated=True,
        thread=GL32,
        closure="screw_cap_gl32",
    ),
    Series(
        "sample_jar",
        "A wide-necked jar of polyethylene.",
        bottle,
        POLYETHYLENE,
        "as usual for wide-mouth bottles; from memory",
        {
            "60 ml": (45, 70, 34, 1.2, 1.5),
            "250 ml": (68, 110, 50, 1.4, 1.8),
            "500 ml": (84, 135, 62, 1.5, 2.0),
            "1000 ml": (105, 165, 70, 1.7, 2.2),
        },
        grip=0.9,
    ),
    Series(
        "vial",
        "A sample vial with a neck for a screw cap.",
        bottle,
        BOROSILICATE,
        "12 x 32, 15 x 45, 17 x 60, 28 x 61 and 28 x 95 mm, as usual; from memory",
        {
            "1.5 ml": (12, 32, 8, 1.0, 1.0),
            "4 ml": (15, 45, 11, 1.0, 1.2),
            "8 ml": (17, 60, 13, 1.0, 1.2),
            "20 ml": (28, 61, 22, 1.1, 1.5),
            "40 ml": (28, 95, 22, 1.1, 1.5),
        },
        grip=0.3,
    ),
    Series(
        "weighing_bottle",
        "A weighing bottle.",
        straight,
        BOROSILICATE,
        "DIN 12605, diameter and height; from memory",
        {
            # diameter, height, wall, bottom
            "25 x 40 mm": (25, 40, 1.2, 1.5),
            "30 x 50 mm": (30, 50, 1.3, 1.6),
            "40 x 80 mm": (40, 80, 1.4, 1.8),
            "50 x 30 mm": (50, 30, 1.4, 1.8),
            "80 x 30 mm": (80, 30, 1.6, 2.0),
        },
        closure="weighing_bottle_lid",
    ),
)
