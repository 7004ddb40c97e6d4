"""Paths over a map: free, short, smooth, and followed."""

import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from scipy import sparse
from scipy.sparse import csgraph

from labutopia_lerobot.navigation.clearance import Clearance
from labutopia_lerobot.navigation.occupancy import COARSE, FREE, Occupancy
from labutopia_lerobot.navigation.parking import Parking
from labutopia_lerobot.navigation.path import DrivingLimits, Path
from labutopia_lerobot.navigation.path_planner import (
    RADIUS,
    BlockedPlaceError,
    PathPlanner,
    UnreachableGoalError,
)
from labutopia_lerobot.navigation.rounding import rounded
from labutopia_lerobot.navigation.tracking import PathTracker, turning_speed
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

LIMITS = DrivingLimits(speed=1.1, acceleration=1.0, turning=1.85, turning_acceleration=1.7)
CORNERS = np.array([[1.0, 1.0], [9.0, 6.0]])


def with_boxes(size: tuple[float, float], *boxes: tuple[float, float, float, float]) -> Occupancy:
    """Return the map of a room with boxes of 1 m height: left, bottom, right, top [m]."""
    occupancy = Occupancy.empty(size)
    sides = np.array(boxes, dtype=float).reshape(-1, 4)
    low, high = np.zeros((len(sides), 3)), np.ones((len(sides), 3))
    low[:, :2], high[:, :2] = sides[:, :2], sides[:, 2:]
    occupancy.add(low, high)
    return occupancy


SLALOM = with_boxes((10.0, 7.0), (3.0, 0.0, 3.2, 5.0), (6.0, 2.0, 6.2, 7.0))
HALL = with_boxes((20.0, 10.0), (4, 2, 5, 8), (9, 0, 10, 6), (13, 3, 16, 4), (13, 6, 16, 7))


def cluttered(seed: int) -> Occupancy:
    """Return the map of a hall in which a dozen boxes stand anyhow."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform((0.0, 0.0), (19.0, 9.0), (12, 2))
    sides = rng.uniform(0.3, 1.8, (12, 2))
    return with_boxes((20.0, 10.0), *np.hstack([corners, corners + sides]).tolist())


def shortest(occupancy: Occupancy, start: FloatArray, goal: FloatArray) -> float:
    """Return the length of SciPy's shortest way along 32 directions from middle to middle [m]."""
    numbers = np.pad(np.arange(occupancy.cells.size).reshape(occupancy.cells.shape), 3)
    free = np.pad(occupancy.passable(RADIUS), 3)
    around = [(r, c) for r in range(-3, 4) for c in range(-3, 4) if math.gcd(r, c) == 1]
    edges = []
    for move in around:
        there = np.roll(free, (-move[0], -move[1]), (0, 1)) & free
        ends = numbers[there], np.roll(numbers, (-move[0], -move[1]), (0, 1))[there]
        edges.append([*ends, np.full(len(ends[0]), math.hypot(*move))])
    one, other, lengths = np.hstack(edges)
    size = occupancy.cells.size
    graph = sparse.csr_array((lengths, (one.astype(int), other.astype(int))), (size, size))
    first, last = (
        int(np.ravel_multi_index(occupancy.cell(*end), occupancy.cells.shape))
        for end in (start, goal)
    )
    return float(csgraph.dijkstra(graph, indices=first)[last]) * occupancy.resolution


def drive(
    path: Path, yaw: float, push: FloatArray | None = None, limits: DrivingLimits = LIMITS
) -> FloatArray:
    """Follow a path with a base that does as it is bidden; return x, y, yaw, velocity: (n, 6)."""
    tracker, trace = PathTracker(path, limits), []
    x, y = path.points[0]
    for step in range(CONTROL_HZ * 60):
        velocity = tracker.velocity(np.array([x, y]), yaw)
        trace.append([x, y, yaw, *velocity])
        if tracker.arrived(np.array([x, y]), within=0.005):
            return np.array(trace)
        middle = yaw + velocity[2] / CONTROL_HZ / 2
        x += (math.cos(middle) * velocity[0] - math.sin(middle) * velocity[1]) / CONTROL_HZ
        y += (math.sin(middle) * velocity[0] + math.cos(middle) * velocity[1]) / CONTROL_HZ
        yaw += velocity[2] / CONTROL_HZ
        if push is not None and step == CONTROL_HZ:
            x, y = np.array([x, y]) + push
    raise AssertionError("the base has not arrived within a minute")


