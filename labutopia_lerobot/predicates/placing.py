"""Facts about setting a vessel down and leaving it."""

import numpy as np

from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import BENCH, HAND, LEFT_PAD, RIGHT_PAD, Standing, Thing, World

_LEVEL_DEG = 1.0
"""A base of 70 mm diameter that leans more than this has an edge 1 mm in the air."""

_CONTACT = 0.001
"""Greatest height of a base above what it stands on [m]; contacts give by less than 0.1 mm."""


def near(thing: Thing, place: Destination, *, within: float) -> Predicate:
    """Axis of the thing is, horizontally, within a distance [m] of the place."""

    def distance(world: World) -> float:
        offset = world.pose(thing).position_w - place.position_w(world)
        return float(np.hypot(offset[0], offset[1]))

    return Predicate(
        f"{thing.name} within {within:g} m of {place.name}",
        lambda world: distance(world) < within,
        off=lambda world: {"mm": 1e3 * distance(world)},
    )


def standing_on(thing: Thing, place: Destination) -> Predicate:
    """Base of the thing is in full contact with what is at the place: it touches, level and low."""

    def holds(world: World) -> bool:
        pose = world.pose(thing)
        gap = abs(pose.position_w[2] - place.position_w(world)[2])
        level = pose.tilt < np.radians(_LEVEL_DEG)
        return bool(gap < _CONTACT and level and world.touching(thing.name, place.support))

    return Predicate(
        f"{thing.name} standing on {place.support}",
        holds,
        off=lambda world: {"deg": float(np.degrees(world.pose(thing).tilt))},
    )


def released(thing: Thing) -> Predicate:
    """No part of the hand touches the thing."""
    parts = frozenset({LEFT_PAD, RIGHT_PAD, HAND})
    return Predicate(
        f"{thing.name} released", lambda world: not world.touched_by(thing.name) & parts
    )


def withdrawn(thing: Standing, *, by: float) -> Predicate:
    """Point between the pads is more than `by` metres from the cylinder around the thing."""

    def holds(world: World) -> bool:
        x, y, z = (world.pose(thing).inverse() @ world.gripper).position_w
        aside = max(0.0, np.hypot(x, y) - thing.footprint_radius)
        beyond = max(0.0, -z, z - thing.height)
        return bool(np.hypot(aside, beyond) > by)

    return Predicate(f"hand withdrawn {by:g} m from {thing.name}", holds)


def struck(*things: Thing, but_for: frozenset[str] = frozenset()) -> Predicate:
    """Something touches a bystander: anything but the bench and what may."""
    names, allowed = [thing.name for thing in things], but_for | {BENCH}
    return Predicate(
        f"{' or '.join(names)} struck",
        lambda world: any(world.touched_by(name) - allowed for name in names),
    )


def touching(thing: Thing, *others: Thing) -> Predicate:
    """The thing touches one of the others."""
    names = frozenset(other.name for other in others)
    return Predicate(
        f"{thing.name} touching {' or '.join(sorted(names))}",
        lambda world: bool(world.touched_by(thing.name) & names),
    )
