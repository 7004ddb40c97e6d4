"""What skills that drive share: where the base is, how fast it goes, which place suits a thing."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypedDict

import numpy as np

from labutopia_lerobot.navigation.docking import FloorRectangle, approach_to
from labutopia_lerobot.navigation.occupancy import Occupancy
from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.navigation.path import DrivingLimits, Path
from labutopia_lerobot.navigation.path_planner import RADIUS, PathPlanner
from labutopia_lerobot.navigation.route import Route
from labutopia_lerobot.places import reached_at
from labutopia_lerobot.skills.posture import FROM_ABOVE, pointing
from labutopia_lerobot.skills.skill import Phase, PhaseError, Target
from labutopia_lerobot.world import (
    Dock,
    FloatArray,
    Obstacle,
    Pose,
    ReachedInto,
    Thing,
    Wheels,
    World,
)

_SHARE = 0.6
"""Share of the base's speeds and accelerations that experts use; ours: what is in a beaker stays
there."""
INWARDS = 0.4
"""Share of the base's speeds with which it goes in; ours: centimetres before furniture."""
CLEAR_OF_PEOPLE = 0.10
"""Distance from a person that is kept beyond both discs [m]; ours: a hand's breadth."""
AT_REST = 0.01
"""Speed below which the base stands [m/s and rad/s]; ours."""
STRAIGHT = 0.015
"""How near its heading comes [rad]; ours: 8 mm at the end of an arm."""


@dataclass(frozen=True)
class Way:
    """A base in a room: map, limits, and how it drives there.

    Attributes:
        occupancy: Map of the room.
        planner: Plans over it for the paper's disc.
        footprint: Of the base.
        limits: How fast it is to go.
        from_above: Whether it goes to where things are taken from above.
    """

    occupancy: Occupancy
    planner: PathPlanner
    footprint: FloorRectangle
    limits: DrivingLimits
    from_above: bool = False

    @classmethod
    def of(
        cls,
        world: World,
        share: float = _SHARE,
        radius: float = RADIUS,
        *,
        from_above: bool = False,
    ) -> "Way":
        """Return that of a world.

        Args:
            world: Its robot has a base.
            share: Of the base's speeds and accelerations.
            radius: Distance that the middle of the base keeps from everything [m].
            from_above: Whether it is to go to where things are taken from above.
        """
        floor, wheels = world.floor, wheels_of(world)
        pace = wheels.limits
        limits = DrivingLimits(
            share * pace.speed,
            share * pace.acceleration,
            share * pace.turning,
            share * pace.turning_acceleration,
            pace.sideways,
        )
        known = Occupancy(floor.cells, floor.origin, floor.resolution)
        standing = [thing for thing in world.in_the_way if not thing.walks]
        occupancy = _with(known, world, standing, 0.0) if standing else known
        planner = PathPlanner.of(occupancy, limits, radius)
        return cls(occupancy, planner, FloorRectangle(*wheels.size), limits, from_above)

    def round(self, world: World, others: Sequence[Obstacle], *, tight: bool = False) -> "Way":
        """Return the way round others where they are now.

        Args:
            world: Where they are.
            others: What walks.
            tight: Whether the paper's disc may be as near to everything as a map says.
        """
        room = 0.0 if tight else 2.0 * CLEAR_OF_PEOPLE
        occupancy = _with(self.occupancy, world, others, room)
        radius = RADIUS if tight else self.planner.clearance.radius
        planner = PathPlanner.of(occupancy, self.limits, radius)
        return replace(self, occupancy=occupancy, planner=planner)

    def route(
        self, world: World, thing: Thing, around: Sequence[Obstacle] = (), *, tight: bool = False
    ) -> Route:
        """Return the route from where a base is now to the bench of a thing.

        Args:
            world: Where the base is.
            thing: What to drive to.
            around: Who walks, and is to be gone round.
            tight: As in `round`.

        Raises:
            BlockedPlaceError: If the base is where its disc touches something.
            UnreachableGoalError: If no way leads there.
            PhaseError: If the thing is within reach of no place.
        """
        dock = dock_for(world, thing, from_above=self.from_above)
        free = self.round(world, around, tight=tight) if around else self
        path = free.path(base_at(world)[0], self.before(dock))
        return Route(world.time, thing, tuple(around), path, dock)

    def turns_at(self, point: FloatArray) -> bool:
        """Return whether the base can turn all round at a point, shape (2,) [m], world frame."""
        return self.planner.free(point) and self.footprint.turns(self.planner.clearance, point)

    def before(self, dock: Dock) -> FloatArray:
        """Return the point straight behind a dock to which this base drives, shape (2,) [m].

        Raises:
            BlockedPlaceError: If there is none.
        """
        if self.planner.clearance.radius == RADIUS:
            return dock.before
        return approach_to(self.planner, self.occupancy, self.footprint, dock.position, dock.yaw)

    def path(self, start: FloatArray, goal: FloatArray) -> Path:
        """Return the path from a point to another, both of shape (2,) [m], world frame.

        Where the base has stopped short of where the disc has room, it may leave so near to things.
        """
        return self._leaving(start).plan(start, goal)

    def shortest(self, start: FloatArray, goal: FloatArray) -> Path:
        """Return the shortest such path, however near it comes to things."""
        return self._leaving(start).shortest(start, goal)

    def _leaving(self, start: FloatArray) -> PathPlanner:
        return replace(self.planner, clearance=self.planner.clearance.leaving(start))


