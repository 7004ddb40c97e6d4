"""Glass in many short edges, as a round bottom has, counts as much as glass in few."""

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.solver.bodies import clearances
from labutopia_lerobot.liquids.solver.contacts import Contacts, find_contacts, gap
from labutopia_lerobot.liquids.solver.smoothing import BEHIND_WALL, look_up
from labutopia_lerobot.liquids.solver.walls import edges_of
from labutopia_lerobot.liquids.surroundings import Surroundings
from labutopia_lerobot.substances.filling import Filling
from liquid_experiments import filled, world

REACH = 2.0 * 1e-7 ** (1 / 3)
RADIUS, BOTTOM, HIGH = 0.03, 0.003, 16 * 0.0024


def straight(edges: int) -> Vessel:
    """Return a beaker whose wall is cut into so many edges; 16 are 2.4 mm long each."""
    corners = BOTTOM + HIGH * np.arange(edges + 1) / edges
    outer = ((RADIUS, 0.0), *((RADIUS, float(z)) for z in corners))
    return Vessel("glass", Profile(outer, 0.0018, BOTTOM), 0.02)


def round_bottomed(edges: int) -> Vessel:
    """Return half a ball, cut into so many edges."""
    angles = np.linspace(np.radians(20), np.radians(90), edges + 1)
    corners = [(0.05 * np.sin(angle), 0.05 * (1 - np.cos(angle))) for angle in angles]
    lowest = corners[0]
    outer = ((lowest[0] - 0.001, 0.0), *((r, z + 0.0) for r, z in corners))
    return Vessel("glass", Profile(tuple(outer), 0.0018, lowest[1]), 0.03)


def contacts_of(vessel: Vessel, positions: np.ndarray) -> Contacts:
    model, data = world(vessel, bench=False)
    around = Surroundings(model, data, [vessel])
    around.move()
    clear = clearances(positions, positions, around.glass)
    return find_contacts(positions, around.glass, around.shapes, clear, REACH)


def behind_glass(vessel: Vessel, positions: np.ndarray) -> np.ndarray:
    """Return which share of the kernel around every point is behind glass."""
    contacts, shares = contacts_of(vessel, positions), []
    for a, point in enumerate(positions):
        free = 1.0
        for c in range(contacts.starts[a], contacts.starts[a + 1]):
            q = gap(contacts, c, *point) / REACH
            free *= 1.0 - contacts.extent[c] * look_up(BEHIND_WALL, q)
        shares.append(1.0 - free)
    return np.array(shares)


def by_the_wall(count: int) -> np.ndarray:
    """Return points from the bottom to above the lip, on either side of the wall."""
    rng = np.random.default_rng(1)
    inside = RADIUS - 0.0018 - rng.uniform(1e-4, 0.9 * REACH, count)
    outside = RADIUS + rng.uniform(1e-4, 0.9 * REACH, count)
    radii = np.where(rng.random(count) < 0.5, inside, outside)
    heights = rng.uniform(BOTTOM + 1e-4, BOTTOM + HIGH + 0.005, count)
    return np.column_stack([radii, np.zeros(count), heights])


@pytest.mark.parametrize("edges", [4, 16, 64])
def test_a_straight_wall_counts_the_same_however_finely_it_is_cut(edges: int) -> None:
    points = by_the_wall(500)
    whole, cut = (behind_glass(straight(count), points) for count in (1, edges))
    assert whole.max() > 0.4
    assert cut == pytest.approx(whole, abs=1e-12)


def test_a_wall_pushes_liquid_the_same_however_finely_it_is_cut() -> None:
    pressures = []
    for edges in (1, 4, 16):
        _, data, liquid = filled(straight(edges), Filling(60.0), 600)
        liquid.step()
        pressures.append(np.append(data.xfrc_applied[1], liquid.positions.std(axis=0)))
    for pressure in pressures[1:]:
        assert pressure == pytest.approx(pressures[0], abs=1e-3)


def test_a_round_bottom_counts_the_same_however_finely_it_is_cut() -> None:
    angles = np.random.default_rng(2).uniform(np.radians(40), np.radians(70), 200)
    inside = 0.05 - 0.0018 - 0.004
    x, z = inside * np.sin(angles), 0.05 - inside * np.cos(angles)
    points = np.column_stack([x, np.zeros_like(x), z])
    coarse, fine, finest = (behind_glass(round_bottomed(n), points) for n in (8, 32, 128))
    assert finest == pytest.approx(fine, abs=0.01)
    assert coarse.mean() == pytest.approx(finest.mean(), abs=0.01)


def test_no_plane_is_dropped_however_many_there_are() -> None:
    grooves = [(0.03 if k % 2 else 0.0306, 0.004 + 0.0004 * k) for k in range(60)]
    vessel = Vessel("glass", Profile(((0.03, 0.0), (0.03, 0.003), *grooves), 0.0018, 0.003), 0.015)
    assert len(edges_of(vessel.profile)) > 100
    points = np.tile([0.0265, 0.0, 0.016], (40, 1)) + np.linspace(0, 1e-4, 40)[:, None]
    contacts = contacts_of(vessel, points)
    each = [contacts_of(vessel, point[None]).starts[-1] for point in points]
    assert min(each) > 6
    assert np.diff(contacts.starts).tolist() == each
