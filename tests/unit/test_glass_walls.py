"""Nothing gets through glass, tried by random paths against an independent test of points."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

import leak_rate
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.liquids.solver.walls import (
    SKIN,
    Edges,
    distance_to_glass,
    edges_of,
    first_crossing,
    holds,
    in_glass,
    stop_at_glass,
)

PROFILES = {
    vessel.name: vessel.profile
    for vessel in (
        glassware("beaker", "250 ml", "beaker"),
        glassware("conical_flask", "300 ml", "conical flask"),
        glassware("measuring_cylinder", "250 ml", "cylinder"),
        glassware("pear_shaped_flask", "250 ml", "volumetric flask"),
    )
}
SAMPLES = 200
ROUNDING = 2e-7
"""The solver lets a point lie this deep in the surface [m] (`walls`)."""

type Points = NDArray[np.float64]


@pytest.fixture(params=PROFILES)
def profile(request: pytest.FixtureRequest) -> Profile:
    return PROFILES[request.param]


def depth(profile: Profile, points: Points) -> Points:
    """How far points are within the glass, horizontally or vertically, whichever is less [m]."""
    radius, z = np.hypot(points[..., 0], points[..., 1]), points[..., 2]
    outer_radii, outer_heights = zip(*profile.outer, strict=True)
    out = np.interp(z, outer_heights, outer_radii) - radius
    below = np.minimum(z, profile.height - z)
    wall = radius - (np.interp(z, outer_heights, outer_radii) - profile.wall)
    floor = profile.bottom - z
    depths: Points = np.minimum(np.minimum(out, below), np.maximum(wall, floor))
    return depths


def around(profile: Profile, count: int, rng: np.random.Generator) -> Points:
    """Points outside the glass, in the cavity and around the vessel."""
    widest = max(radius for radius, _ in profile.outer)
    low, high = (-1.3 * widest, -1.3 * widest, -0.02), (1.3 * widest,) * 2
    points = rng.uniform(low, (*high, profile.height + 0.02), (4 * count, 3))
    return points[depth(profile, points) < 0.0][:count]


def near_wall(profile: Profile, count: int, rng: np.random.Generator) -> Points:
    """Points in the cavity, at most 0.1 mm from the wall."""
    z = rng.uniform(profile.bottom + 1e-4, profile.height, count)
    radius = np.array([profile.inner_radius(height) for height in z])
    radius -= rng.uniform(SKIN, 1e-4, count)
    angle = rng.uniform(0, 2 * np.pi, count)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])


def near_lip(profile: Profile, count: int, rng: np.random.Generator) -> Points:
    """Points outside the glass within 3 mm of the lip."""
    middle = profile.outer_radius(profile.height) - profile.wall / 2
    angle = rng.uniform(0, 2 * np.pi, 3 * count)
    radius = middle + rng.uniform(-3e-3, 3e-3, 3 * count)
    z = profile.height + rng.uniform(-3e-3, 3e-3, 3 * count)
    points = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])
    return points[depth(profile, points) < 0.0][:count]


def deepest(profile: Profile, edges: Edges, starts: Points, ends: Points) -> float:
    """Resolve every path and return how deep any of them goes into the glass [m]."""
    ends = ends.copy()
    for start, end in zip(starts, ends, strict=True):
        stop_at_glass(edges, start, end)
    part = np.linspace(0, 1, SAMPLES)[:, None, None]
    return float(depth(profile, starts + part * (ends - starts)).max())


def paths(profile: Profile, kind: str) -> tuple[Points, Points]:
    rng = np.random.default_rng(7)
    count = 3000
    if kind == "grazing":
        starts = near_wall(profile, count, rng)
    elif kind == "at the lip":
        starts = near_lip(profile, count, rng)
    else:
        starts = around(profile, count, rng)
    steps = rng.normal(size=starts.shape)
    steps /= np.linalg.norm(steps, axis=1)[:, None]
    if kind == "grazing":  # along the wall, level or upright
        across = np.column_stack([-starts[:, 1], starts[:, 0], np.zeros(len(starts))])
        across /= np.linalg.norm(across, axis=1)[:, None]
        steps = across + 0.02 * steps
        steps[::2] = (0, 0, 1) + 0.02 * steps[::2]
    length = {"slow": 0.01, "fast": 1.0, "grazing": 0.02, "at the lip": 0.006}[kind]
    return starts, starts + length * rng.uniform(0, 1, (len(starts), 1)) * steps


@pytest.mark.parametrize("kind", ["slow", "fast", "grazing", "at the lip"])
def test_no_path_goes_through_glass(profile: Profile, kind: str) -> None:
    starts, ends = paths(profile, kind)
    assert len(starts) > 1000
    part = np.linspace(0, 1, SAMPLES)[:, None, None]
    straight = depth(profile, starts + part * (ends - starts)).max(axis=0)
    assert (straight > 1e-4).mean() > 0.01  # unresolved, many would
    assert deepest(profile, edges_of(profile), starts, ends) < ROUNDING


def test_a_hole_in_the_wall_is_noticed(profile: Profile) -> None:
    edges = edges_of(profile)
    starts, ends = paths(profile, "slow")
    leaks = [deepest(profile, np.delete(edges, k, axis=0), starts, ends) for k in range(1, 3)]
    assert min(leaks) > 10 * ROUNDING


def test_the_distance_to_glass_is_that_of_its_nearest_point(profile: Profile) -> None:
    corners = [(0.0, profile.bottom), *profile.inner, *profile.outer[::-1], (0.0, 0.0)]
    part = np.linspace(0, 1, 2001)[:, None]
    surface = np.concatenate([a + part * (np.array(b) - a) for a, b in pairwise(corners)])
    for x, y, z in around(profile, 300, np.random.default_rng(5)):
        radius = float(np.hypot(x, y))
        nearest = np.hypot(*(surface - (radius, z)).T).min()
        assert distance_to_glass(edges_of(profile), radius, z) == pytest.approx(nearest, abs=1e-5)


def test_a_free_path_is_left_alone(profile: Profile) -> None:
    starts, ends = paths(profile, "slow")
    part = np.linspace(0, 1, SAMPLES)[:, None, None]
    clear = depth(profile, starts + part * (ends - starts)).max(axis=0) < -1e-4
    assert clear.sum() > 500
    for start, end in zip(starts[clear], ends[clear], strict=True):
        kept = end.copy()
        assert not stop_at_glass(edges_of(profile), start, kept)
        assert np.array_equal(kept, end)


def test_a_stopped_path_ends_by_the_wall_that_it_met() -> None:
    profile = PROFILES["beaker"]
    height = 0.03
    start, end = np.array([0.0, 0.0, height]), np.array([0.0, 0.05, height])
    fraction, edge = first_crossing(edges_of(profile), start, end)
    assert edge >= 0
    assert fraction * 0.05 == pytest.approx(profile.inner_radius(height), abs=1e-9)
    assert stop_at_glass(edges_of(profile), start, end)
    assert np.hypot(end[0], end[1]) == pytest.approx(profile.inner_radius(end[2]), abs=2 * SKIN)


def test_cavity_and_glass_are_where_the_profile_has_them(profile: Profile) -> None:
    rng = np.random.default_rng(3)
    edges, inner = edges_of(profile), len(profile.inner)
    widest = max(radius for radius, _ in profile.outer)
    points = rng.uniform(
        (-widest, -widest, -0.01), (widest, widest, profile.height + 0.01), (4000, 3)
    )
    for x, y, z in points:
        radius = np.hypot(x, y)
        within = profile.bottom < z < profile.height and radius < profile.inner_radius(z)
        glass = 0 < z < profile.height and radius < profile.outer_radius(z) and not within
        assert holds(edges, inner, x, y, z) == within
        assert in_glass(edges, x, y, z) == glass


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))  # each another vessel
def test_nothing_leaks_from_a_vessel_that_is_swung_about(seed: int) -> None:
    row = leak_rate.handle(seed)
    assert row["crossings"] == 0
    assert row["lost_particles"] == 0


def test_the_leak_rate_counts_what_runs_through_a_hole(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def without_neck(profile: Profile) -> Edges:
        return np.delete(edges_of(profile), 2, axis=0)

    monkeypatch.setattr(leak_rate, "SECONDS", 1.0)
    monkeypatch.setattr("labutopia_lerobot.liquids.surroundings.edges_of", without_neck)
    assert leak_rate.handle(1)["crossings"] > 0