def _with(known: Occupancy, world: World, others: Iterable[Obstacle], room: float) -> Occupancy:
    """Return a map with others on it, each as wide as it is and so much more [m]."""
    occupancy = known.copy()
    for other in others:
        occupancy.add_disc(world.pose(other).position_w[:2], other.footprint_radius + room)
    return occupancy


def wheels_of(world: World) -> Wheels:
    """Return the base of the robot.

    Raises:
        PhaseError: If it has none.
    """
    if world.robot.base is None:
        raise PhaseError("A skill drives, but the robot has no base: choose one that has")
    return world.robot.base


def base_at(world: World) -> tuple[FloatArray, float]:
    """Return where the middle of the base is, shape (2,) [m], and its heading [rad], world."""
    base = world.mobile_base
    assert base is not None
    return base.position_w[:2], math.atan2(base.x_axis[1], base.x_axis[0])


def dock_for(world: World, thing: Thing, *, from_above: bool = False) -> Dock:
    """Return the place at a bench from which the arm reaches a thing best.

    Args:
        world: Where the thing is.
        thing: What to reach.
        from_above: Whether it is to be taken from above.

    Raises:
        PhaseError: If there is none: nobody can drive there.
    """
    point, wheels = reached_at(world, thing)[:2], wheels_of(world)
    base = world.mobile_base
    assert base is not None
    arm, _, _ = (base.inverse() @ world.robot_base).position_w
    if isinstance(thing, ReachedInto):
        best = world.floor.dock_at(point, arm, thing.opening.ahead, reaching_in=True)
    else:
        near, far = wheels.ahead
        best = world.floor.dock_at(point, arm, (near, wheels.above if from_above else far))
    if best is None:
        raise PhaseError(
            f"No place at a bench of the room from which '{thing.name}' is within reach can be "
            "driven to"
        )
    return best


def stowed(world: World) -> Pose:
    """Return where the hand is while the robot drives."""
    return world.robot_base @ world.stowed_hand


def _stowed_down(world: World) -> Target:
    """Return the same for a hand that points down, and would tip what it holds from above.

    Its back is ahead or behind, whichever is nearer now.
    """
    ahead = float((world.robot_base.inverse() @ world.gripper).x_axis[0])
    hand = pointing(world.stowed_hand.position_w, 0.0 if ahead > 0.0 else math.pi, FROM_ABOVE.pitch)
    return lambda world: world.robot_base @ hand


class InHand(TypedDict):
    """What phases say of the hand while the robot drives."""

    target: Target
    opening: float
    touches: frozenset[str]
    holds: Thing | None


def in_hand(world: World, thing: Thing | None) -> InHand:
    """Return what phases say of the hand that holds a thing, or nothing."""
    if thing is None:
        wide = world.robot.max_opening
        return InHand(target=stowed, opening=wide, touches=frozenset(), holds=None)
    down = world.gripper.z_axis[2] < -math.cos(math.pi / 4)
    return InHand(
        target=_stowed_down(world) if down else stowed,
        opening=world.commanded_opening,
        touches=frozenset({thing.name}),
        holds=thing,
    )


def parking(name: str, way: Parking, hand: InHand) -> Phase:
    """Return the phase in which the base goes straight to a place and stops there, arm stowed."""

    def there(world: World, target: Pose, elapsed: float) -> bool:
        still = bool(np.abs(world.base_velocity).max() < AT_REST)
        return still and way.arrived(*base_at(world), within=way.near, within_rad=STRAIGHT)

    return Phase(
        name,
        done=there,
        drive=lambda world: way.velocity(*base_at(world)),
        timeout_s=15.0,
        **hand,
    )
