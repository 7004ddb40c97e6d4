"""How the liquid of a scene looks: its particles, what stands in tubes, what lies on bottoms."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from labutopia_lerobot.liquids.drawing.column import Column
from labutopia_lerobot.liquids.drawing.heap import Heap
from labutopia_lerobot.liquids.drawing.sediment import Sediment
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.world import FloatArray


def looks(liquid: Liquid, tints: FloatArray, *, heaped: bool = False) -> FloatArray:
    """Return colour and opacity of the particles in motion, shape (n, 4).

    Args:
        liquid: The liquid.
        tints: Those of every substance, shape (substances, 4), where nothing is dissolved.
        heaped: Whether what lies on bottoms is shown as `heaps`, and so clouds no particle.
    """
    if heaped and liquid.solutions is not None:
        lying = _lying(liquid, liquid.solutions.crystals)
        return liquid.solutions.looks(liquid.what.contents - lying)
    return _of(liquid, liquid.what, tints)


def columns(liquid: Liquid, vessels: Sequence[VesselPose], tints: FloatArray) -> list[Column]:
    """Return what stands in narrow vessels.

    Args:
        liquid: The liquid.
        vessels: `liquid.vessels`, where they are.
        tints: As of `looks`.
    """
    kept, found = liquid.kept, list[Column]()
    for index, vessel in enumerate(vessels):
        there = np.flatnonzero(kept.holders == index)
        if len(there):
            color = _of(liquid, kept.portion.part(there), tints).mean(axis=0)
            found.append(Column(vessel, len(there) * liquid.volume, color))
    return found


def heaps(liquid: Liquid, vessels: Sequence[VesselPose]) -> list[Heap]:
    """Return the crystals that lie on the bottoms of vessels.

    Args:
        liquid: The liquid.
        vessels: `liquid.vessels`, where they are.
    """
    solutions = liquid.solutions
    if solutions is None or not solutions.crystals.any():
        return []
    lying, found = _lying(liquid, solutions.crystals), list[Heap]()
    for index, vessel in enumerate(vessels):
        there = liquid.accounted == index
        if lying[there].any():
            found.append(Heap(vessel, *solutions.heap(lying[there], liquid.what.contents[there])))
    return found


def sediments(liquid: Liquid, vessels: Sequence[VesselPose]) -> list[Sediment]:
    """Return the precipitates that cover the bottoms of vessels.

    Args:
        liquid: The liquid.
        vessels: `liquid.vessels`, where they are.
    """
    solutions = liquid.solutions
    if solutions is None or not solutions.precipitates.any():
        return []
    lying, found = _lying(liquid, solutions.precipitates), list[Sediment]()
    for index, vessel in enumerate(vessels):
        there = liquid.accounted == index
        if lying[there].any():
            area = math.pi * vessel.profile.inner_radius(vessel.profile.bottom) ** 2
            color = solutions.sediment(lying[there], liquid.what.contents[there], area)
            found.append(Sediment(vessel, color))
    return found


def _of(liquid: Liquid, what: Portion, tints: FloatArray) -> FloatArray:
    """Return colour and opacity of particles, shape (m, 4)."""
    if liquid.solutions is not None:
        return liquid.solutions.looks(what.contents)
    mixed: FloatArray = what.amounts @ tints
    return mixed


def _lying(liquid: Liquid, solids: NDArray[np.bool_]) -> FloatArray:
    """Return what of each particle's contents lies on a bottom, shape (n, species) [mol]."""
    assert liquid.solutions is not None
    over = liquid.over_bottoms()
    return liquid.solutions.lying(solids, liquid.what.contents, over, liquid.accounted)