def test_navigation_brings_no_mujoco():
    code = (
        "import sys, labutopia_lerobot.navigation.path_planner, labutopia_lerobot.navigation."
        "tracking; sys.exit('mujoco' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_path_goes_from_place_to_place_and_keeps_the_radius_from_everything():
    path = PathPlanner.of(SLALOM, LIMITS).plan(*CORNERS)
    assert (path.points[[0, -1]] == CORNERS).all()
    blocked = SLALOM.middles(SLALOM.cells != FREE)
    half = SLALOM.resolution / 2
    away = np.maximum(np.abs(path.points[:, None] - blocked[None]) - half, 0.0)
    assert np.hypot(*np.moveaxis(away, -1, 0)).min() >= RADIUS
    assert (path.points >= RADIUS).all()
    assert (path.points <= np.array([10.0, 7.0]) - RADIUS).all()
    assert np.hypot(*np.diff(path.points, axis=0).T).max() < 0.03


@pytest.mark.parametrize("occupancy", [SLALOM, cluttered(1)], ids=["slalom", "cluttered"])
def test_paths_are_as_short_as_those_of_an_independent_planner(occupancy):
    planner, rng = PathPlanner.of(occupancy, LIMITS), np.random.default_rng(0)
    ends = occupancy.middles(occupancy.passable(RADIUS))
    for start, goal in rng.choice(ends, (2, 2), replace=False):
        path, length = planner.plan(start, goal), shortest(occupancy, start, goal)
        assert length * 0.95 < path.length < length * 1.05
        assert path.length >= np.hypot(*(goal - start)) - 1e-9


def test_the_shortest_path_is_no_longer_than_the_careful_one_and_no_shorter_than_can_be():
    planner, ends = PathPlanner.of(HALL, LIMITS), (np.array([1.0, 5.0]), np.array([18.0, 5.0]))
    careful, short = planner.plan(*ends), planner.shortest(*ends)
    assert short.length < careful.length
    assert short.length == pytest.approx(shortest(HALL, *ends), rel=0.05)


def test_a_map_has_boxes_where_they_are_wherever_it_begins():
    cells = np.zeros((40, 40), np.uint8)
    occupancy = Occupancy(cells, (-1.0, -1.0), 0.05)
    occupancy.add(np.array([[0.0, 0.2, 0.0]]), np.array([[0.2, 0.4, 1.0]]))
    rows, columns = np.nonzero(occupancy.cells)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (24, 27, 20, 23)


def test_a_base_that_is_where_it_is_to_go_stays_there():
    planner = PathPlanner.of(with_boxes((6.0, 6.0)), LIMITS)
    here = np.array([3.0, 3.0])
    tracker = PathTracker(planner.plan(here, here), LIMITS)
    assert tracker.velocity(here, 0.5) == pytest.approx([0.0, 0.0, 0.0])
    assert tracker.arrived(here, within=0.01)


def test_where_there_is_room_a_path_keeps_away_from_things_by_more_than_it_must():
    planner = PathPlanner.of(HALL, LIMITS)
    path = planner.plan(np.array([1.0, 5.0]), np.array([18.0, 5.0]))
    assert planner.clearance.at(path.points).min() > RADIUS + 0.1


def test_a_disc_fits_through_what_is_as_wide_as_it_is_and_no_narrower():
    for gap, fits in ((1.3, True), (1.15, False)):
        door = with_boxes((6.0, 4.0), (3.0, 0.0, 3.1, 1.0), (3.0, 1.0 + gap, 3.1, 4.0))
        planner = PathPlanner.of(door, LIMITS)
        if fits:
            planner.plan(np.array([1.0, 1.0]), np.array([5.0, 3.0]))
        else:
            with pytest.raises(UnreachableGoalError, match=r"No way leads from \(1\.00, 1\.00\)"):
                planner.plan(np.array([1.0, 1.0]), np.array([5.0, 3.0]))


@pytest.mark.parametrize("missing", [0.01, 0.2])
def test_from_a_tight_place_a_path_leaves_at_once_and_keeps_the_radius_elsewhere(missing):
    clearance = Clearance.of(HALL, RADIUS)
    start, goal = np.array([4.0 - RADIUS + missing, 5.0]), np.array([18.0, 3.0])
    path = PathPlanner(clearance.leaving(start), LIMITS).plan(start, goal)
    room, away = clearance.at(path.points), np.hypot(*(path.points - start).T)
    np.testing.assert_array_equal(path.points[0], start)
    assert room.min() == pytest.approx(room[0])
    assert room[0] == pytest.approx(RADIUS - missing, abs=0.03)
    assert room[away > 0.2 + 2.0 * missing].min() > RADIUS - 1e-6
    with pytest.raises(BlockedPlaceError):
        PathPlanner(clearance, LIMITS).plan(start, goal)


def test_a_place_with_room_is_left_as_any_other():
    clearance = Clearance.of(HALL, RADIUS)
    assert clearance.leaving(np.array([2.0, 2.0])) is clearance


def test_the_papers_coarse_map_gives_paths_too():
    planner = PathPlanner.of(Occupancy.empty((10.0, 7.0), COARSE), LIMITS)
    ends = np.array([[1.3, 1.3], [8.8, 5.2]])
    assert planner.plan(*ends).length == pytest.approx(np.hypot(*(ends[1] - ends[0])), rel=1e-3)


@pytest.mark.parametrize("what", ["start", "goal"])
@pytest.mark.parametrize(
    "place", [(3.1, 2.0), (2.6, 2.0), (0.3, 3.0), (-4.0, 3.0), (math.nan, 3.0)]
)
def test_a_place_where_the_robot_cannot_be_is_named(what, place):
    ends = {"start": CORNERS[0], "goal": CORNERS[1], what: np.array(place)}
    with pytest.raises(BlockedPlaceError, match=rf"The {what} \({place[0]:.2f}, .* is blocked"):
        PathPlanner.of(SLALOM, LIMITS).plan(ends["start"], ends["goal"])


def test_bends_are_never_sharper_than_the_speed_at_which_they_are_driven_allows():
    path = PathPlanner.of(SLALOM, LIMITS).plan(*CORNERS)
    assert np.isfinite(path.bends).any()
    speeds = path.speeds(LIMITS)
    one, two, three = path.points[:-2], path.points[1:-1], path.points[2:]
    before, after = two - one, three - two
    turn = np.arctan2(
        before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1)
    )
    across = speeds[1:-1] ** 2 * np.abs(turn) / np.hypot(*after.T)
    assert across.max() < LIMITS.along * 1.3  # at the ends of arcs, where points are uneven
    along = np.diff(speeds**2) / (2 * np.diff(path.distances))
    assert np.abs(along).max() < LIMITS.along * 1.001
    assert speeds.max() <= LIMITS.speed
    assert speeds[0] == speeds[-1] == 0.0


