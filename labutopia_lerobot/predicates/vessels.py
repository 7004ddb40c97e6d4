"""Facts about vessels and other things that stand, are held, lean or fall."""

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD, Thing, World

_MARGIN = 0.001
"""How much narrower than it is the hand must be commanded to hold something [m]: the drive
of the default robot's hand then closes with 3.5 N a finger, which by friction hold 0.7
kg; measured, experts hold rods with 1.7 mm and vessels with 12."""

_LEVER = 0.1
"""Distance from the axis [m] at which a steady thing moves no faster by its turning either: about
the size of glassware."""


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
    """Gripper is closed on the thing: both pads touch it, and it keeps them from going further.

    What hangs on open fingers, or is jammed between them, is not gripped.
    """

    def holds(world: World) -> bool:
        touched = world.touching(LEFT_PAD, thing.name) and world.touching(RIGHT_PAD, thing.name)
        return touched and world.commanded_opening < world.gripper_opening - _MARGIN

    return Predicate(f"{thing.name} gripped", holds)


def steady(thing: Thing, *, below: float) -> Predicate:
    """Centre of mass moves slower than `below` [m/s], and so does by turning what is 10 cm off."""

    def holds(world: World) -> bool:
        turning = _LEVER * float(np.linalg.norm(world.angular_velocity(thing)))
        return bool(np.linalg.norm(world.velocity(thing)) < below) and turning < below

    return Predicate(f"{thing.name} steady below {below:g} m/s and {below / _LEVER:g} rad/s", holds)


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

    It may touch an open hand that it slips through. Free fall gets to 0.44 m/s in 10 mm.
    """
    return Predicate(
        f"{thing.name} falling faster than {faster_than:g} m/s",
        lambda world: world.fall_speed(thing) > faster_than,
    )
