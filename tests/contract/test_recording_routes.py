"""Where one drives, a dataset has map and planned paths, which the judge plans again."""

import base64
import copy
import io
import json
import math
from pathlib import Path
from typing import cast

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from PIL import Image

from labutopia_lerobot.datasets.replanning import Replanning, routes_of
from labutopia_lerobot.datasets.routes import Routes, difference, map_of, occupancy_of
from labutopia_lerobot.datasets.tables import ROUTES, read_episodes
from labutopia_lerobot.datasets.verify import Verdict, verify
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.navigation.occupancy import FREE, OCCUPIED
from labutopia_lerobot.navigation.path_planner import RADIUS
from labutopia_lerobot.scenes import load_room
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.driver import Driver
from labutopia_lerobot.skills.way import Way, base_at
from labutopia_lerobot.world import FloatArray
from recordings import recording

TASK = "level5/navigate"


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(Setting(TASK, obs="state", room="organic_7"))


@pytest.fixture(scope="module")
def driving(env: LabEnv) -> tuple[Routes, list[FloatArray]]:
    """What the expert plans first, and what it has commanded until then."""
    env.reset(seed=4)
    expert = env.expert()
    expert.start()
    commands = []
    while not expert.routes:
        commands.append(expert.act())
        env.step(commands[-1])
    routes = routes_of(env, expert.routes)
    assert routes is not None
    return routes, commands


def planned_again(env: LabEnv, routes: Routes, commands: list[FloatArray]) -> Routes | None:
    env.reset(seed=4)
    replanning = Replanning(routes)
    for command in commands:
        replanning.look(env)
        env.step(command)
    return replanning.routes(env)


def test_the_map_is_that_of_the_room(driving: tuple[Routes, list[FloatArray]]) -> None:
    routes, _ = driving
    assert routes["room"] == "organic_7"
    stored = occupancy_of(json.loads(json.dumps(routes["map"])))
    assert stored.sha256 == load_room(routes["room"]).map().sha256
    assert stored.sha256 != load_room("organic_8").map().sha256
    assert {FREE, OCCUPIED} <= set(np.unique(stored.cells))


def test_a_map_is_read_without_this_package(driving: tuple[Routes, list[FloatArray]]) -> None:
    """By what ROS says of maps: a dark pixel is occupied, the lowest row comes first (y = 0)."""
    stored = driving[0]["map"]
    greys = np.asarray(Image.open(io.BytesIO(base64.b64decode(stored["png"]))))[::-1]
    own = load_room("organic_7").map()
    assert np.array_equal(greys < 100, own.cells == OCCUPIED)
    assert np.array_equal(greys > 250, own.cells == FREE)
    assert stored["origin"] == list(own.origin)
    assert stored["resolution"] == own.resolution == 0.05


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ("0", "not what a map has"),
        ({"png": "", "origin": [0, 0], "resolution": 0.05}, "no PNG"),
        ({"png": "!", "origin": [0, 0], "resolution": 0.05}, "cannot be read"),
        ({"png": "", "origin": [0], "resolution": 0.05}, "cannot be read"),
        ({"png": "", "resolution": 0.05}, "origin"),
    ],
)
def test_what_is_no_map_is_a_difference(
    driving: tuple[Routes, list[FloatArray]], wrong: object, why: str
) -> None:
    routes, _ = driving
    assert why in str(difference(cast(Routes, routes | {"map": wrong}), routes))


def test_a_path_leads_from_the_base_to_a_dock_along_its_key_waypoints(
    env: LabEnv, driving: tuple[Routes, list[FloatArray]]
) -> None:
    (path,) = driving[0]["paths"]
    env.reset(seed=4)
    world = env.workcell.world
    points = np.array(path["path"])
    assert path["path"][0][:2] == pytest.approx(base_at(world)[0], abs=2e-3)
    assert path["waypoints"][0] == path["path"][0][:2]
    assert path["waypoints"][-1] == path["path"][-1][:2]
    steps = np.hypot(*np.diff(points[:, :2], axis=0).T)
    assert steps.max() <= 0.101
    away = load_room("organic_7").map().clearance()
    cells = [load_room("organic_7").map().cell(x, y) for x, y, _ in points]
    assert min(away[cell] for cell in cells) > RADIUS - 0.05
    ahead = np.arctan2(*np.diff(points[:, :2], axis=0).T[::-1])
    off = (points[:-1, 2] - ahead + math.pi) % (2 * math.pi) - math.pi
    assert np.median(np.abs(off)) < 0.02
    x, y, yaw = path["dock"]
    behind = np.array(path["waypoints"][-1]) - (x, y)
    assert abs(behind[0] * math.sin(yaw) - behind[1] * math.cos(yaw)) < 2e-3


def test_planned_again_it_is_the_same_and_a_changed_one_is_found(
    env: LabEnv, driving: tuple[Routes, list[FloatArray]]
) -> None:
    routes, commands = driving
    assert difference(routes, planned_again(env, routes, commands)) is None
    for key, value in (("waypoints", [[0.0, 0.0]]), ("dock", [0.0, 0.0, 0.0]), ("t", -1.0)):
        wrong = copy.deepcopy(routes)
        wrong["paths"][0][key] = value  # type: ignore[literal-required]
        assert difference(wrong, planned_again(env, wrong, commands)), key
    for key, value in (("thing", "unicorn"), ("around", ["nobody"])):
        wrong = copy.deepcopy(routes)
        wrong["paths"][0][key] = value  # type: ignore[literal-required]
        assert "no path" in str(difference(wrong, planned_again(env, wrong, commands)))
    wrong = copy.deepcopy(routes)
    wrong["map"] = map_of(load_room("organic_8").map())
    assert "its map is not" in str(difference(wrong, planned_again(env, wrong, commands)))


def test_a_way_round_somebody_is_one_more_route_with_its_time() -> None:
    with LabEnv(Setting(TASK, obs="state", room="organic_7", axes=("dynamic",))) as env:
        seed = 100100
        while env.reset(seed=seed)[1]["drawn"]["dynamic"] != "passer_by":
            seed += 1
        world = env.workcell.world
        (beaker,) = env.workcell.task.start
        driver = Driver(Way.of(world), beaker, world)
        env.step(env.workcell.simulation.command.astype(np.float32))
        driver._go_round(world, list(world.in_the_way))
        routes = routes_of(env, driver.routes)
    assert routes is not None
    assert [(path["t"], path["around"]) for path in routes["paths"]] == [
        (0.0, []),
        (pytest.approx(1 / 30, abs=1e-3), ["passer_by"]),
    ]


@pytest.mark.slow
def test_recorded_routes_are_verified(tmp_path: Path) -> None:
    options = (f"task={TASK}", "obs=state", "room=organic_7", "axes=[dynamic]", "seed=100100")
    root = recording(tmp_path / "dataset", *options, "episodes=2")
    for row in read_episodes(root):
        assert json.loads(row[ROUTES])["paths"]
    assert verify(root) == Verdict([], [])
    (file,) = root.glob("meta/episodes/*/*.parquet")
    table = pq.read_table(file)
    texts = table[ROUTES].to_pylist()
    changed = json.loads(texts[1])
    changed["paths"][0]["waypoints"][-1][0] += 0.01
    column = pa.array([texts[0], json.dumps(changed)])
    pq.write_table(table.set_column(table.column_names.index(ROUTES), ROUTES, column), file)
    assert any(ROUTES in fault and "waypoints" in fault for fault in verify(root).faults)
