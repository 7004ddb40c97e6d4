"""A skill is a sequence of phases; a phase moves the gripper until a condition holds."""

import inspect
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.navigation.route import Route
from labutopia_lerobot.world import FloatArray, Pose, Thing, World

Target = Callable[[World], Pose]
"""Target pose of the gripper frame, computed from the live world."""

Condition = Callable[[World, Pose, float], bool]
"""Whether a phase is done: the world, the phase's present target, seconds in the phase."""


class PhaseError(UserError, ValueError):
    """A phase that cannot be played; the message names it, says what is wrong, and the cure."""


Drive = Callable[[World], FloatArray]
"""Wanted velocity of a mobile base, in its own frame, shape (3,) [m/s, m/s, rad/s]."""


@dataclass(frozen=True)
class Phase:
    """One state of the machine: the hand moves to `target` in a straight line until `done`.

    Attributes:
        name: A verb; appears in the dataset's phase labels.
        target: Wanted pose of the gripper frame, asked for at every control step: it may follow
            a thing.
        opening: Commanded distance between the pads [m], from 0 to `world.robot.max_opening`.
        done: Condition that ends the phase, of the world, the present target and the seconds in
            the phase; asked at every control step.
        touches: Names of things (`frozenset({"jar"})`), or `bench`, that the hand, or what it
            holds, may touch meanwhile; the expert steers clear of all others. The arm may touch
            nothing.
        holds: The thing in the gripper, which is kept clear of obstacles too.
        speed: Greatest speed of the gripper frame [m/s].
        turn_speed: Greatest angular speed of the gripper frame [rad/s].
        timeout_s: The phase has failed after this long [s].
        may_fail: The phase then ends as if it were done, and the skill decides what follows.
        drive: Velocity of the base, asked for once at every control step; None where it stands. The
            hand is carried along: a target that is to stay with the base follows
            `world.robot_base`.
        routes: Routes that it drives, the present one last; it grows where one is planned anew.

    Raises:
        PhaseError: If `target` or `done` cannot be called like that.
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
    drive: Drive | None = None
    routes: Sequence[Route] = ()

    def __post_init__(self) -> None:
        self._require_callable("target", "(world)")
        self._require_callable("done", "(world, target, seconds)")

    def _require_callable(self, part: str, arguments: str) -> None:
        function = getattr(self, part)
        try:
            inspect.signature(function).bind(*arguments.split(","))
        except TypeError:
            raise PhaseError(
                f"Phase '{self.name}': its {part} must be a function of {arguments}, "
                f"not {function!r}"
            ) from None


@runtime_checkable
class Skill(Protocol):
    """Something an expert can do: whatever has `phases`, such as a frozen dataclass."""

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield the phases in order; what follows a `yield` is run when that phase is done.

        The world is then the world of that moment.
        """
        ...


def at(pose: Pose) -> Target:
    """A target that stays where it is."""
    return lambda world: pose


def arrived(within: float, within_rad: float = 0.05) -> Condition:
    """Gripper is within a distance [m] and an angle [rad] of the target."""
    return lambda world, target, _: (
        world.gripper.distance_to(target) < within and world.gripper.angle_to(target) < within_rad
    )


def settled(within: float, within_rad: float = 0.05) -> Condition:
    """Gripper has arrived, as of `arrived`, and stayed until its robot's hand swings no more."""
    there, since = arrived(within, within_rad), 0.0

    def condition(world: World, target: Pose, elapsed: float) -> bool:
        nonlocal since
        if not there(world, target, elapsed):
            since = elapsed
            return False
        return elapsed - since >= world.robot.settling

    return condition


def waited(seconds: float) -> Condition:
    """The phase has lasted this long."""
    return lambda world, target, elapsed: elapsed >= seconds


def carrier(world: World, thing: Thing) -> Callable[[Pose], Pose]:
    """Return the map from a wanted pose of a held thing to the gripper pose that puts it there."""
    gripper_in_thing = world.pose(thing).inverse() @ world.gripper
    return lambda wanted: wanted @ gripper_in_thing
