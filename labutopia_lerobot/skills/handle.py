"""Moving a door or drawer by its handle.

The phases of the paper's "Open" and "Close" (appendix, "Task Details") differ only in where they
go: approach the handle, grip it, move along the joint, check that the target is reached and go on
if not, pause, release, leave.
"""

import math
from collections.abc import Iterator
from typing import Protocol, runtime_checkable

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from labutopia_lerobot.predicates import grasped
from labutopia_lerobot.predicates.openables import Bar, Openable
from labutopia_lerobot.skills.skill import Condition, Phase, Target, arrived, waited
from labutopia_lerobot.world import Pose, World

_OPENING = 0.05
"""Distance between the pads around a bar [m]: keeps the outer finger 2 cm off the door."""
_NARROW = 0.040
"""The same for a hand that keeps its heading, and is aslant to the open door [m]."""
_BEYOND = 0.009
"""Distance by which the finger tips get beyond the middle of a bar [m]; ours: farther, those of a
hand that keeps its heading would meet the door."""
_SQUEEZE = 0.012
"""Amount by which the closed gripper is commanded narrower than the bar [m]: the full force."""
_STANDOFF = 0.10
"""Distance at which the last approach starts and the hand's retreat ends [m] (original: 0.08)."""
_TURNED_BACK = 0.4
"""Share of what the hand has turned with a door that it turns back as it leaves: beside a door that
is open it points at the robot, and the wrist behind it soon has no arm left to back away."""
_LEAD = 0.03
"""Lead of the commanded hand over the handle [m]: chords of an arc pull the hand inwards, by
0.3 mm here; by 1.5 mm at 0.05 m, which took up to 66 % of a wrist's torque, and no less time."""
_LITTLE_LEAD = 0.02
"""The same for a hand that keeps its heading: what strays from the arc pulls at one finger."""
_YIELD = 0.8
"""Share of what the bar has rolled along the pads that such a hand lets be. It rolls as the hand
turns about it; an arm that pushed back jams it until one finger opens."""


class Jointed(Protocol):
    """Something on one joint."""

    @property
    def joint(self) -> str:
        """Name of its hinge [rad] or slide [m]."""
        ...

    def carried(self, pose: Pose, world: World, by: float) -> Pose:
        """Return where something fixed to it gets when its joint moves on [rad or m]."""
        ...


class Operable(Openable, Jointed, Protocol):
    """A door or drawer with a handle, whose frame has its x axis into the door or drawer."""

    @property
    def handle(self) -> Bar:
        """The part to hold it by."""
        ...


@runtime_checkable
class Turning(Bar, Jointed, Protocol):
    """A handle that must be turned before the door opens."""

    @property
    def turn(self) -> float:
        """Angle to turn it by [rad]."""
        ...


def move_by_handle(
    part: Operable, world: World, to: float, reached: Condition, heading: float | None = None
) -> Iterator[Phase]:
    """Yield approach, reach, settle, grip, turn where that must be, move, pause, release and leave.

    While it moves, the hand is carried along with the handle: along an arc about the hinge, with
    its orientation turned by the same angle (spherical linear interpolation), or straight. A hand
    with a heading keeps that instead, and an upright bar turns between its fingers: beyond about
    60 degrees no arm follows a door from outside.

    Args:
        part: The door or drawer.
        world: The world.
        to: Joint position to move to [rad or m].
        reached: When that is near enough.
        heading: Where the hand points all the while, to the left of straight ahead of the robot
            [rad]; None for a hand that is carried along.
    """
    handle = part.handle
    opening = _OPENING if heading is None else _NARROW
    touches = frozenset({handle.name})
    shut = max(0.0, handle.diameter - _SQUEEZE)
    held = grasped(handle)
    yield Phase(
        "approach",
        lambda w: _grasp(handle, w, heading).advanced(-_STANDOFF),
        opening,
        arrived(0.01, 0.1),
    )
    yield Phase(
        "reach", lambda w: _grasp(handle, w, heading), opening, arrived(0.004), touches, speed=0.15
    )
    here = _grasp(handle, world, heading)
    yield Phase("settle", lambda w: here, opening, waited(0.2), touches)
    yield Phase(
        "grip",
        lambda w: here,
        shut,
        lambda w, target, elapsed: elapsed > 0.3 and held.holds(w),
        touches,
        timeout_s=2.0,
    )
    if isinstance(handle, Turning):
        lever, enough = handle, 0.95 * handle.turn
        turning = _onward(handle, lever, lever.turn, world)
        yield Phase(
            "turn",
            turning,
            shut,
            lambda w, target, elapsed: w.joint(lever.joint) > enough,
            touches,
            speed=0.15,
        )
    onward = _onward(handle, part, to, world, turning=heading is None)
    yield Phase("move", onward, shut, reached, touches, speed=0.15, timeout_s=10.0)
    yield Phase("pause", onward, shut, waited(0.3), touches)
    there = onward(world)  # still against the stop: a hand that gave way would drag the bar along
    yield Phase("release", lambda w: there, opening, waited(0.5), touches)
    away = _turned_back(there.advanced(-_STANDOFF), here)
    yield Phase(
        "leave",
        lambda w: away,
        opening,
        arrived(0.01, 0.1),
        touches,
        timeout_s=2.0,
        may_fail=True,  # an arm that is stretched beside the open door gets less far: far enough
    )


def _onward(handle: Bar, part: Jointed, to: float, world: World, *, turning: bool = True) -> Target:
    """Return where the hand on a handle would be once a joint has moved on, by `_LEAD` at most.

    It turns with the handle, or keeps the orientation that it has.
    """
    hand, lead = world.gripper, _LEAD if turning else _LITTLE_LEAD
    in_hand = world.frame(handle.name).inverse() @ hand

    def target(world: World) -> Pose:
        bar = world.frame(handle.name)
        way = to - world.joint(part.joint)
        moved = part.carried(bar, world, way)
        distance = bar.distance_to(moved)
        if distance > lead:
            moved = part.carried(bar, world, way * lead / distance)
        if turning:
            return moved @ in_hand
        rolled = world.gripper.position_w - bar.position_w
        return Pose(moved.position_w + _YIELD * rolled, hand.rotation_w)

    return target


def _turned_back(pose: Pose, before: Pose) -> Pose:
    """Return a pose turned towards an earlier one, by `_TURNED_BACK` of the angle between them."""
    turns = Rotation.from_matrix(np.stack([pose.rotation_w, before.rotation_w]))
    return Pose(pose.position_w, Slerp((0.0, 1.0), turns)(_TURNED_BACK).as_matrix())


def _grasp(handle: Bar, world: World, heading: float | None) -> Pose:
    """Gripper pose around the bar: as the robot reaches it, the fingers closing across the bar."""
    frame, approach = world.frame(handle.name), world.robot.handle_approach
    up = np.array([0.0, 0.0, 1.0])
    if heading is None:
        ahead, yaw = frame.x_axis, approach.yaw
    else:
        ahead, yaw = world.robot_base.x_axis, heading
    level = math.cos(yaw) * ahead + math.sin(yaw) * np.cross(up, ahead)
    forward = math.cos(approach.pitch) * level - math.sin(approach.pitch) * up
    across = np.cross(forward, frame.z_axis)
    across /= np.linalg.norm(across)
    pose = Pose(frame.position_w, np.column_stack([np.cross(across, forward), across, forward]))
    return pose.advanced(_BEYOND - world.robot.finger_reach)
