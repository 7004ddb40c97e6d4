"""The words that families are written in."""

from labutopia_lerobot.scenes.generation.at_things import Before, Facing, On
from labutopia_lerobot.scenes.generation.family import (
    Chamber,
    Corridor,
    Family,
    Importance,
    Need,
    WareNeed,
)
from labutopia_lerobot.scenes.generation.in_rooms import AtWall, InMiddle, Peninsula, ToWorkAt

FIRST, VITAL, MAIN, USUAL, DETAIL = (
    Importance.FIRST,
    Importance.VITAL,
    Importance.MAIN,
    Importance.USUAL,
    Importance.DETAIL,
)

AT_WALL = AtWall()
DESK_AT_WALL = AtWall(before=1.2)
"""At a wall, with room for a chair that turns."""
AT_OUTER_WALL = AtWall(outer=True)
BESIDE = AtWall(before=0.3)
"""At a wall, where nobody works before it."""
HUNG_LOW = AtWall(before=0.3, height=0.9)
HUNG_HIGH = AtWall(before=0.0, height=1.5)
"""Over benches (furniture hangs 1.5 m high, as `instruments/furniture` says)."""
BOARD = AtWall(before=0.6, height=0.8)
"""At a wall and as high as blackboards hang."""
BEFORE_BOARD = Facing("blackboard")
ISLAND = InMiddle()
PENINSULA = Peninsula()
WORK_PLACE = ToWorkAt()

BENCHES = ("wall_bench", "island_bench", "base_cabinet")
ON_BENCH = On(BENCHES)
ON_WALL_BENCH = On(("wall_bench", "base_cabinet"))
IN_RACK = On(("shelf_rack",))
AT_BENCH = Before(("wall_bench", "island_bench"))
AT_DESK = Before(("writing_desk", "teacher_desk"))

WORK_BENCH = Need("work_bench", (1, 1), WORK_PLACE, VITAL)
"""A place for the robot arm."""

SAFETY = (
    Need("fire_extinguisher", (1, 1), HUNG_LOW, USUAL),
    Need("waste_bin", (1, 2), BESIDE, DETAIL),
    Need("coat_rack", (0, 1), BESIDE, DETAIL),
)
"""Things that every laboratory has (DGUV Information 213-850)."""

SOLUTIONS = ("water", "ethanol", "ethylene glycol", "glycerol")
"""Substances in bottles; each has a colour of its own."""


def on_benches(
    kind: str, *sizes: str, often: int = 1, closed: bool = False, contents: tuple[str, ...] = ()
) -> WareNeed:
    """Return ware that stands about on benches; see `WareNeed`."""
    return WareNeed(kind, sizes, "bench", often, closed, contents)


def on_shelves(
    kind: str, *sizes: str, often: int = 1, closed: bool = False, contents: tuple[str, ...] = ()
) -> WareNeed:
    """Return ware that is kept on shelves; see `WareNeed`."""
    return WareNeed(kind, sizes, "shelf", often, closed, contents)


GLASS_IN_USE = (
    on_benches("beaker_low", "100 ml", "250 ml", "600 ml", often=4),
    on_benches("beaker_tall", "250 ml", "600 ml"),
    on_benches("erlenmeyer_narrow", "100 ml", "250 ml", "500 ml", often=3),
    on_benches("graduated_cylinder", "50 ml", "100 ml", "250 ml", often=2),
    on_benches("reagent_bottle", "250 ml", "500 ml", closed=True, contents=SOLUTIONS, often=2),
)
"""Glass that stands on every chemist's bench."""

BOTTLES = (
    on_shelves(
        "reagent_bottle", "250 ml", "500 ml", "1000 ml", closed=True, contents=SOLUTIONS, often=3
    ),
    on_shelves("reagent_bottle_amber", "250 ml", "500 ml", "1000 ml", closed=True, often=2),
    on_shelves("sample_jar", "250 ml", "500 ml"),
)
"""Reagents on shelves."""

CLEAN_GLASS = (
    on_shelves("beaker_low", "250 ml", "400 ml", "600 ml"),
    on_shelves("erlenmeyer_narrow", "250 ml", "500 ml"),
    on_shelves("graduated_cylinder", "100 ml", "250 ml"),
)
"""Glass that is put away."""

__all__ = [
    "AT_BENCH",
    "AT_DESK",
    "AT_OUTER_WALL",
    "AT_WALL",
    "BEFORE_BOARD",
    "BENCHES",
    "BESIDE",
    "BOARD",
    "BOTTLES",
    "CLEAN_GLASS",
    "DESK_AT_WALL",
    "DETAIL",
    "FIRST",
    "GLASS_IN_USE",
    "HUNG_HIGH",
    "HUNG_LOW",
    "IN_RACK",
    "ISLAND",
    "MAIN",
    "ON_BENCH",
    "ON_WALL_BENCH",
    "PENINSULA",
    "SAFETY",
    "SOLUTIONS",
    "USUAL",
    "VITAL",
    "WORK_BENCH",
    "WORK_PLACE",
    "Chamber",
    "Corridor",
    "Family",
    "Need",
    "On",
    "WareNeed",
    "on_benches",
    "on_shelves",
]
