"""Places that a thing can be brought to: in the live world, relative to the robot or to a thing."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from labutopia_lerobot.world import BENCH, FloatArray, ReachedInto, Thing, World


class Destination(Protocol):
    """A point, and the body that a thing standing there stands on."""

    @property
    def name(self) -> str:
        """Its name in the name of a fact."""
        ...

    @property
    def support(self) -> str:
        """Contact name of what a thing standing there stands on."""
        ...

    def position_w(self, world: World) -> FloatArray:
        """Return where the centre of the base of the thing goes, shape (3,), metres, world."""
        ...


class Support(Thing, Protocol):
    """A thing with a level top that a vessel can stand on."""

    @property
    def top_height(self) -> float:
        """Height of the top above the origin [m]."""
        ...


@dataclass(frozen=True)
class OnTop:
    """The middle of the top of a thing.

    Attributes:
        of: The thing.
    """

    of: Support

    @property
    def name(self) -> str:
        return self.of.name

    @property
    def support(self) -> str:
        return self.of.name

    def position_w(self, world: World) -> FloatArray:
        """Return the middle of the top, shape (3,), metres, world frame."""
        pose = world.pose(self.of)
        return pose.position_w + self.of.top_height * pose.z_axis


@dataclass(frozen=True)
class OnShelf:
    """A place on a shelf inside something, wherever that stands.

    Attributes:
        name: How it is called in the name of a fact.
        shelf: The shelf; the frame of its name lies in the middle of its top, x away from the
            door, z up.
        inward: From the middle of the shelf away from the door [m].
        left: To the left of that, for who stands before the door [m].
    """

    name: str
    shelf: Thing
    inward: float = 0.0
    left: float = 0.0

    @property
    def support(self) -> str:
        return self.shelf.name

    def position_w(self, world: World) -> FloatArray:
        """Return the point, shape (3,), metres, world frame."""
        frame = world.frame(self.shelf.name)
        point: FloatArray = frame.position_w + frame.rotation_w @ (self.inward, self.left, 0.0)
        return point


class Seating(Destination, Protocol):
    """A destination with a frame of its name, such as that of an instrument (`Seat`)."""


@dataclass(frozen=True)
class BesideSeat:
    """A place as high as that of an instrument, and on the same ground, such as a basin's floor.

    Attributes:
        name: How it is called in the name of a fact.
        seat: The instrument's place.
        inward: From there away from the front of the instrument [m].
        left: To the left of that, for who stands before it [m].
    """

    name: str
    seat: Seating
    inward: float = 0.0
    left: float = 0.0

    @property
    def support(self) -> str:
        return self.seat.support

    def position_w(self, world: World) -> FloatArray:
        """Return the point, shape (3,), metres, world frame."""
        frame = world.frame(self.seat.name)
        point: FloatArray = frame.position_w + frame.rotation_w @ (self.inward, self.left, 0.0)
        return point


@dataclass(frozen=True)
class WhereItStood:
    """Place where a thing stood on the bench when the episode began.

    Attributes:
        thing: The thing.
    """

    thing: Thing

    @property
    def name(self) -> str:
        return f"where {self.thing.name} stood"

    @property
    def support(self) -> str:
        return BENCH

    def position_w(self, world: World) -> FloatArray:
        """Return the point, shape (3,), metres, world frame."""
        return world.stood(self.thing).position_w


@dataclass(frozen=True)
class OverBench:
    """A point on the bench or above it, as the robot sees it.

    Attributes:
        name: How it is called in the name of a fact.
        ahead: Distance straight ahead of the robot's base [m].
        left: Distance to the left of that [m].
        height: Height above the bench top [m].
    """

    name: str
    ahead: float
    left: float = 0.0
    height: float = 0.0

    @property
    def support(self) -> str:
        return BENCH

    def position_w(self, world: World) -> FloatArray:
        """Return the point, shape (3,), metres, world frame."""
        base = world.robot_base
        x, y, _ = base.position_w + self.ahead * base.x_axis + self.left * base.y_axis
        return np.array([x, y, world.bench_height + self.height])


def reached_at(world: World, thing: Thing) -> FloatArray:
    """Return where one reaches for a thing, shape (3,), metres, world frame.

    That is the middle of its opening, if one reaches into it, or its origin.
    """
    if not isinstance(thing, ReachedInto):
        return world.pose(thing).position_w
    frame = world.frame(thing.opening.frame)
    point: FloatArray = frame.position_w + frame.rotation_w @ thing.opening.at
    return point
