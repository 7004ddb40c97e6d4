"""Drive straight back from a bench: to swing a door open before it, or to fold the arm up."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.navigation.docking import approach_to
from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.navigation.path_planner import BlockedPlaceError
from labutopia_lerobot.skills.handle import Operable
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.skills.way import INWARDS, Way, base_at, in_hand, parking, wheels_of
from labutopia_lerobot.world import FloatArray, Thing, World

_STEP = 0.05
"""Distances in which one looks whether there is room behind [m]; ours: that of cells of the map."""

_FINE = 0.01
"""The same where an aisle is hardly as wide as the disc [m]; ours."""


@dataclass(frozen=True)
class BackOff:
    """Back off from the bench before the robot, the hand carried along as it is.

    An arm that folds badly opens a door from farther off than it reaches in from. And where things
    stand close round an arm, beside a door that is open or in a sink, it is out of them before it
    is stowed.

    Attributes:
        carrying: Thing in the hand, if any.
        to_open: Whether it goes only as far as this robot needs to open a door. Otherwise it goes
            to where it can turn, farther by as much, and stows its arm. Where a bench behind leaves
            no room for that to its disc, but to its footprint, it comes forth again after.
        past: An open door that stands out beside it: coming forth, a base that goes sideways leaves
            that farther aside, where there is room.
    """

    carrying: Thing | None = None
    to_open: bool = False
    past: Operable | None = None

    def phases(self, world: World) -> Iterator[Phase]:
        """Yield back (unless it stands right), stow, and forth (if it cannot turn there)."""
        room = wheels_of(world).door_room
        if self.to_open and room == 0.0:
            return
        way, (position, yaw) = Way.of(world, INWARDS), base_at(world)
        backwards = -np.array([math.cos(yaw), math.sin(yaw)])

        def fits(distance: float) -> bool:
            return way.footprint.fits(way.occupancy, position + distance * backwards, yaw)

        def free(distance: float) -> bool:
            return way.planner.free(position + distance * backwards)

        here = world.robot_base.inverse() @ world.gripper
        hand = in_hand(world, self.carrying)
        kept = hand.copy()
        kept["target"] = lambda world: world.robot_base @ here
        kept["opening"] = world.commanded_opening
        turning = 0.0 if self.to_open else _turning(way, position, yaw, room)
        near = _farthest(free, turning, turning + room)
        far = _farthest(fits, 0.0 if self.to_open else max(near, 0.0), max(turning, 0.0) + room)
        yield parking("back", Parking(position + far * backwards, yaw, way.limits), kept)
        if self.to_open:
            return
        yield Phase("stow", done=arrived(within=0.01), timeout_s=10.0, **hand)
        if far > near:
            end = self._aside(world, way, position + near * backwards, yaw)
            yield parking("forth", Parking(end, yaw, way.limits), hand)

    def _aside(self, world: World, way: Way, point: FloatArray, yaw: float) -> FloatArray:
        """Return a point beside another where the disc can be, away from what stands out."""
        if self.past is None or not way.limits.sideways:
            return point
        left = np.array([-math.sin(yaw), math.cos(yaw)])
        out = world.frame(self.past.handle.name).position_w[:2]
        step = -math.copysign(_STEP, float((out - point) @ left)) * left
        steps, most = 0, round(wheels_of(world).door_room / _STEP)
        while steps < most and way.planner.free(point + (steps + 1) * step):
            steps += 1
        return point + steps * step


def _farthest(possible: Callable[[float], bool], begin: float, end: float) -> float:
    """Return how far one gets from one distance towards another, both [m]."""
    distance = begin
    while distance < end and possible(min(distance + _STEP, end)):
        distance = min(distance + _STEP, end)
    return distance


def _turning(way: Way, position: FloatArray, yaw: float, room: float) -> float:
    """Return how far behind a place the base can turn [m]; negative is before it, so far at most.

    Raises:
        BlockedPlaceError: If it can nowhere.
    """
    try:
        out = approach_to(way.planner, way.occupancy, way.footprint, position, yaw)
    except BlockedPlaceError:
        ahead = np.array([math.cos(yaw), math.sin(yaw)])
        for distance in np.arange(0.0, room, _FINE):
            if way.planner.free(position + distance * ahead):
                return -float(distance)
        raise
    return float(np.hypot(*(out - position)))
