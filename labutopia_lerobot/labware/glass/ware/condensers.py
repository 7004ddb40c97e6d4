"""Condensers and columns: tubes that are open at both ends, some in a jacket; extractors."""

from labutopia_lerobot.labware.glass.joined import arm, bulbs, jacket, together
from labutopia_lerobot.labware.glass.material import BOROSILICATE
from labutopia_lerobot.labware.glass.outlines import dented, socket_tube
from labutopia_lerobot.labware.glass.series import Series

_ROWS = {
    # diameter of the tube, height, diameter of the socket, its length, wall, bottom [mm]
    "16 x 260 mm": (16, 260, 22, 26, 1.5, 0),
    "16 x 400 mm": (16, 400, 22, 26, 1.5, 0),
}
_MADE = "DIN 12576 condensers, jackets of 160 and 300 mm; from memory"

SERIES = (
    Series(
        "condenser_liebig",
        "A Liebig condenser: a straight tube in a jacket.",
        socket_tube,
        BOROSILICATE,
        _MADE,
        _ROWS,
        stands=False,
        joined=jacket(0.18, 0.88, 30),
    ),
    Series(
        "condenser_allihn",
        "An Allihn condenser: its tube, here straight to the liquid, has bulbs.",
        socket_tube,
        BOROSILICATE,
        _MADE,
        _ROWS,
        stands=False,
        joined=together(jacket(0.18, 0.88, 38), bulbs(0.22, 0.84, 5, 30)),
    ),
    Series(
        "condenser_graham",
        "A Graham condenser: a coil, drawn around a straight tube, in a jacket.",
        socket_tube,
        BOROSILICATE,
        _MADE,
        _ROWS,
        stands=False,
        joined=together(jacket(0.18, 0.88, 40), bulbs(0.22, 0.84, 7, 32)),
    ),
    Series(
        "vigreux_column",
        "A Vigreux column, whose wall is dented.",
        dented,
        BOROSILICATE,
        "DIN 12580 columns are alike, dents all around; from memory",
        {
            # diameter, height, diameter of the dents, their number, wall, bottom
            "24 x 300 mm": (24, 300, 16, 4, 1.5, 0),
        },
        stands=False,
    ),
    Series(
        "soxhlet_extractor",
        "A Soxhlet extractor: a thimble chamber with a vapour tube and a siphon, which are sealed.",
        socket_tube,
        BOROSILICATE,
        "DIN 12602, 100 ml of 45 x 260 mm; from memory",
        {"45 x 260 mm": (45, 260, 50, 40, 1.8, 0)},
        grip=0.9,
        stands=False,
        joined=together(arm(0.70, 14, 12), arm(0.20, 14, 12), arm(0.35, 10, 6, azimuth=180)),
    ),
    Series(
        "drying_tube",
        "A straight drying tube.",
        socket_tube,
        BOROSILICATE,
        "as usual; from memory",
        {"16 x 150 mm": (16, 150, 22, 24, 1.2, 0)},
        stands=False,
    ),
)
