"""Tools used with ware: bars, pestles, spatulas, thermometers, syringes, droppers."""

from functools import partial

from labutopia_lerobot.labware.glass.material import (
    BOROSILICATE,
    POLYPROPYLENE,
    PORCELAIN,
    PTFE,
    SODA_LIME,
    SOFT_RUBBER,
    STAINLESS_STEEL,
)
from labutopia_lerobot.labware.glass.series import UtensilSeries
from labutopia_lerobot.labware.glass.stirring_bar import StirringBarSeries
from labutopia_lerobot.labware.glass.syringe import SyringeSeries, syringe
from labutopia_lerobot.labware.glass.utensil import Shape
from labutopia_lerobot.labware.parts.form import Block, Form, Rod
from labutopia_lerobot.labware.parts.pipe import Cone


def _lying_rod(name: str, long: float, thick: float, *, look: str) -> Shape:
    """Return a round rod that lies along x on two flat strips."""
    rod = Rod((-long / 2, 0, thick / 2), (long / 2, 0, thick / 2), thick, look)
    strip = Block(
        (-0.4 * long, 0.4 * long), (-0.25 * thick, 0.25 * thick), (0.0, 0.08 * thick), look, 0.0
    )
    return Shape((rod, strip), 0.5 * thick, thick)


def _pestle(name: str, long: float, head: float, thick: float) -> Shape:
    """Return a pestle that stands on its flat head."""
    forms = (
        Cone(head, head, (0.0, 0.4 * head), "ceramic"),
        Cone(head, thick, (0.4 * head, 1.2 * head), "ceramic"),
        Rod((0, 0, 1.2 * head), (0, 0, long), thick, "ceramic"),
    )
    return Shape(forms, 0.7 * long, thick)


def _spatula(name: str, long: float, wide: float, thick: float) -> Shape:
    blade = Block((-long / 2, -0.28 * long), (-wide / 2, wide / 2), (0.0, thick), "chrome", 0.0)
    shaft = Block(
        (-0.28 * long, long / 2), (-0.28 * wide, 0.28 * wide), (0.0, 1.5 * thick), "chrome", 0.0
    )
    return Shape((blade, shaft), 0.75 * thick, 0.56 * wide)


def _thermometer(name: str, long: float, thick: float) -> Shape:
    """Return a thermometer that lies along x, its bulb at -x."""
    bulb = -long / 2 + 0.04 * long
    radius = thick / 2
    forms: tuple[Form, ...] = (
        Rod((-long / 2, 0, radius), (bulb, 0, radius), 0.8 * thick, "red"),
        Rod((bulb, 0, radius), (long / 2, 0, radius), thick, "glass"),
        Rod((bulb, 0, radius), (0.1 * long, 0, radius), 0.15 * thick, "red", touch=False),
        Block(
            (0.05 * long, 0.4 * long), (-0.4 * radius, 0.4 * radius), (0.0, 0.1 * thick), "white", 0
        ),
    )
    return Shape(forms, radius, thick)


def _dropper(name: str, long: float, thick: float, bulb: float) -> Shape:
    """Return a dropper in one piece, on its tip: a tube and its teat."""
    forms = (
        Cone(0.3 * thick, thick, (0.0, 0.25 * long), "glass"),
        Rod((0, 0, 0.25 * long), (0, 0, 0.75 * long), thick, "glass"),
        Cone(bulb, 0.8 * bulb, (0.75 * long, long), "red_rubber"),
    )
    return Shape(forms, 0.88 * long, 0.9 * bulb)


SERIES = (
    StirringBarSeries(
        "stirring_bar",
        "A magnetic stirring bar.",
        partial(_lying_rod, look="white"),
        PTFE,
        "25 x 8 mm as usual; the magnet in it is twice as heavy; from memory",
        {  # length and diameter [mm]
            "10 x 4 mm": (10, 4),
            "25 x 8 mm": (25, 8),
            "40 x 8 mm": (40, 8),
            "50 x 10 mm": (50, 10),
        },
    ),
    UtensilSeries(
        "stirring_rod",
        "A glass stirring rod that lies.",
        partial(_lying_rod, look="glass_edge"),
        BOROSILICATE,
        "as usual; from memory",
        {"200 x 6 mm": (200, 6), "300 x 8 mm": (300, 8)},
    ),
    UtensilSeries(
        "pestle",
        "A pestle of porcelain.",
        _pestle,
        PORCELAIN,
        "DIN 12906 pestles are alike; from memory",
        {
            # length, head, handle
            "115 mm": (115, 24, 13),
            "135 mm": (135, 30, 15),
            "175 mm": (175, 36, 18),
        },
        stands=False,
    ),
    UtensilSeries(
        "spatula",
        "A spatula with a flat blade.",
        _spatula,
        STAINLESS_STEEL,
        "180 mm as usual; from memory",
        {"150 x 9 x 1.5 mm": (150, 9, 1.0), "180 x 12 x 1.5 mm": (180, 12, 1.0)},
    ),
    UtensilSeries(
        "thermometer",
        "A thermometer that lies.",
        _thermometer,
        SODA_LIME,
        "300 x 6 mm as usual; from memory",
        {"300 x 6 mm": (300, 6)},
    ),
    SyringeSeries(
        "syringe_plastic",
        "A plastic syringe whose plunger is pulled.",
        partial(syringe, look="natural"),
        POLYPROPYLENE,
        "ISO 7886-1, bores such that they hold the volume; from memory",
        {
            # barrel, its length, tip
            "5 ml": (14, 58, 10),
            "20 ml": (22, 80, 11),
            "50 ml": (31, 100, 12),
        },
        stands=False,
    ),
    SyringeSeries(
        "syringe_glass",
        "A glass syringe whose plunger is pulled.",
        partial(syringe, look="glass_edge"),
        BOROSILICATE,
        "as ISO 7886-1; from memory",
        {"10 ml": (18, 70, 10), "50 ml": (31, 100, 12)},
        stands=False,
    ),
    UtensilSeries(
        "dropper",
        "A dropper with its teat, in one piece.",
        _dropper,
        SODA_LIME,
        "8 x 100 mm as usual; solid; from memory",
        {"100 mm": (100, 8, 13)},  # length, diameter, teat
        stands=False,
    ),
    UtensilSeries(
        "pipette_filler",
        "A ball of rubber to fill pipettes, in one piece.",
        lambda name, tall, wide: Shape(
            (
                Cone(0.3 * wide, 0.3 * wide, (0.0, 0.3 * tall), "red_rubber"),
                Cone(0.3 * wide, wide, (0.3 * tall, 0.6 * tall), "red_rubber"),
                Cone(wide, 0.4 * wide, (0.6 * tall, tall), "red_rubber"),
            ),
            0.6 * tall,
            wide,
        ),
        SOFT_RUBBER,
        "as Peleus'; solid; from memory",
        {"110 x 55 mm": (110, 55)},
        stands=False,
    ),
)
