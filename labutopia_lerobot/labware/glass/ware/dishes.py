"""Dishes, crucibles, mortars: what is wide and low, or thick."""

from labutopia_lerobot.labware.glass.material import (
    BOROSILICATE,
    POLYSTYRENE,
    PORCELAIN,
    QUARTZ,
    SODA_LIME,
)
from labutopia_lerobot.labware.glass.outlines import bowl, cap, straight
from labutopia_lerobot.labware.glass.series import Series

SERIES = (
    Series(
        "crystallizing_dish",
        "A crystallizing dish without a spout.",
        straight,
        BOROSILICATE,
        "DIN 12338, sizes as DURAN's; walls ours; from memory",
        {
            # nominal volume: diameter, height, wall, bottom [mm]
            "20 ml": (40, 25, 1.4, 1.8),
            "60 ml": (60, 35, 1.5, 2.0),
            "150 ml": (80, 45, 1.6, 2.2),
            "300 ml": (95, 55, 1.8, 2.5),
            "500 ml": (115, 65, 2.0, 2.8),
            "900 ml": (140, 75, 2.2, 3.0),
            "2000 ml": (190, 90, 2.5, 3.5),
        },
        grip=0.5,
    ),
    Series(
        "evaporating_dish",
        "An evaporating dish of porcelain.",
        bowl,
        PORCELAIN,
        "DIN 12903 medium form, diameter and height, without the spout; from memory",
        {
            # diameter, height, foot, wall, bottom
            "63 x 25 mm": (63, 25, 28, 2.2, 2.5),
            "80 x 32 mm": (80, 32, 36, 2.4, 2.8),
            "100 x 40 mm": (100, 40, 44, 2.6, 3.0),
            "125 x 50 mm": (125, 50, 54, 2.8, 3.2),
        },
        grip=0.8,
    ),
    Series(
        "crucible",
        "A crucible of porcelain.",
        bowl,
        PORCELAIN,
        "DIN 12904 medium form, diameter and height; from memory",
        {
            "35 x 28 mm": (35, 28, 18, 1.6, 2.0),
            "40 x 32 mm": (40, 32, 20, 1.8, 2.2),
            "45 x 36 mm": (45, 36, 22, 1.9, 2.4),
            "50 x 40 mm": (50, 40, 25, 2.0, 2.5),
        },
        grip=0.8,
        closure="crucible_lid",
    ),
    Series(
        "crucible_quartz",
        "A crucible of quartz.",
        bowl,
        QUARTZ,
        "as DIN 12904 medium form; from memory",
        {
            "40 x 32 mm": (40, 32, 20, 1.6, 2.0),
            "50 x 40 mm": (50, 40, 25, 1.8, 2.2),
        },
        grip=0.8,
        closure="crucible_lid",
    ),
    Series(
        "watch_glass",
        "A watch glass.",
        cap,
        SODA_LIME,
        "DIN 12341, diameter; depth an eighth of it; edge 1.5 mm thick, middle 2 mm; from memory",
        {
            # diameter, height, wall, bottom
            "60 x 8 mm": (60, 8, 3.5, 2.0),
            "80 x 10 mm": (80, 10, 3.8, 2.0),
            "100 x 12 mm": (100, 12, 4.0, 2.0),
            "125 x 15 mm": (125, 15, 4.2, 2.0),
            "150 x 18 mm": (150, 18, 4.5, 2.2),
        },
        grip=0.9,
    ),
    Series(
        "petri_dish",
        "A Petri dish of soda-lime glass.",
        straight,
        SODA_LIME,
        "ISO 24998 dishes are alike; diameter and height; from memory",
        {
            "60 x 15 mm": (60, 15, 1.5, 1.6),
            "80 x 15 mm": (80, 15, 1.6, 1.8),
            "100 x 15 mm": (100, 15, 1.7, 2.0),
            "100 x 20 mm": (100, 20, 1.7, 2.0),
            "120 x 20 mm": (120, 20, 1.8, 2.2),
            "150 x 25 mm": (150, 25, 2.0, 2.4),
        },
        closure="petri_lid",
    ),
    Series(
        "petri_dish_plastic",
        "A disposable Petri dish of polystyrene.",
        straight,
        POLYSTYRENE,
        "ISO 24998, diameter and height; from memory",
        {
            "35 x 10 mm": (35, 10, 0.8, 0.9),
            "60 x 15 mm": (60, 15, 0.9, 1.0),
            "90 x 15 mm": (90, 15, 0.9, 1.0),
            "150 x 20 mm": (150, 20, 1.2, 1.3),
        },
        closure="petri_lid_plastic",
    ),
    Series(
        "mortar",
        "A mortar of porcelain, without its pestle.",
        bowl,
        PORCELAIN,
        "DIN 12906 mortars are alike, without the spout; diameter and height; from memory",
        {
            # diameter, height, foot, wall, bottom
            "80 x 45 mm": (80, 45, 48, 6.0, 8.0),
            "100 x 60 mm": (100, 60, 58, 7.0, 9.0),
            "125 x 75 mm": (125, 75, 70, 8.0, 10.0),
        },
        grip=0.85,
    ),
    Series(
        "desiccator_bowl",
        "The lower half of a desiccator, without its plate.",
        bowl,
        BOROSILICATE,
        "DN 150 to DN 250 (DIN 12491 desiccators are alike); from memory",
        {
            "190 x 110 mm": (190, 110, 90, 5.0, 6.0),
            "250 x 150 mm": (250, 150, 115, 6.0, 7.0),
        },
        grip=0.9,
        closure="desiccator_lid",
    ),
    Series(
        "weighing_scoop",
        "A round weighing scoop of polystyrene.",
        bowl,
        POLYSTYRENE,
        "as usual; from memory",
        {"60 x 14 mm": (60, 14, 40, 2.5, 0.9)},
        grip=0.8,
    ),
    Series(
        "staining_jar",
        "A round staining jar (Coplin), without its slots.",
        straight,
        SODA_LIME,
        "as usual; from memory",
        {"58 x 100 mm": (58, 100, 3.0, 4.0)},
    ),
)
