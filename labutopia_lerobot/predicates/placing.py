"""Facts about setting a thing down, leaving it, and leaving others alone."""

import math
from collections.abc import Mapping, Sequence
from typing import Protocol

from labutopia_lerobot.places import Destination
from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import BENCH, HAND, LEFT_PAD, RIGHT_PAD, Standing, Thing, World

_LEVEL_DEG = 1.0
"""A base of 70 mm diameter that leans more than this has an edge 1 mm in the air."""

_CONTACT = 0.001
"""Greatest height of a base above what it stands on [m]; contacts give by less than 0.1 mm."""


@predicate("{thing} within {within:g} m of {place}")
def near(world: World, thing: Thing, place: Destination, *, within: float) -> bool:
    """Axis of the thing is, horizontally, within a distance [m] of the place."""
    return _distance(world, thing, place) < within


@near.measure
def _place_errors(
    world: World, thing: Thing, place: Destination, *, within: float
) -> Mapping[str, float]:
    return {"mm": 1e3 * _distance(world, thing, place)}


def _distance(world: World, thing: Thing, place: Destination) -> float:
    """Return how far the axis of a thing is from a place, horizontally [m]."""
    x, y, _ = (world.pose(thing).position_w - place.position_w(world)).tolist()
    return math.hypot(x, y)


@predicate("{thing} standing on {place}")
def standing_on(world: World, thing: Thing, place: Destination) -> bool:
    """Base of the thing is in full contact with what bears the place: it touches, level and low."""
    if not world.touching(thing.name, place.support):
        return False
    pose = world.pose(thing)
    gap = abs(pose.position_w[2] - place.position_w(world)[2])
    return bool(gap < _CONTACT and pose.tilt < math.radians(_LEVEL_DEG))


@standing_on.measure
def _level_errors(world: World, thing: Thing, place: Destination) -> Mapping[str, float]:
    return {"deg": math.degrees(world.pose(thing).tilt)}


@predicate("{thing} seated within {within:g} m of {place}")
def seated(world: World, thing: Thing, place: Destination, *, within: float) -> bool:
    """Foot of the thing is at a place in all directions [m], and touches what bears the place.

    For what leans a little where it is held, as a tube in a rack or a bore.
    """
    return world.touching(thing.name, place.support) and _off(world, thing, place) < within


@seated.measure
def _seat_errors(
    world: World, thing: Thing, place: Destination, *, within: float
) -> Mapping[str, float]:
    return {"mm": 1e3 * _off(world, thing, place)}


class Holder(Thing, Protocol):
    """A rack, a rotor's centrifuge: what has many places of one kind."""

    @property
    def places(self) -> Sequence[Destination]:
        """The places."""
        ...


@predicate("{thing} in {holder} within {within:g} m")
def held_by(world: World, thing: Thing, holder: Holder, *, within: float) -> bool:
    """The thing is seated in one of the places of a rack or a rotor, whichever: see `seated`."""
    touched = world.touched_by(thing.name)
    return any(
        place.support in touched and _off(world, thing, place) < within for place in holder.places
    )


def _off(world: World, thing: Thing, place: Destination) -> float:
    """Return how far the foot of a thing is from a place [m]."""
    return math.dist(world.pose(thing).position_w, place.position_w(world))


@predicate("{thing} released")
def released(world: World, thing: Thing) -> bool:
    """No part of the hand touches the thing."""
    return not world.touched_by(thing.name) & {LEFT_PAD, RIGHT_PAD, HAND}


@predicate("hand withdrawn {by:g} m from {thing}")
def withdrawn(world: World, thing: Standing, *, by: float) -> bool:
    """Point between the pads is more than `by` metres from the cylinder around the thing."""
    x, y, z = world.pose(thing).local(world.gripper.position_w)
    aside = max(0.0, math.hypot(x, y) - thing.footprint_radius)
    beyond = max(0.0, -z, z - thing.height)
    return math.hypot(aside, beyond) > by


@predicate("{things} struck by anything but {but_for} with {force:g} N")
def struck(
    world: World, *things: Thing, but_for: frozenset[str] = frozenset(), force: float = 0.0
) -> bool:
    """Something touches one of the things: anything but the bench and what may.

    Args:
        world: The world.
        *things: Things to leave alone.
        but_for: Contact names of what may touch them.
        force: What may touches with this force [N] or less.
    """
    return any(
        force == 0.0 or world.contact_force(thing.name, other) > force
        for thing in things
        for other in world.touched_by(thing.name) - but_for - {BENCH}
    )


@predicate("{thing} touching {others}")
def touching(world: World, thing: Thing, *others: Thing) -> bool:
    """The thing touches one of the others."""
    return bool(world.touched_by(thing.name) & {other.name for other in others})
