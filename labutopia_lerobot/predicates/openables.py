"""Facts about doors and drawers, and about the hand that moves them."""

import math
from typing import Protocol, runtime_checkable

import numpy as np

from labutopia_lerobot.predicates.predicate import Predicate, predicate
from labutopia_lerobot.predicates.vessels import REACH, gripped
from labutopia_lerobot.world import Thing, World

_AJAR = 0.3
"""Position at which a door or drawer counts as shut by 1/e [rad or m] (ours; `reward=dense`)."""


@runtime_checkable
class Bar(Thing, Protocol):
    """A straight handle; the frame of its name lies in its middle, z along it."""

    @property
    def length(self) -> float:
        """Length [m]."""
        ...

    @property
    def diameter(self) -> float:
        """Diameter [m]."""
        ...


class Engaging(Protocol):
    """Mechanism that keeps a shut door shut."""

    @property
    def joint(self) -> str:
        """Name of the joint that shows whether it does [m]."""
        ...

    @property
    def engaged_within(self) -> float:
        """Position of that joint below which it does, if the door is closed [m]."""
        ...


class Openable(Thing, Protocol):
    """A door or drawer on one joint."""

    @property
    def joint(self) -> str:
        """Name of its hinge [rad] or slide [m]; 0 is closed."""
        ...

    @property
    def closed_within(self) -> float:
        """Joint position below which there is no gap [rad or m]."""
        ...

    def format_position(self, position: float) -> str:
        """Write a joint position [rad or m] with a unit."""
        ...


class Latching(Openable, Protocol):
    """A door that may have a catch."""

    @property
    def catch(self) -> Engaging | None:
        """Mechanism that keeps it shut, or None."""
        ...


@predicate("{part} opened to {to:of part}")
def opened(world: World, part: Openable, *, to: float) -> bool:
    """Door or drawer is open to a position of its joint [rad or m], or further."""
    return world.joint(part.joint) >= to


@opened.approach
def _gap(world: World, part: Openable, *, to: float) -> float:
    return min(max(world.joint(part.joint) / to, 0.0), 1.0)


@predicate("{part} less open than {than:of part}")
def less_open(world: World, part: Openable, *, than: float) -> bool:
    """Door or drawer is not open as far as a position of its joint [rad or m]."""
    return world.joint(part.joint) < than


@predicate("{part} closed")
def closed(world: World, part: Openable) -> bool:
    """Door or drawer is closed without a gap."""
    return world.joint(part.joint) < part.closed_within


@closed.approach
def _shut(world: World, part: Openable) -> float:
    return math.exp(-max(world.joint(part.joint), 0.0) / _AJAR)


def latched(part: Latching) -> Predicate:
    """Door is closed without a gap, and its catch has dropped in.

    Raises:
        ValueError: If the door has no catch.
    """
    if part.catch is None:
        raise ValueError(f"{part.name} has no catch that could keep it shut")
    return _latched(part)


@predicate("{part} latched")
def _latched(world: World, part: Latching) -> bool:
    catch = part.catch
    shut = world.joint(part.joint) < part.closed_within
    return shut and catch is not None and world.joint(catch.joint) < catch.engaged_within


@predicate("{part} faster than {than:of part}/s")
def faster(world: World, part: Openable, *, than: float) -> bool:
    """Door or drawer has moved faster than a speed of its joint [rad/s or m/s], either way."""
    return world.joint_speed(part.joint) > than


@predicate("{bar} grasped")
def grasped(world: World, bar: Bar) -> bool:
    """Bar is between the pads: they are closed on it, it is where they are and keeps them apart.

    A closed fist touches a bar with both pads too: it is shut, and ahead of the bar. Fingers that
    are twisted about a bar until it jams are commanded wider than it is.
    """
    return (
        gripped(bar).holds(world)
        and world.commanded_opening < bar.diameter
        and world.gripper_opening > bar.diameter / 2
        and _distance(world, bar) < bar.diameter / 2
    )


@grasped.approach
def _near_bar(world: World, bar: Bar) -> float:
    return math.exp(-max(_distance(world, bar), 0.0) / REACH)


@predicate("hand {by:g} m clear of {bar}")
def clear_of(world: World, bar: Bar, *, by: float) -> bool:
    """Point between the pads is further than `by` metres from the surface of a bar."""
    return _distance(world, bar) > by


@predicate("hand {by:g} m above {bar}")
def above(world: World, bar: Bar, *, by: float) -> bool:
    """Point between the pads is more than `by` metres higher than the middle of a bar."""
    return bool(world.gripper.position_w[2] - world.frame(bar.name).position_w[2] > by)


def _distance(world: World, bar: Bar) -> float:
    """Return how far the point between the pads is from the surface of a bar [m]."""
    frame = world.frame(bar.name)
    offset = world.gripper.position_w - frame.position_w
    along = np.clip(offset @ frame.z_axis, -bar.length / 2, bar.length / 2)
    return float(np.linalg.norm(offset - along * frame.z_axis) - bar.diameter / 2)
