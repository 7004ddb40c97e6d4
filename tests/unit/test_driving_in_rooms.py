"""A robot that drives in furnished rooms: maps are where things are, and things are solid."""

import math

import mujoco
import numpy as np
import pytest

from furnished_plans import BRIGHT, PARTED
from labutopia_lerobot.navigation.occupancy import FREE, HIGHEST, LOWEST, OCCUPIED, Occupancy
from labutopia_lerobot.navigation.path_planner import PathPlanner
from labutopia_lerobot.navigation.tracking import PathTracker
from labutopia_lerobot.robots import PANDA, RIDGEBACK_PANDA
from labutopia_lerobot.robots.action_filter import ActionFilter
from labutopia_lerobot.robots.command_limits import CommandLimits
from labutopia_lerobot.robots.hand_kinematics import HandKinematics
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.scenes import LABORATORY, Room
from labutopia_lerobot.scenes.furnished_room import furnished_room
from labutopia_lerobot.scenes.plans import load_plan
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene, scene_spec
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

ROOMS = {
    "facing east": furnished_room(BRIGHT),
    "facing north": furnished_room(PARTED),
    "facing west": furnished_room(load_plan("organic_7")),
    "laboratory": LABORATORY,
}
BASE = RIDGEBACK_PANDA.roles.base


class Drive:
    """A robot in a room, whose base is bidden velocities, within its limits."""

    def __init__(self, room: Room) -> None:
        scene = compile_scene([], RIDGEBACK_PANDA, room, VESSEL_VIEW)
        self.simulation = Simulation(scene)
        self.world = SimulatedWorld(self.simulation)
        self.filter = ActionFilter(RIDGEBACK_PANDA, HandKinematics(scene.model, RIDGEBACK_PANDA))
        self._limits = CommandLimits(RIDGEBACK_PANDA, 0.85)
        self.simulation.reset({})
        self.filter.start(self.simulation.command)
        self.touched: set[str] = set()

    @property
    def position(self) -> FloatArray:
        position: FloatArray = self.simulation.base_pose[:2]
        return position

    @property
    def yaw(self) -> float:
        return float(self.simulation.base_pose[2])

    def go(self, velocity: FloatArray, steps: int = 1) -> None:
        """Drive at a velocity, base frame, as soon as the limits allow it."""
        for _ in range(steps):
            before, last = self.simulation.commands[-2:]
            gap = np.zeros_like(last)
            gap[BASE] = velocity - last[BASE]
            change = np.clip(self._limits.closing(gap), *self._limits.changes(before, last))
            action = (last + change).astype(np.float32)
            self.simulation.step(self.filter(action, self.simulation.commands))
            for part in ("base", "arm", "hand"):
                others = {"base", "arm", "hand", "left_pad", "right_pad"}
                self.touched |= self.world.touched_by(part) - others


def solids(room: Room) -> FloatArray:
    """Return the boxes around what a base can touch in a room: low and high corners, (n, 2, 3)."""
    model = scene_spec([], RIDGEBACK_PANDA, room, VESSEL_VIEW).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    robot = model.body(RIDGEBACK.body).id
    found = []
    for geom in range(model.ngeom):
        body = model.geom_bodyid[geom]
        plane = model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE
        if model.body_rootid[body] == model.body_rootid[robot] or plane:
            continue
        if not model.geom_contype[geom] and not model.geom_conaffinity[geom]:
            continue
        turn = np.abs(data.geom_xmat[geom].reshape(3, 3))
        half = turn @ (np.abs(model.geom_aabb[geom, :3]) + model.geom_aabb[geom, 3:])
        found.append([data.geom_xpos[geom] - half, data.geom_xpos[geom] + half])
    return np.array(found)


def covered(occupancy: Occupancy, boxes: FloatArray, wider: float) -> np.ndarray:
    """Return which cells have their middles in boxes that are wider by a length, as flags."""
    flags = np.zeros(occupancy.cells.shape, bool)
    middles = occupancy.middles(np.ones_like(flags))
    for low, high in boxes:
        if high[2] > LOWEST and low[2] < HIGHEST:
            inside = (middles > low[:2] - wider) & (middles < high[:2] + wider)
            flags |= inside.all(axis=1).reshape(flags.shape)
    return flags


@pytest.mark.parametrize("room", ROOMS.values(), ids=ROOMS)
def test_the_map_is_occupied_where_things_are_and_nowhere_else(room):
    occupancy, boxes = room.map(), solids(room)
    surely = covered(occupancy, boxes, -2.5 * occupancy.resolution)
    perhaps = covered(occupancy, boxes, 2.5 * occupancy.resolution)
    assert surely.sum() > 100
    assert (occupancy.cells[surely] == OCCUPIED).mean() > 0.98
    assert perhaps[occupancy.cells == OCCUPIED].mean() > 0.98


def test_an_arm_on_a_stand_is_in_the_same_room_as_ever():
    room = ROOMS["facing east"]
    spec = scene_spec([], PANDA, room, VESSEL_VIEW)
    assert spec.body("room_hood") is None
    assert spec.body("pedestal") is not None
    driven = scene_spec([], RIDGEBACK_PANDA, room, VESSEL_VIEW)
    assert driven.body("room_hood") is not None
    assert driven.body("pedestal") is None


def test_it_drives_through_a_furnished_room_along_a_path_and_touches_nothing():
    room = ROOMS["facing west"]
    drive, occupancy = Drive(room), room.map()
    planner = PathPlanner.of(occupancy, RIDGEBACK.limits, RIDGEBACK.radius)
    while not planner.free(drive.position):  # it stands at the bench, within its own radius
        drive.go(np.array([-0.25, 0.0, 0.0]))
    drive.go(np.zeros(3), steps=15)
    goal = np.array([-6.0, 0.6])  # on the far side of the island
    path = planner.plan(drive.position, goal)
    assert path.length > 5.0
    tracker, off, steps = PathTracker(path, RIDGEBACK.limits), 0.0, 0
    while not tracker.arrived(drive.position, within=0.03):
        drive.go(tracker.velocity(drive.position, drive.yaw))
        off = max(off, float(np.hypot(*(path.points - drive.position).T).min()))
        steps += 1
        assert steps < 60 * CONTROL_HZ
    assert off < 0.04
    assert steps / CONTROL_HZ < 2.0 * path.duration(RIDGEBACK.limits)
    assert drive.filter.clipped == 0
    assert not drive.touched
    ahead = path.direction(path.length)
    assert abs(math.remainder(drive.yaw - math.atan2(ahead[1], ahead[0]), 2 * math.pi)) < 0.2


def test_a_base_is_stopped_by_furniture_that_no_task_names():
    drive = Drive(ROOMS["facing west"])
    drive.go(np.array([-0.25, 0.0, 0.0]), steps=CONTROL_HZ)
    drive.go(np.array([0.0, -0.5, 0.0]), steps=3 * CONTROL_HZ)
    assert not drive.touched
    drive.go(np.array([-0.3, 0.0, 0.0]), steps=3 * CONTROL_HZ)  # backwards, into the island
    stopped = drive.position.copy()
    drive.go(np.array([-0.3, 0.0, 0.0]), steps=CONTROL_HZ)
    assert np.hypot(*(drive.position - stopped)) < 0.02
    assert drive.touched == {"room_island_bench_1"}
    edge = drive.position[0] - RIDGEBACK.size[0] / 2
    occupancy = drive.simulation.scene.room.map()
    assert occupancy.cells[occupancy.cell(edge - 0.1, drive.position[1])] == OCCUPIED
    assert occupancy.cells[occupancy.cell(edge + 0.1, drive.position[1])] == FREE
