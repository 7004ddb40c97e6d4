"""Facts about vessels and other things that stand, are held, lean or fall."""

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD, Thing


def lifted(thing: Thing, *, by: float) -> Predicate:
    """Base of the thing is more than `by` metres above the bench top."""
    return Predicate(
        f"{thing.name} lifted by {by:g} m",
        lambda world: bool(world.pose(thing).position_w[2] - world.bench_height > by),
    )


def upright(thing: Thing, *, within_deg: float) -> Predicate:
    """Axis of the thing leans less than `within_deg` degrees from the vertical."""
    limit = np.radians(within_deg)
    return Predicate(
        f"{thing.name} upright within {within_deg:g} deg",
        lambda world: world.pose(thing).tilt < limit,
        off=lambda world: {"deg": float(np.degrees(world.pose(thing).tilt))},
    )


def gripped(thing: Thing) -> Predicate:
    """Both pads of the gripper touch the thing."""
    return Predicate(
        f"{thing.name} gripped",
        lambda world: (
            world.touching(LEFT_PAD, thing.name) and world.touching(RIGHT_PAD, thing.name)
        ),
    )


def steady(thing: Thing, *, below: float) -> Predicate:
    """Centre of mass of the thing moves slower than `below` metres per second."""
    return Predicate(
        f"{thing.name} steady below {below:g} m/s",
        lambda world: bool(np.linalg.norm(world.velocity(thing)) < below),
    )


def knocked_over(thing: Thing, *, beyond_deg: float) -> Predicate:
    """The thing leans more than `beyond_deg` degrees while not between the pads."""
    limit = np.radians(beyond_deg)
    held = gripped(thing)
    return Predicate(
        f"{thing.name} knocked over",
        lambda world: world.pose(thing).tilt > limit and not held.holds(world),
    )


def falling(thing: Thing, *, faster_than: float) -> Predicate:
    """The thing moves down faster than `faster_than` metres per second while not between the pads.

    It may touch an open hand that it slips through.
    """
    held = gripped(thing)
    return Predicate(
        f"{thing.name} falling",
        lambda world: bool(world.velocity(thing)[2] < -faster_than) and not held.holds(world),
    )
