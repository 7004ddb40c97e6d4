"""How the liquid of a scene looks: its particles, what stands in tubes, what lies on bottoms."""

import math
from collections.abc import Iterator, Sequence

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
    if solutions is None:
        return []
    crystals = _on_bottoms(liquid, vessels, solutions.crystals)
    return [Heap(vessel, *solutions.heap(lying, held)) for vessel, lying, held in crystals]


def sediments(liquid: Liquid, vessels: Sequence[VesselPose]) -> list[Sediment]:
    """Return the precipitates that cover the bottoms of vessels.

    Args:
        liquid: The liquid.
        vessels: `liquid.vessels`, where they are.
    """
    solutions = liquid.solutions
    if solutions is None:
        return []
    return [
        Sediment(vessel, solutions.sediment(lying, held, _bottom(vessel)))
        for vessel, lying, held in _on_bottoms(liquid, vessels, solutions.precipitates)
    ]


def _bottom(vessel: VesselPose) -> float:
    """Return the area of a vessel's bottom [m^2]."""
    return math.pi * vessel.profile.inner_radius(vessel.profile.bottom) ** 2


def _on_bottoms(
    liquid: Liquid, vessels: Sequence[VesselPose], solids: NDArray[np.bool_]
) -> Iterator[tuple[VesselPose, FloatArray, FloatArray]]:
    """Yield each vessel in which solids lie, and of its particles what lies and all they hold."""
    if not solids.any():
        return
    lying = _lying(liquid, solids)
    for index, vessel in enumerate(vessels):
        there = liquid.accounted == index
        if lying[there].any():
            yield vessel, lying[there], liquid.what.contents[there]


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
