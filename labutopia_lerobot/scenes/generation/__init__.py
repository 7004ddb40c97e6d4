"""Furnished rooms from a description and a seed, as in the paper's generation pipeline.

Pieces are placed in order of importance and size; spots come from a grid and keep the boundary,
collisions, and what an instrument needs; the best score wins; a search with backtracking follows
where sampling fails (paper, "Environment Generation Pipeline"). Where that fails as well, the shell
of the room is drawn anew, unless its size was said. Ware comes last (`stock`).
"""

from contextlib import suppress

import numpy as np

from labutopia_lerobot.scenes.generation.family import Family
from labutopia_lerobot.scenes.generation.footprint import draw_footprint
from labutopia_lerobot.scenes.generation.search import RoomTooSmallError, furnish, wanted
from labutopia_lerobot.scenes.generation.stock import stocked
from labutopia_lerobot.scenes.plan import Placed, Plan

SHELLS = 6
"""Attempts at drawing size, doors and windows for a seed before it is given up: of 400 rooms, 40 of
every family, 13 need a second and 3 a third."""


def generate(
    family: Family,
    seed: int,
    name: str | None = None,
    size: tuple[float, float] | None = None,
) -> Plan:
    """Return a room of a family; the same for the same seed.

    Args:
        family: What kind of laboratory.
        seed: Draws all that is drawn, at least 0.
        name: Of the plan; family and seed if not said.
        size: Width and depth of the room [m] instead of those that the family draws.

    Raises:
        RoomTooSmallError: If what it needs does not fit.
        FootprintError: If it cannot have this size.
    """
    rng = np.random.default_rng([seed, *family.name.encode()])
    name = name or f"{family.name}_{seed}"
    for _ in range(SHELLS - 1 if size is None else 0):
        with suppress(RoomTooSmallError):
            return _generated(family, seed, name, size, rng)
    return _generated(family, seed, name, size, rng)


def _generated(
    family: Family,
    seed: int,
    name: str,
    size: tuple[float, float] | None,
    rng: np.random.Generator,
) -> Plan:
    footprint = draw_footprint(family, rng, size)
    floor, wall = (
        str(looks[int(rng.integers(len(looks)))]) for looks in (family.floors, family.walls)
    )
    sketch = furnish(family, footprint, wanted(footprint, rng), rng)
    plan = Plan(
        name=name,
        family=family.name,
        seed=seed,
        size=footprint.size,
        walls=footprint.walls,
        openings=footprint.openings,
        pieces=_carriers_first([entry.piece for entry in sketch.entries]),
        work_places=tuple(entry.place for entry in sketch.entries if entry.place is not None),
        floor=floor,
        wall=wall,
    )
    return stocked(plan, family.stock)


def _carriers_first(pieces: list[Placed]) -> tuple[Placed, ...]:
    """Return pieces by kind, what stands on others at the end."""
    return tuple(sorted(pieces, key=lambda piece: (piece.on is not None, piece.kind, piece.name)))


__all__ = ["Family", "RoomTooSmallError", "generate"]
