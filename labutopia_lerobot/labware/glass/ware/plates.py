"""Flat and moulded ware: microplates, cuvettes, slides, boats, racks of wells."""

from functools import partial

from labutopia_lerobot.labware.glass.material import BOROSILICATE, POLYPROPYLENE, POLYSTYRENE
from labutopia_lerobot.labware.glass.series import UtensilSeries
from labutopia_lerobot.labware.glass.utensil import Shape
from labutopia_lerobot.labware.parts.fittings import tub
from labutopia_lerobot.labware.parts.form import Block, Form, Ring, Turned


def _microplate(
    name: str, long: float, wide: float, tall: float, well: float, *, rows: int, columns: int
) -> Shape:
    """Return a frame with a floor and round wells on a grid of 9 mm by 8 x 12, or a coarser one."""
    pitch = 0.108 / columns
    half = (long / 2, wide / 2)
    forms: list[Form] = list(
        tub((-half[0], half[0]), (-half[1], half[1]), (0.0, tall), 0.0015, "clear", edge=0.0)
    )
    for row in range(rows):
        for column in range(columns):
            at = (pitch * (column - (columns - 1) / 2), pitch * (row - (rows - 1) / 2))
            if rows * columns > 6:
                inside = ((well / 2, 0.0015), (well / 2, tall - 0.001))
                forms.append(Turned(inside, "clear", (*at, 0), edge=0.0, touch=False, segments=8))
            else:
                height = (0.0015, tall - 0.001)
                forms.append(Ring(well, well + 0.0016, height, "clear", at, segments=16))
    return Shape(tuple(forms), 0.5 * tall, wide)


def _cuvette(name: str, side: float, tall: float, wall: float, *, look: str) -> Shape:
    forms = tub((-side / 2, side / 2), (-side / 2, side / 2), (0.0, tall), wall, look, edge=0.0)
    return Shape(tuple(forms), 0.7 * tall, side)


def _sheet(name: str, long: float, wide: float, thick: float) -> Shape:
    half = (long / 2, wide / 2)
    sheet = Block((-half[0], half[0]), (-half[1], half[1]), (0.0, thick), "glass_edge", 0.0)
    return Shape((sheet,), 0.5 * thick, wide)


def _boat(name: str, long: float, wide: float, tall: float, wall: float) -> Shape:
    forms = tub((-long / 2, long / 2), (-wide / 2, wide / 2), (0.0, tall), wall, "white", edge=0.0)
    return Shape(tuple(forms), 0.7 * tall, wide)


_PLATE = "ANSI SLAS 1 and 2: 127.76 x 85.48 x 14.4 mm"
_OUTER = (127.76, 85.48, 14.4)

SERIES = (
    UtensilSeries(
        "microplate_6",
        "A microplate with 6 wells.",
        partial(_microplate, rows=2, columns=3),
        POLYSTYRENE,
        f"{_PLATE}; wells as usual; from memory",
        {"127.8 x 85.5 x 14.4 mm": (*_OUTER, 34.8)},  # long, wide, tall, well [mm]
    ),
    UtensilSeries(
        "microplate_24",
        "A microplate with 24 wells, which are seen but not touched.",
        partial(_microplate, rows=4, columns=6),
        POLYSTYRENE,
        f"{_PLATE}; wells as usual; from memory",
        {"127.8 x 85.5 x 14.4 mm": (*_OUTER, 15.6)},
    ),
    UtensilSeries(
        "microplate_96",
        "A microplate with 96 wells, which are seen but not touched.",
        partial(_microplate, rows=8, columns=12),
        POLYSTYRENE,
        f"{_PLATE}, wells 9 mm apart; from memory",
        {"127.8 x 85.5 x 14.4 mm": (*_OUTER, 6.8)},
    ),
    UtensilSeries(
        "cuvette_glass",
        "A cuvette of 10 mm path.",
        partial(_cuvette, look="glass"),
        BOROSILICATE,
        "12.5 x 12.5 x 45 mm as usual; from memory",
        {"12.5 x 12.5 x 45 mm": (12.5, 45, 1.25)},  # side, height, wall
        stands=True,
    ),
    UtensilSeries(
        "cuvette_plastic",
        "A disposable cuvette of 10 mm path.",
        partial(_cuvette, look="clear"),
        POLYSTYRENE,
        "12.5 x 12.5 x 45 mm as usual; from memory",
        {"12.5 x 12.5 x 45 mm": (12.5, 45, 1.25)},
    ),
    UtensilSeries(
        "microscope_slide",
        "A microscope slide.",
        _sheet,
        BOROSILICATE,
        "ISO 8037-1: 76 x 26 x 1 mm; soda-lime is 12 % heavier; from memory",
        {"76 x 26 x 1 mm": (76, 26, 1.0)},  # long, wide, thick
    ),
    UtensilSeries(
        "watch_plate",
        "A square plate of glass, to cover or to weigh on.",
        _sheet,
        BOROSILICATE,
        "as usual; from memory",
        {"100 x 100 x 2 mm": (100, 100, 2.0)},
    ),
    UtensilSeries(
        "weighing_boat",
        "A square weighing boat.",
        _boat,
        POLYSTYRENE,
        "85 x 85 x 24 mm as usual, upright for slanting walls; from memory",
        {
            # long, wide, tall, wall
            "41 x 41 x 8 mm": (41, 41, 8, 0.5),
            "85 x 85 x 24 mm": (85, 85, 24, 0.6),
            "140 x 140 x 22 mm": (140, 140, 22, 0.7),
        },
    ),
    UtensilSeries(
        "tray",
        "A tray of polypropylene.",
        _boat,
        POLYPROPYLENE,
        "as usual; from memory",
        {"240 x 180 x 50 mm": (240, 180, 50, 2.5)},
    ),
)
