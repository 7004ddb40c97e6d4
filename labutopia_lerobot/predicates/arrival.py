"""Facts about a robot that drives: where it stands, what it faces, what it carries into."""

import math
from collections.abc import Mapping

import numpy as np

from labutopia_lerobot.places import reached_at
from labutopia_lerobot.predicates.predicate import predicate
from labutopia_lerobot.world import (
    HAND,
    LEFT_PAD,
    RIGHT_PAD,
    FloatArray,
    ReachedInto,
    Thing,
    World,
)

REACH = 1.0
"""Distance at which a base counts as near by 1/e [m] (ours; for `reward=dense` alone)."""
SHORT_OF = 0.05
"""How much farther off than where it is to dock a base may stand [m]; ours: a cell of the map."""


@predicate("base within {within:g} m of {thing}")
def beside(world: World, thing: Thing, *, within: float) -> bool:
    """Middle of the base is, horizontally, within a distance [m] of the thing (`reached_at`).

    No wall is between them.
    """
    return _way(world, thing)[0] < within and not _walled_off(world, thing)


@beside.measure
def _distance_left(world: World, thing: Thing, *, within: float) -> Mapping[str, float]:
    return {"mm": 1e3 * _way(world, thing)[0]}


@beside.approach
def _nearness(world: World, thing: Thing, *, within: float) -> float:
    return _near(world, thing, within)


@predicate("{thing} within {share:g} of the arm's reach")
def at_hand(world: World, thing: Thing, *, share: float) -> bool:
    """Base is so near to the thing that, faced, it is within a share of the reach of its arm.

    Into something an arm reaches less far: there the base stands at most `SHORT_OF` farther off
    than where it is to dock (`ReachedInto`). No wall is between them.
    """
    return _way(world, thing)[0] < _reached(world, thing, share) and not _walled_off(world, thing)


@at_hand.measure
def _too_far(world: World, thing: Thing, *, share: float) -> Mapping[str, float]:
    return {"mm": 1e3 * _way(world, thing)[0]}


@at_hand.approach
def _nearness_to_hand(world: World, thing: Thing, *, share: float) -> float:
    return _near(world, thing, _reached(world, thing, share))


@predicate("{thing} where the arm takes it from above")
def below_hand(world: World, thing: Thing) -> bool:
    """Base is so near to the thing that, faced, its arm takes it from above (`Wheels.above`).

    It stands at most `SHORT_OF` farther off than where it is to dock; no wall is between them.
    """
    return _way(world, thing)[0] < _reached_down(world) and not _walled_off(world, thing)


@below_hand.measure
def _too_far_to_take(world: World, thing: Thing) -> Mapping[str, float]:
    return {"mm": 1e3 * _way(world, thing)[0]}


@below_hand.approach
def _nearness_below_hand(world: World, thing: Thing) -> float:
    return _near(world, thing, _reached_down(world))


@predicate("base facing {thing} within {within_deg:g} deg")
def facing(world: World, thing: Thing, *, within_deg: float) -> bool:
    """Heading of the base is within an angle of the direction from its middle to the thing."""
    return abs(_way(world, thing)[1]) < math.radians(within_deg)


@facing.measure
def _heading_error(world: World, thing: Thing, *, within_deg: float) -> Mapping[str, float]:
    return {"deg": math.degrees(abs(_way(world, thing)[1]))}


@facing.approach
def _turned_to(world: World, thing: Thing, *, within_deg: float) -> float:
    return 1.0 - abs(_way(world, thing)[1]) / math.pi


@predicate("base slower than {than:g}")
def halted(world: World, *, than: float) -> bool:
    """Base, if there is one, is slower than a speed, along and across [m/s], turning [rad/s]."""
    return _slower(world, than)


@predicate("{thing} raised by {by:g} m")
def raised(world: World, thing: Thing, *, by: float) -> bool:
    """Base of the thing is more than `by` metres above where it stood at the start."""
    return _rise(world, thing) > by


@raised.approach
def _height(world: World, thing: Thing, *, by: float) -> float:
    return min(max(_rise(world, thing) / by, 0.0), 1.0) if by > 0.0 else 1.0


def _rise(world: World, thing: Thing) -> float:
    rise: FloatArray = world.pose(thing).position_w - world.stood(thing).position_w
    return float(rise[2])


@predicate("{thing} carried into anything but {others} and, slower than {than:g}, benches")
def carried_into(world: World, thing: Thing, *others: Thing, than: float) -> bool:
    """The thing, between the pads, touches what is neither hand nor one of some others.

    A bench it may touch while the base is slower than a speed, along and across [m/s], turning
    [rad/s]: it is lifted off one and set down on one, never driven against one. How firmly it is
    held is all one: who drives it into something with a loose grip has, too.
    """
    own = {LEFT_PAD, RIGHT_PAD, HAND, *(other.name for other in others)}
    if _slower(world, than):
        own |= {dock.bench for dock in world.floor.docks}
    held = world.touching(LEFT_PAD, thing.name) and world.touching(RIGHT_PAD, thing.name)
    return held and not world.touched_by(thing.name) <= own


def _slower(world: World, than: float) -> bool:
    return bool((np.abs(world.base_velocity) < than).all())


def _reached(world: World, thing: Thing, share: float) -> float:
    """Return how far before the middle of the base the arm reaches a thing [m]; see `at_hand`."""
    far = share * world.robot.reach
    if isinstance(thing, ReachedInto):
        far = min(far, thing.opening.ahead[1] + SHORT_OF)
    return _arm(world) + far


def _reached_down(world: World) -> float:
    """Return how far before the middle of the base the arm takes things from above [m]."""
    wheels = world.robot.base
    return -math.inf if wheels is None else _arm(world) + wheels.above + SHORT_OF


def _arm(world: World) -> float:
    """Return how far before the middle of the base that of the arm is [m]."""
    base = world.mobile_base
    return 0.0 if base is None else float((base.inverse() @ world.robot_base).position_w[0])


def _near(world: World, thing: Thing, within: float) -> float:
    return math.exp(-max(0.0, _way(world, thing)[0] - within) / REACH)


def _way(world: World, thing: Thing) -> tuple[float, float]:
    """Return how far the middle of the base is from a thing [m], and its bearing there [rad]."""
    base = world.mobile_base
    if base is None:
        return math.inf, math.pi
    seen = base.inverse()
    x, y, _ = seen.position_w + seen.rotation_w @ reached_at(world, thing)
    return math.hypot(x, y), math.atan2(y, x)


def _walled_off(world: World, thing: Thing) -> bool:
    """Return whether a wall of the room is between the middle of the base and a thing."""
    base = world.mobile_base
    if base is None:
        return False
    return world.floor.wall_between(base.position_w[:2], reached_at(world, thing)[:2])
