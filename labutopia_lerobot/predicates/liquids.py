"""Facts about liquid: poured, spilled, contaminated, moving.

Where liquid is simulated they are about volumes. Where it is not (`liquid=off`) the same facts are
judged by how vessels are tilted, as in the original.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import FloatArray, OpenVessel, Thing, World

POURS_BELOW = 0.30
"""Most that a pouring lip may be above the target [m]; ours: paper "above", original 0.1 to 0.2."""

_EMPTIED_DEG = 95.0
"""Lean from which on nothing stays in a beaker: beyond the level [deg]."""

_MISPLACED = 0.05
"""Share of what was filled in that may lie in a wrong vessel; ours, as what may be spilled."""


@predicate("{vessel} lip less than {below:g} m over {target}")
def lip_over(world: World, vessel: OpenVessel, target: OpenVessel, *, below: float) -> bool:
    """Lowest point of the lip is over the target's mouth, less than `below` metres above it."""
    x, y, z = _lip(world, vessel) - world.frame(target.rim).position_w
    return math.hypot(x, y) < target.mouth_radius and bool(0.0 < z < below)


def _lip(world: World, vessel: OpenVessel) -> FloatArray:
    """Lowest point of the vessel's lip, shape (3,), metres, world frame."""
    rim = world.frame(vessel.rim)
    # The part of "down" that lies in the plane of the rim.
    slope: FloatArray = rim.z_axis * rim.z_axis[2] - (0.0, 0.0, 1.0)
    lip: FloatArray = slope * vessel.mouth_radius / max(float(np.linalg.norm(slope)), 1e-9)
    return rim.position_w + lip


@predicate("{share:percent} of what was in {origin} poured out of {vessel} into {target}")
def poured(
    world: World, vessel: OpenVessel, target: OpenVessel, *, share: float, origin: Thing
) -> bool:
    """At least this share of what was filled into the origin is in the target.

    Without liquid: the vessel leans beyond the level with its lip over the target's mouth.

    Args:
        world: The world.
        vessel: What it is poured out of.
        target: What it is poured into.
        share: How much of it must have arrived.
        origin: What it was filled into at the start, such as the vessel itself.
    """
    liquid = world.liquid
    if liquid is None:
        emptied = world.pose(vessel).tilt > math.radians(_EMPTIED_DEG)
        return emptied and lip_over(vessel, target, below=POURS_BELOW).holds(world)
    arrived = liquid.from_in(origin.name, target.name)
    return arrived > 0.0 and arrived >= share * liquid.originated_in(origin.name)


@poured.measure
def _still_missing(
    world: World, vessel: OpenVessel, target: OpenVessel, *, share: float, origin: Thing
) -> Mapping[str, float]:
    liquid = world.liquid
    if liquid is None:
        return {}
    arrived = liquid.from_in(origin.name, target.name)
    return {"ml": 1e6 * (liquid.originated_in(origin.name) - arrived)}


@predicate("more than {share:percent} of {vessel} spilled; it may lean over {over}")
def spilled(world: World, vessel: Thing, *, share: float, over: OpenVessel | None = None) -> bool:
    """More than this share of what was filled into the vessel lies on what stands, as the bench.

    What is in the hand, or falls from it, is not spilled yet: it clings.

    Without liquid: the vessel leans further than a half-full one can before it runs over.

    Args:
        world: The world.
        vessel: What the liquid was filled into.
        share: How much of it may be spilled.
        over: Without liquid, what the vessel may lean over: its target.
    """
    liquid = world.liquid
    if liquid is not None:
        return liquid.spilled_from(vessel.name) > share * liquid.originated_in(vessel.name)
    runs_over = world.pose(vessel).tilt > math.radians(_runs_over_deg(vessel))
    if not runs_over or over is None or not isinstance(vessel, OpenVessel):
        return runs_over
    return not lip_over(vessel, over, below=POURS_BELOW).holds(world)


@cache
def _runs_over_deg(vessel: Thing) -> float:
    """Return from which lean on a vessel spills where no liquid is simulated [deg].

    A half-full cylinder runs over where the tangent of its lean is its height over the diameter of
    its mouth, one that tapers later. 9 degrees before that: 45 for a beaker; where it is tall and
    narrow 60, from where on a lip that pours must be over its target (`actions.pour`). A bottle
    with a spout is not distinguished from a beaker.
    """
    if not isinstance(vessel, OpenVessel):
        return 45.0
    brim = math.degrees(math.atan2(vessel.height, 2 * vessel.mouth_radius))
    return min(max(brim - 9.0, 45.0), 60.0)


@predicate("more than {more_than_ml:g} ml of what was in {origin} in {target}")
def given(world: World, origin: Thing, target: Thing, *, more_than_ml: float) -> bool:
    """More than a volume [ml] of what was filled into the origin is in the target."""
    liquid = world.liquid
    return liquid is not None and liquid.from_in(origin.name, target.name) * 1e6 > more_than_ml


@predicate("{low_ml:g} to {high_ml:g} ml of what was in {origin} in {target}")
def received(world: World, origin: Thing, target: Thing, *, low_ml: float, high_ml: float) -> bool:
    """A volume between two [ml] of what was filled into the origin is in the target."""
    return world.liquid is not None and low_ml <= _there(world, origin, target) <= high_ml


@received.measure
def _off_volume(
    world: World, origin: Thing, target: Thing, *, low_ml: float, high_ml: float
) -> Mapping[str, float]:
    if world.liquid is None:
        return {}
    return {"ml": abs(_there(world, origin, target) - (low_ml + high_ml) / 2)}


def _there(world: World, origin: Thing, target: Thing) -> float:
    """Return how much of what was filled into the origin is in the target [ml], as accounts add."""
    liquid = world.liquid
    return 0.0 if liquid is None else round(1e6 * liquid.from_in(origin.name, target.name), 6)


@dataclass(frozen=True)
class Transfer:
    """A transfer that is to be poured.

    Attributes:
        origin: What the liquid was filled into at the start.
        into: What it is to get into.
    """

    origin: Thing
    into: Thing

    @property
    def name(self) -> str:
        return f"{self.origin.name} into {self.into.name}"


@predicate("more than {share:percent} of a liquid in a wrong vessel, {transfers} excepted")
def contaminated(world: World, *transfers: Transfer, share: float = _MISPLACED) -> bool:
    """Too much of what was filled into a vessel lies in another one that it is not to get into.

    Args:
        world: The world.
        *transfers: Which liquids are to get where.
        share: How much of what was filled in may be elsewhere.
    """
    liquid = world.liquid
    if liquid is None:
        return False
    allowed = {(transfer.origin.name, transfer.into.name) for transfer in transfers}
    return any(
        amount > share * liquid.originated_in(origin)
        for origin, amount in liquid.elsewhere(allowed).items()
    )


@predicate("liquid in {vessel} moving above {above:g} m/s")
def liquid_moving(world: World, vessel: Thing, *, above: float) -> bool:
    """Liquid inside the vessel moves at more than `above` metres per second on the average.

    Without liquid: never.
    """
    return world.liquid is not None and world.liquid.speed_in(vessel.name) > above
