"""How far a footprint is from things: as a fine raster of both says, and 0 where it is in one."""

import math

import numpy as np
import pytest
from scipy.spatial import cKDTree

from labutopia_lerobot.navigation.docking import FloorRectangle
from labutopia_lerobot.navigation.footprint_clearance import FootprintClearance
from labutopia_lerobot.navigation.occupancy import FREE, Occupancy

BASE = FloorRectangle(0.96, 0.793)


@pytest.fixture(scope="module")
def occupancy() -> Occupancy:
    occupancy = Occupancy.empty((5.0, 4.0))
    for left, bottom, right, top in ((4.0, 0.0, 5.0, 4.0), (1.0, 1.0, 1.3, 1.2)):
        occupancy.add(np.array([[left, bottom, 0.0]]), np.array([[right, top, 0.9]]))
    return occupancy


def test_it_is_the_distance_of_the_nearest_points_of_both(occupancy):
    clearance = FootprintClearance.of(occupancy, BASE)
    fine = np.linspace(-0.025, 0.025, 11)
    grid = np.stack(np.meshgrid(fine, fine), axis=-1).reshape(-1, 2)
    blocked = np.pad(occupancy.cells != FREE, 1, constant_values=True)
    rows, columns = np.nonzero(blocked)
    middles = (np.column_stack([columns, rows]) - 0.5) * occupancy.resolution
    things = cKDTree((middles[:, None] + grid).reshape(-1, 2))
    x, y = np.meshgrid(np.linspace(-0.48, 0.48, 97), np.linspace(-0.3965, 0.3965, 81))
    rng, far = np.random.default_rng(0), 0
    for _ in range(30):
        position, yaw = rng.uniform((0.0, 0.0), (4.5, 4.0)), rng.uniform(-math.pi, math.pi)
        c, s = math.cos(yaw), math.sin(yaw)
        own = np.column_stack([(c * x - s * y).ravel(), (s * x + c * y).ravel()]) + position
        expected = float(things.query(own)[0].min())
        found = clearance.at(position, yaw)
        if BASE.fits(occupancy, position, yaw):
            assert found == pytest.approx(expected, abs=0.012)
            far += 1
        elif expected < 0.001:
            assert found < 0.02
    assert far > 5


def test_a_base_before_a_bench_is_as_far_from_it_as_it_stands(occupancy):
    clearance = FootprintClearance.of(occupancy, BASE)
    assert clearance.at(np.array([4.0 - 0.48 - 0.07, 2.0]), 0.0) == pytest.approx(0.07)
    assert clearance.at(np.array([4.0 - 0.3965 - 0.07, 2.0]), math.pi / 2) == pytest.approx(0.07)
    assert clearance.at(np.array([4.0, 2.0]), 0.3) == 0.0
