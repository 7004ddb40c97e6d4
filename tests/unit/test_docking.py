"""The last bit to a bench, where the disc would touch but the footprint does not."""

import math

import numpy as np
import pytest

from furnished_plans import BRIGHT
from labutopia_lerobot.navigation.docking import FloorRectangle, approach_to
from labutopia_lerobot.navigation.occupancy import FREE, Occupancy
from labutopia_lerobot.navigation.path_planner import (
    RADIUS,
    BlockedPlaceError,
    PathPlanner,
    UnreachableGoalError,
)
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.scenes.docks import docks
from labutopia_lerobot.scenes.plans import load_plan, plan_names
from labutopia_lerobot.scenes.room_map import room_map
from labutopia_lerobot.world import FloatArray

BASE = FloorRectangle(*RIDGEBACK.size)


def with_bench(*more: tuple[float, float, float, float]) -> Occupancy:
    """Return the map of a room of 6 x 5 m with a bench along its east wall, and other boxes."""
    occupancy = Occupancy.empty((6.0, 5.0))
    for left, bottom, right, top in ((5.2, 0.0, 6.0, 5.0), *more):
        occupancy.add(np.array([[left, bottom, 0.0]]), np.array([[right, top, 0.9]]))
    return occupancy


def planner(occupancy: Occupancy) -> PathPlanner:
    return PathPlanner.of(occupancy, RIDGEBACK.limits)


def corners(position: FloatArray, yaw: float) -> FloatArray:
    """Return many points of the base's rectangle, shape (n, 2) [m], room frame."""
    x, y = np.meshgrid(np.linspace(-0.48, 0.48, 25), np.linspace(-0.3965, 0.3965, 21))
    c, s = math.cos(yaw), math.sin(yaw)
    return np.column_stack([(c * x - s * y).ravel(), (s * x + c * y).ravel()]) + position


def test_a_footprint_fits_where_none_of_its_points_is_in_anything():
    rng = np.random.default_rng(0)
    occupancy = with_bench((1.0, 1.0, 1.6, 3.0), (3.0, 4.0, 3.4, 4.2))
    fits = []
    for _ in range(400):
        position, yaw = rng.uniform((0.0, 0.0), (6.0, 5.0)), rng.uniform(-math.pi, math.pi)
        points = corners(position, yaw)
        inside = ((points > 0.0) & (points < (6.0, 5.0))).all()
        cells = [occupancy.cells[occupancy.cell(*point)] for point in points]
        free = bool(inside and all(cell == FREE for cell in cells))
        said = BASE.fits(occupancy, position, yaw)
        assert free or not said  # it never says that it fits where it does not
        fits.append((free, said))
    agreed = np.mean([free == said for free, said in fits])
    assert agreed > 0.95
    assert 0.2 < np.mean([said for _, said in fits]) < 0.8


def test_a_robot_docks_nearer_to_a_bench_than_its_disc_may_be():
    occupancy, place = with_bench(), np.array([5.2 - 0.48 - 0.02, 2.5])
    assert not planner(occupancy).free(place)
    before = approach_to(planner(occupancy), occupancy, BASE, place, 0.0)
    assert before[1] == pytest.approx(2.5)
    assert before[0] == pytest.approx(5.2 - RADIUS, abs=0.04)
    assert planner(occupancy).plan(np.array([1.0, 1.0]), before).length > 3.0
    for share in np.linspace(0.0, 1.0, 20):
        assert BASE.fits(occupancy, before + share * (place - before), 0.0)


def test_a_robot_turns_before_a_bench_where_its_corners_touch_nothing():
    occupancy, place = with_bench((3.5, 1.0, 4.4, 1.8)), np.array([5.2 - 0.48 - 0.02, 2.5])
    before = approach_to(planner(occupancy), occupancy, BASE, place, 0.0)
    assert planner(occupancy).free(before + np.array((0.02, 0.0)))  # the disc could be nearer
    for yaw in np.linspace(-math.pi, math.pi, 73):
        points = corners(before, yaw)
        assert all(occupancy.cells[occupancy.cell(*point)] == FREE for point in points)


def test_a_robot_turns_where_its_disc_can_be_if_there_is_no_more_room():
    slot = with_bench((1.0, 0.0, 5.2, 1.85), (1.0, 3.15, 5.2, 5.0))
    before = approach_to(planner(slot), slot, BASE, np.array([4.7, 2.5]), 0.0)
    assert planner(slot).free(before)
    assert not BASE.turns(planner(slot).clearance, before)


@pytest.mark.parametrize(
    ("place", "yaw", "reason"),
    [
        ((4.9, 2.5), 0.0, "touches something there"),
        ((5.5, 2.5), 0.0, "touches something there"),
        ((5.65, 2.5), math.pi, "touches something there"),
        ((4.7, 2.5), math.pi / 4, "touches something there"),
    ],
)
def test_a_place_where_the_footprint_touches_something_is_refused(place, yaw, reason):
    occupancy = with_bench()
    with pytest.raises(BlockedPlaceError, match=reason):
        approach_to(planner(occupancy), occupancy, BASE, np.array(place), yaw)


def test_a_place_that_something_stands_behind_is_refused():
    occupancy = with_bench((3.5, 2.4, 4.0, 2.6))
    with pytest.raises(BlockedPlaceError, match="m behind it"):
        approach_to(planner(occupancy), occupancy, BASE, np.array([4.7, 2.5]), 0.0)


def test_a_place_in_a_slot_too_long_to_go_straight_in_is_refused():
    occupancy = with_bench((2.0, 0.0, 5.2, 2.0), (2.0, 3.0, 5.2, 5.0))
    with pytest.raises(BlockedPlaceError, match=r"no room for a robot of 0\.6 m radius"):
        approach_to(planner(occupancy), occupancy, BASE, np.array([4.7, 2.5]), 0.0)


def test_a_bench_in_another_part_of_the_room_is_out_of_reach():
    occupancy = with_bench((3.0, 0.0, 3.2, 5.0))
    before = approach_to(planner(occupancy), occupancy, BASE, np.array([4.7, 2.5]), 0.0)
    with pytest.raises(UnreachableGoalError):
        planner(occupancy).plan(np.array([1.0, 1.0]), before)


def test_docks_of_a_room_are_before_its_benches_and_face_them():
    found, occupancy = docks(BRIGHT, RIDGEBACK, RADIUS), room_map(BRIGHT)
    assert {dock.bench for dock in found} >= {"bench", "wall_bench_1"}
    for dock in found:
        assert BASE.fits(occupancy, dock.position, dock.yaw)
        ahead = np.array([math.cos(dock.yaw), math.sin(dock.yaw)])
        arm = dock.position + RIDGEBACK.arm[0] * ahead
        over = occupancy.cells[occupancy.cell(*(arm + 0.45 * ahead))]
        assert over != FREE  # 40 cm of the bench are within the 0.855 m of the arm
        assert planner(occupancy).free(dock.before)


@pytest.mark.slow
def test_in_ninety_rooms_a_robot_of_the_papers_radius_docks_at_two_benches():
    counts = {
        name: len({dock.bench for dock in docks(load_plan(name), RIDGEBACK, RADIUS)})
        for name in plan_names()
    }
    assert len(counts) == 100
    assert sum(count >= 2 for count in counts.values()) == 90
    assert sum(count >= 1 for count in counts.values()) == 96