def test_a_centimetre_takes_the_time_from_rest_to_rest():
    start = np.array([3.0, 3.0])
    path = PathPlanner.of(with_boxes((6.0, 6.0)), LIMITS).plan(start, np.array([3.01, 3.0]))
    assert path.duration(LIMITS) == pytest.approx(2.0 * np.sqrt(0.01 / LIMITS.along), rel=0.01)


def test_where_no_bend_has_room_the_robot_stops_at_the_corner():
    corridor = with_boxes((6.0, 6.0), (1.3, 1.3, 6.0, 6.0))
    path = PathPlanner.of(corridor, LIMITS).plan(np.array([0.65, 5.0]), np.array([5.0, 0.65]))
    slowest = path.speeds(LIMITS)[1:-1].min()
    assert slowest < 0.5
    assert path.duration(LIMITS) > path.length / LIMITS.speed


def test_a_path_is_followed_within_centimetres_and_within_the_limits():
    planner = PathPlanner.of(HALL, LIMITS)
    path = planner.plan(np.array([1.0, 5.0]), np.array([18.0, 5.0]))
    trace = drive(path, yaw=0.0)
    off = np.hypot(*np.moveaxis(trace[:, None, :2] - path.points, -1, 0)).min(axis=1)
    assert off.max() < 0.05
    assert planner.clearance.at(trace[:, :2]).min() > RADIUS - 0.01
    assert np.hypot(*trace[:, 3:5].T).max() <= LIMITS.speed + 1e-9
    assert np.abs(trace[:, 5]).max() <= LIMITS.turning
    changes = np.diff(trace[:, 3:], axis=0) * CONTROL_HZ
    assert np.hypot(*changes[:, :2].T).max() <= LIMITS.acceleration + 1e-9
    assert np.abs(changes[:, 2]).max() <= LIMITS.turning_acceleration + 1e-9
    assert np.hypot(*trace[-1, 3:5]) < 0.05
    assert len(trace) / CONTROL_HZ < 1.5 * path.duration(LIMITS)


