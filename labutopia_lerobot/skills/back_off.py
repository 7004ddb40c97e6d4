"""Drive straight back from a bench: to swing a door open before it, or to fold the arm up."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from labutopia_lerobot.navigation.docking import approach_to
from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.skills.face import INWARDS
from labutopia_lerobot.skills.handle import Operable
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.skills.way import Way, base_at, in_hand, parking, wheels_of
from labutopia_lerobot.world import FloatArray, Thing, World

_STEP = 0.05
"""Distances in which one looks whether there is room behind [m]; ours: that of cells of the map."""


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
        out = approach_to(way.planner, way.occupancy, way.footprint, position, yaw)
        free = float(np.hypot(*(out - position)))
        distance = room if self.to_open else free + room
        while free < distance and way.planner.free(position + (free + _STEP) * backwards):
            free += _STEP
        free = far = min(free, distance)
        while (
            not self.to_open
            and far < distance
            and way.footprint.fits(way.occupancy, position + (far + _STEP) * backwards, yaw)
        ):
            far += _STEP
        here = world.robot_base.inverse() @ world.gripper
        hand = in_hand(world, self.carrying)
        kept = hand.copy()
        kept["target"] = lambda world: world.robot_base @ here
        kept["opening"] = world.commanded_opening
        yield parking("back", Parking(position + far * backwards, yaw, way.limits), kept)
        if not self.to_open:
            yield Phase("stow", done=arrived(within=0.01), timeout_s=10.0, **hand)
        if far > free:
            end = self._aside(world, way, position + free * backwards, yaw)
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
