"""`python scripts/make_rooms.py [FAMILY ...]`: the rooms of the package, `scenes/plans/*.json`.

Ten of every family: the first seeds from 0 whose rooms hold what they need and are proven.
"""

import sys
from collections.abc import Iterator
from itertools import count, islice

from labutopia_lerobot.scenes.families import families, family
from labutopia_lerobot.scenes.generation import RoomTooSmallError, generate
from labutopia_lerobot.scenes.plan import Plan
from labutopia_lerobot.scenes.plans import text_of
from labutopia_lerobot.scenes.plans.shipped_plans import FOLDER
from labutopia_lerobot.scenes.proof import faults

EACH = 10
"""Rooms of a family."""


def main(names: list[str]) -> None:
    """Write the rooms of some families, or of all."""
    for name in names or families():
        for file in FOLDER.glob(f"{name}_*.json"):
            file.unlink()
        for plan in islice(proven_rooms(name), EACH):
            (FOLDER / f"{plan.name}.json").write_text(text_of(plan), encoding="utf-8")


def proven_rooms(name: str) -> Iterator[Plan]:
    """Yield rooms of a family, seed after seed, leaving out those that are too small."""
    for seed in count():
        try:
            plan = generate(family(name), seed)
        except RoomTooSmallError:
            continue
        if not faults(plan):
            yield plan


if __name__ == "__main__":
    main(sys.argv[1:])
