"""The planar laser scanner of a base, against the geometry of a room with four walls and a post."""

import math
from typing import Any, cast

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.robots import load_robot
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.sim.laser_scan import LaserScan
from labutopia_lerobot.sim.scene import ROBOT_MOUNT, Scene, set_options
from labutopia_lerobot.world.model import COLLISION_GROUP, VISUAL_GROUP

WEST, EAST, SOUTH, NORTH = -3.0, 5.0, -2.0, 14.0
POST, RADIUS = np.array([1.6, 0.9]), 0.2
HERE = np.array([0.4, -0.3, 0.7])
"""Where the base is: x, y [m] and heading [rad]."""


def scene(robot_name: str) -> Scene:
    """Return a robot between walls, with a post, a ghost that is not drawn, and a long nose."""
    spec, robot = mujoco.MjSpec(), load_robot(robot_name)
    assert robot.base is not None
    set_options(spec)
    robot.add_to(spec, spec.worldbody.add_body(name=ROBOT_MOUNT))
    box, cylinder = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CYLINDER

    def add(body: mujoco.MjsBody, shape: Any, pos: Any, size: Any, group: int) -> None:
        body.add_geom(type=shape, pos=pos, size=size, group=group, contype=0, conaffinity=0)

    for x in (WEST - 0.1, EAST + 0.1):
        add(spec.worldbody, box, (x, 6.0, 0.5), (0.1, 12.0, 0.5), VISUAL_GROUP)
    for y in (SOUTH - 0.1, NORTH + 0.1):
        add(spec.worldbody, box, (1.0, y, 0.5), (12.0, 0.1, 0.5), VISUAL_GROUP)
    add(spec.worldbody, cylinder, (*POST, 0.5), (RADIUS, 0.5, 0.0), VISUAL_GROUP)
    add(spec.worldbody, box, (-0.8, -0.3, 0.5), (0.1, 0.1, 0.5), COLLISION_GROUP)
    nose = spec.body(robot.base_body)
    up = robot.base.scanner.place[2] - robot.base.arm[2]
    add(nose, box, (0.7, 0.0, up), (0.05, 0.5, 0.05), VISUAL_GROUP)
    groups = np.empty(0, np.intp)
    pieces: tuple[Piece, ...] = ()
    return Scene(spec.compile(), robot, LABORATORY, pieces, (), (), groups, {}, 1, None)


def expected(start: NDArray[np.float64], angle: float, farthest: float) -> float:
    """Return how far a point is from walls and post along a ray."""
    ray = np.array([math.cos(angle), math.sin(angle)])
    with np.errstate(divide="ignore"):
        x = ((EAST if ray[0] > 0 else WEST) - start[0]) / ray[0]
        y = ((NORTH if ray[1] > 0 else SOUTH) - start[1]) / ray[1]
    away = POST - start
    along, aside = float(away @ ray), abs(float(away[0] * ray[1] - away[1] * ray[0]))
    post = along - math.sqrt(RADIUS**2 - aside**2) if along > 0 and aside < RADIUS else math.inf
    return min(x, y, post, farthest)


@pytest.mark.parametrize("robot", ["ridgeback_panda", "fetch"])
def test_it_sees_walls_and_a_post_and_no_part_of_the_robot(robot: str) -> None:
    room = scene(robot)
    base = room.robot.base
    assert base is not None
    data = mujoco.MjData(room.model)
    for joint, value in zip(base.joints, HERE, strict=True):
        data.joint(joint).qpos = value
    mujoco.mj_kinematics(room.model, data)
    seen = LaserScan(room, base.scanner).ranges(data)
    c, s = math.cos(HERE[2]), math.sin(HERE[2])
    ahead, left, _ = base.scanner.place
    start = HERE[:2] + np.array([c * ahead - s * left, s * ahead + c * left])
    wanted = [expected(start, HERE[2] + a, base.scanner.farthest) for a in base.scanner.angles]
    assert seen.shape == (base.scanner.beams,)
    assert np.abs(seen - wanted).max() < 2e-3  # rays that graze the post
    assert np.median(np.abs(seen - wanted)) < 1e-5
    nowhere = [wall for wall in wanted if wall == base.scanner.farthest]
    assert bool(nowhere) == (robot == "ridgeback_panda")  # that of the Fetch sees 25 m


def test_an_arm_that_stands_has_none() -> None:
    with pytest.raises(UnknownOptionError, match=r"no laser scanner.*ridgeback_panda, fetch"):
        LabEnv(Setting("level1/pick", obs="state", extras=("scan",)))


def test_it_is_observed_where_one_drives_and_changes_nothing_else() -> None:
    options = {"obs": "state", "room": "organic_7"}
    with (
        LabEnv(Setting("level5/navigate", extras=("scan",), **cast(Any, options))) as env,
        LabEnv(Setting("level5/navigate", **cast(Any, options))) as plain,
    ):
        observation, _ = env.reset(seed=2)
        without, _ = plain.reset(seed=2)
        assert observation.keys() - without.keys() == {"scan"}
        assert all(np.array_equal(observation[key], without[key]) for key in without)
        assert env.observation_space.contains(observation)
        scan = observation["scan"]
        assert scan.shape == (271,)
        assert 0.1 < scan.min() < scan.max() < 10.0  # in a room of 9 x 7 m
        again, _ = env.reset(seed=2)
        assert np.array_equal(again["scan"], scan)