def test_a_base_that_looks_the_wrong_way_turns_before_it_drives():
    path = PathPlanner.of(HALL, LIMITS).plan(np.array([1.0, 5.0]), np.array([1.0, 9.0]))
    trace = drive(path, yaw=-math.pi / 2)
    turned = np.abs(trace[:, 2] - math.pi / 2) < math.pi / 2
    assert np.hypot(*(trace[~turned, :2] - trace[0, :2]).T).max() < 0.05


def test_a_base_that_is_pushed_off_its_path_comes_back_to_it():
    path = PathPlanner.of(HALL, LIMITS).plan(np.array([1.0, 5.0]), np.array([18.0, 5.0]))
    trace = drive(path, yaw=0.0, push=np.array([0.15, -0.15]))
    off = np.hypot(*np.moveaxis(trace[:, None, :2] - path.points, -1, 0)).min(axis=1)
    assert off.max() > 0.1
    assert off[-CONTROL_HZ:].max() < 0.02


@pytest.mark.parametrize("yaw", [0.0, 2.5])
def test_a_base_on_two_wheels_follows_a_path_and_comes_back_to_it_without_going_sideways(yaw):
    planner = PathPlanner.of(HALL, LIMITS)
    path = planner.plan(np.array([1.0, 5.0]), np.array([18.0, 5.0]))
    rolling = replace(LIMITS, sideways=False)
    trace = drive(path, yaw=yaw, limits=rolling)
    off = np.hypot(*np.moveaxis(trace[:, None, :2] - path.points, -1, 0)).min(axis=1)
    assert off.max() < 0.08
    assert np.abs(trace[:, 4]).max() == 0.0
    changes = np.diff(trace[:, 3:], axis=0) * CONTROL_HZ
    assert np.abs(changes[:, 0]).max() <= LIMITS.acceleration + 1e-9
    pushed = drive(path, yaw=0.0, push=np.array([0.15, -0.15]), limits=rolling)
    off = np.hypot(*np.moveaxis(pushed[:, None, :2] - path.points, -1, 0)).min(axis=1)
    assert off.max() > 0.1
    assert off[-CONTROL_HZ:].max() < 0.02


@pytest.mark.parametrize(("left", "ahead"), [(0.02, 0.4), (-0.02, 0.4), (0.02, -0.6)])
def test_a_base_on_two_wheels_docks_from_beside_the_line_ahead_and_in_reverse(left, ahead):
    rolling = replace(LIMITS, sideways=False)
    yaw = 0.7
    along = np.array([math.cos(yaw), math.sin(yaw)])
    aside = np.array([-along[1], along[0]])
    goal = np.array([2.0, 3.0])
    way, place, heading = Parking(goal, yaw, rolling), goal - ahead * along + left * aside, yaw
    for _ in range(10 * CONTROL_HZ):
        forward, sideways, turning = way.velocity(place, heading)
        assert sideways == 0.0
        middle = heading + turning / CONTROL_HZ / 2
        place = place + forward / CONTROL_HZ * np.array([math.cos(middle), math.sin(middle)])
        heading += turning / CONTROL_HZ
    assert abs((place - goal) @ along) < 0.005
    assert abs((place - goal) @ aside) < 0.015
    assert abs(heading - yaw) < 0.01


def test_a_turn_ends_where_one_looks_at_rest():
    off, now, fastest = math.radians(170.0), 0.0, 0.0
    for _ in range(CONTROL_HZ * 6):
        now = turning_speed(off, now, LIMITS)
        off -= now / CONTROL_HZ
        fastest = max(fastest, abs(now))
        assert off > -math.radians(1.0)
    assert fastest == pytest.approx(LIMITS.turning)
    assert abs(off) < math.radians(0.1)
    assert abs(now) < 0.01


def test_distances_between_cells_are_those_of_the_map_at_their_middles():
    clearance = Clearance.of(SLALOM, RADIUS)
    cells = np.ones(SLALOM.cells.shape, bool)
    found = clearance.at(SLALOM.middles(cells)).reshape(cells.shape)
    assert np.allclose(found, clearance.distances)


def test_a_path_stops_at_a_corner_without_room_and_goes_on_round_the_next():
    """Two corners in a row that are too tight for any bend."""
    free = np.full((60, 60), 0.6)
    waypoints = np.array([[0.5, 0.5], [1.0, 0.5], [1.0, 1.0], [1.5, 1.0]])
    path = rounded(waypoints, Clearance(free, (0.0, 0.0), 0.05, 0.6 + 1e-6), LIMITS)
    assert path.points[0].tolist() == [0.5, 0.5]
    assert path.points[-1].tolist() == [1.5, 1.0]
    assert path.length == pytest.approx(1.5)
