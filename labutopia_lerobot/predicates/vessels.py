"""Facts about vessels and other things that stand, are held, lean or fall."""

import math
from collections.abc import Mapping

from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import LEFT_PAD, RIGHT_PAD, Thing, World

_MARGIN = 0.001
"""Amount by which the hand must be commanded narrower than a thing to hold it [m]: the drive
of the default robot's hand then closes with 3.5 N a finger, which by friction hold 0.7
kg; measured, experts hold rods with 1.7 mm and vessels with 12."""

REACH = 0.15
"""Distance of the hand at which it counts as near by 1/e [m] (ours; for `reward=dense` alone)."""

_LEVER = 0.1
"""Distance from the axis [m] at which a steady thing moves no faster by its turning either: about
the size of glassware."""


@predicate("{thing} lifted by {by:g} m")
def lifted(world: World, thing: Thing, *, by: float) -> bool:
    """Base of the thing is more than `by` metres above the bench top."""
    return bool(world.pose(thing).position_w[2] - world.bench_height > by)


@lifted.approach
def _height(world: World, thing: Thing, *, by: float) -> float:
    height = float(world.pose(thing).position_w[2]) - world.bench_height
    return min(max(height / by, 0.0), 1.0) if by > 0.0 else 1.0


@predicate("{thing} upright within {within_deg:g} deg")
def upright(world: World, thing: Thing, *, within_deg: float) -> bool:
    """Axis of the thing leans less than `within_deg` degrees from the vertical."""
    return world.pose(thing).tilt < math.radians(within_deg)


@upright.measure
def _lean(world: World, thing: Thing, *, within_deg: float) -> Mapping[str, float]:
    return {"deg": math.degrees(world.pose(thing).tilt)}


@predicate("{thing} tilted beyond {beyond_deg:g} deg")
def tilted(world: World, thing: Thing, *, beyond_deg: float) -> bool:
    """Axis of the thing leans more than `beyond_deg` degrees from the vertical."""
    return world.pose(thing).tilt > math.radians(beyond_deg)


@tilted.approach
def _tilt(world: World, thing: Thing, *, beyond_deg: float) -> float:
    return min(math.degrees(world.pose(thing).tilt) / beyond_deg, 1.0)


@predicate("{thing} gripped")
def gripped(world: World, thing: Thing) -> bool:
    """Gripper is closed on the thing: both pads touch it, and it keeps them from going further.

    What hangs on open fingers, or is jammed between them, is not gripped.
    """
    touched = world.touching(LEFT_PAD, thing.name) and world.touching(RIGHT_PAD, thing.name)
    return touched and world.commanded_opening < world.gripper_opening - _MARGIN


@gripped.approach
def _within_reach(world: World, thing: Thing) -> float:
    if thing.name not in {each.name for each in world.movable}:
        return 0.0
    grip = world.pose(thing).moved(z=getattr(thing, "grip_height", 0.0))
    return math.exp(-world.gripper.distance_to(grip) / REACH)


@predicate("{thing} steady below {below:g} m/s")
def steady(world: World, thing: Thing, *, below: float) -> bool:
    """Centre of mass moves slower than `below` [m/s], and so does by turning what is 10 cm away."""
    turning, moving = world.angular_velocity(thing), world.velocity(thing)
    return max(_LEVER * math.hypot(*turning.tolist()), math.hypot(*moving.tolist())) < below


@predicate("{thing} knocked over beyond {beyond_deg:g} deg")
def knocked_over(world: World, thing: Thing, *, beyond_deg: float) -> bool:
    """The thing leans more than `beyond_deg` degrees while not between the pads."""
    leans = world.pose(thing).tilt > math.radians(beyond_deg)
    return leans and not gripped(thing).holds(world)


@predicate("{thing} falling faster than {faster_than:g} m/s")
def falling(world: World, thing: Thing, *, faster_than: float) -> bool:
    """The thing moves down faster than `faster_than` metres per second while not between the pads.

    It may touch an open hand that it slips through. Free fall gets to 0.44 m/s in 10 mm.
    """
    return world.fall_speed(thing) > faster_than
