"""A skill is a sequence of phases; a phase moves the gripper until a condition holds."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from labutopia_lerobot.world import Pose, Thing, World

Target = Callable[[World], Pose]
"""Where the gripper frame should go, from the live world."""

Condition = Callable[[World, Pose, float], bool]
"""Whether a phase is done: the world, the phase's present target, seconds in the phase."""


@dataclass(frozen=True)
class Phase:
    """One state of the machine.

    Attributes:
        name: A verb; appears in the dataset's phase labels.
        target: Wanted pose of the gripper frame.
        opening: Commanded distance between the pads [m].
        done: Condition that ends the phase.
        touches: Names of things that the hand, or what it holds, may touch meanwhile.
        holds: The thing in the gripper, which is kept clear of obstacles too.
        speed: Greatest speed of the gripper frame [m/s].
        turn_speed: Greatest angular speed of the gripper frame [rad/s].
        timeout_s: The phase has failed after this long [s].
        may_fail: The phase then ends as if it were done, and the skill decides what follows.
    """

    name: str
    target: Target
    opening: float
    done: Condition
    touches: frozenset[str] = frozenset()
    holds: Thing | None = None
    speed: float = 0.25
    turn_speed: float = 1.5
    timeout_s: float = 6.0
    may_fail: bool = False


@runtime_checkable
class Skill(Protocol):
    """Something an expert can do.

    `phases` is a generator that the expert advances when a phase is done, so code between two
    yields sees the world as it is then.
    """

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield the phases in order."""
        ...


def arrived(within: float, within_rad: float = 0.05) -> Condition:
    """Gripper is within a distance [m] and an angle [rad] of the target."""
    return lambda world, target, _: (
        world.gripper.distance_to(target) < within and world.gripper.angle_to(target) < within_rad
    )


def waited(seconds: float) -> Condition:
    """The phase has lasted this long."""
    return lambda world, target, elapsed: elapsed >= seconds


def carrier(world: World, thing: Thing) -> Callable[[Pose], Pose]:
    """Return the map from a wanted pose of a held thing to the gripper pose that puts it there."""
    gripper_in_thing = world.pose(thing).inverse() @ world.gripper
    return lambda wanted: wanted @ gripper_in_thing
