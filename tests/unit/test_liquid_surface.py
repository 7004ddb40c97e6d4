"""The surface that is drawn around the particles of a liquid."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.drawing.open_space import PlacedSpace, inside_vessel, look_up
from labutopia_lerobot.liquids.drawing.surface import LiquidSurface, VesselPose, liquid_surface

VOLUME = 1e-7
SPACING = VOLUME ** (1 / 3)
BENCH = 0.775
BEAKER = glassware("beaker", "250 ml", "beaker").profile
UPRIGHT = VesselPose(BEAKER, np.array([0.3, 0.1, BENCH]), np.eye(3))
TILTED = VesselPose(
    BEAKER, np.array([0.3, 0.1, 1.0]), Rotation.from_euler("xz", [40, 25], degrees=True).as_matrix()
)


def filled(vessel: VesselPose, level: float, jitter: float = 0.1) -> np.ndarray:
    """Return a lattice of particles in a vessel, below a height over its origin, each a bit off."""
    profile, origin, axes = vessel
    reach = profile.height + 0.1
    steps = np.arange(-reach, reach, SPACING)
    across, up = steps + 0.3 * SPACING, level - SPACING / 2 - np.arange(0, 2 * reach, SPACING)
    points = np.stack(np.meshgrid(across, across, up), axis=-1).reshape(-1, 3)
    points += np.random.default_rng(0).normal(0, jitter * SPACING, points.shape)
    x, y, z = (points @ axes).T
    radii, heights = zip(*profile.inner, strict=True)
    inside = (z > profile.bottom) & (z < profile.height)
    inside &= np.hypot(x, y) < np.interp(z, heights, radii)
    return points[inside] + origin


def stream(count: int = 40, apart: float = 1.1) -> np.ndarray:
    """Return a falling thread of particles."""
    heights = 1.0 + apart * SPACING * np.arange(count)
    return np.column_stack([np.full(count, 0.3), np.full(count, 0.1), heights])


def scattered(count: int = 60) -> np.ndarray:
    """Return particles in the air that do not touch."""
    grid = np.stack(np.meshgrid(*[np.arange(6) * 5 * SPACING] * 3), axis=-1).reshape(-1, 3)
    shifts = np.random.default_rng(1).uniform(-1, 1, grid.shape) * SPACING
    return (grid + shifts)[:count] + np.array([0.1, 0.2, 0.9])


def puddle() -> np.ndarray:
    """Return one layer of particles on the bench."""
    steps = np.arange(-6, 7) * SPACING
    x, y = (axis.ravel() for axis in np.meshgrid(steps, steps))
    disc = np.hypot(x, y) < 6 * SPACING
    return np.column_stack([x, y, np.full(len(x), BENCH + SPACING / 2)])[disc]


CLOUDS = {
    "upright": (filled(UPRIGHT, 0.05), [UPRIGHT]),
    "tilted": (filled(TILTED, 0.04), [TILTED]),
    "stream": (stream(), []),
    "scattered": (scattered(), []),
    "puddle": (puddle(), [UPRIGHT]),
    "pouring": (np.concatenate([filled(TILTED, 0.03), stream(), scattered()]), [TILTED, UPRIGHT]),
}


@pytest.fixture(params=CLOUDS, scope="module")
def cloud(request):
    positions, vessels = CLOUDS[request.param]
    return positions, vessels, liquid_surface(positions, SPACING, vessels, BENCH)


def triangles(surface: LiquidSurface) -> np.ndarray:
    """Return the corners of all triangles, shape (t, 3, 3)."""
    faces = np.concatenate([surface.quads[:, [0, 1, 2]], surface.quads[:, [0, 2, 3]]])
    return surface.vertices_w.astype(float)[faces]


def volume(surface: LiquidSurface) -> float:
    """Return the volume enclosed, by the divergence theorem."""
    a, b, c = np.moveaxis(triangles(surface) - surface.vertices_w.mean(axis=0), 1, 0)
    return float(np.einsum("ij,ij", a, np.cross(b, c)) / 6)


def winding(surface: LiquidSurface, points: np.ndarray) -> np.ndarray:
    """Return how often the surface goes around points (van Oosterom and Strackee 1983)."""
    turns = []
    for point in points:
        a, b, c = np.moveaxis(triangles(surface) - point, 1, 0)
        la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
        over = np.einsum("ij,ij->i", a, np.cross(b, c))
        dots = [np.einsum("ij,ij->i", *pair) for pair in ((a, b), (b, c), (c, a))]
        under = la * lb * lc + dots[0] * lc + dots[1] * la + dots[2] * lb
        turns.append(np.arctan2(over, under).sum() / (2 * np.pi))
    return np.array(turns)


def pieces(surface: LiquidSurface) -> int:
    """Return how many parts the surface has that do not hang together."""
    pairs = surface.quads[:, [0, 1, 1, 2, 2, 3]].reshape(-1, 2)
    count = len(surface.vertices_w)
    links = coo_array((np.ones(len(pairs)), pairs.T), shape=(count, count))
    return int(connected_components(links)[0])


def clearance(vessel: VesselPose, points: np.ndarray) -> np.ndarray:
    """Return how far points are from wall (horizontally) and bottom; 1 m at and over the rim."""
    x, y, z = ((points - vessel.position_w) @ vessel.rotation_wb).T
    radii, heights = zip(*vessel.profile.inner, strict=True)
    aside = np.interp(z, heights, radii) - np.hypot(x, y)
    return np.where(
        z < vessel.profile.height - 0.001, np.minimum(aside, z - vessel.profile.bottom), 1.0
    )


def test_surfaces_are_closed(cloud):
    *_, surface = cloud
    edges = np.concatenate([surface.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    there, back = (np.sort(e[:, 0].astype(int) << 32 | e[:, 1]) for e in (edges, edges[:, ::-1]))
    assert len(edges) > 0
    assert np.array_equal(there, back)


def test_normals_look_out_of_the_liquid(cloud):
    *_, surface = cloud
    assert np.allclose(np.linalg.norm(surface.normals_w, axis=1), 1, atol=1e-5)
    corners = surface.vertices_w[surface.quads]
    facing = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    assert volume(surface) > 0
    agreeing = np.einsum("ij,ij->i", facing, surface.normals_w[surface.quads].mean(axis=1))
    assert np.mean(agreeing > 0) > 0.97  # not at the sharp edge of a film


def test_no_particle_is_left_undrawn(cloud):
    positions, _, surface = cloud
    far, _ = cKDTree(surface.vertices_w).query(positions)
    hidden = positions[far > SPACING]
    assert np.all(winding(surface, hidden) > 0.99)


@pytest.mark.parametrize(
    ("vessel", "level"),
    [
        (UPRIGHT, BEAKER.bottom + 4 * SPACING),
        (UPRIGHT, BEAKER.bottom + 10 * SPACING),
        (TILTED, 0.04),
    ],
)
def test_a_body_has_the_volume_of_its_particles(vessel, level):
    positions = filled(vessel, level)
    surface = liquid_surface(positions, SPACING, [vessel], BENCH)
    # A little less: the grid rounds off the edges at the glass, the more the flatter the body.
    assert volume(surface) == pytest.approx(len(positions) * VOLUME, rel=0.07)


def test_drops_have_the_volume_of_their_particles():
    positions = scattered()
    surface = liquid_surface(positions, SPACING, [], BENCH)
    assert pieces(surface) == len(positions)
    assert volume(surface) == pytest.approx(len(positions) * VOLUME, rel=0.1)


@pytest.mark.parametrize(("vessel", "level"), [(UPRIGHT, 0.05), (TILTED, 0.04)])
def test_a_settled_surface_is_level_up_to_the_glass(vessel, level):
    surface = liquid_surface(filled(vessel, level), SPACING, [vessel], BENCH)
    top = surface.vertices_w[surface.normals_w[:, 2] > 0.95, 2] - vessel.position_w[2]
    assert len(top) > 100
    assert top.mean() == pytest.approx(level, abs=0.0007)
    assert top.std() < 0.0006
    assert np.abs(top - top.mean()).max() < 0.0025  # in the acute corner of the tilted beaker


@pytest.mark.parametrize(
    ("kind", "size"),
    [("beaker", "250 ml"), ("conical_flask", "300 ml"), ("pear_shaped_flask", "250 ml")],
)
@pytest.mark.parametrize("tilt_deg", [0, 30, 60])
def test_nothing_pokes_out_of_the_glass(kind, size, tilt_deg):
    axes = Rotation.from_euler("x", tilt_deg, degrees=True).as_matrix()
    vessel = VesselPose(glassware(kind, size).profile, np.array([0.3, 0.1, 1.0]), axes)
    positions = filled(vessel, 0.04)
    surface = liquid_surface(positions, SPACING, [vessel], BENCH)
    assert clearance(vessel, positions).min() >= 0
    # Of the surface, in front of the wall: what has run out is outside it, and far.
    gap = clearance(vessel, surface.vertices_w)
    assert gap.min() > 0
    assert gap.min() < 0.0005  # it comes up to the glass


def test_a_thread_is_one_piece_and_drops_apart_are_many():
    assert pieces(liquid_surface(stream(apart=1.1), SPACING, [], BENCH)) == 1
    assert pieces(liquid_surface(stream(40, apart=5.0), SPACING, [], BENCH)) == 40


def test_a_thread_into_a_vessel_is_one_piece():
    x, y, _ = UPRIGHT.position_w
    heights = np.arange(BENCH + 0.05, BENCH + 0.15, SPACING)
    thread = np.column_stack([np.full(len(heights), x), np.full(len(heights), y), heights])
    assert thread[:, 2].min() < BENCH + BEAKER.height < thread[:, 2].max()
    assert pieces(liquid_surface(thread, SPACING, [UPRIGHT], BENCH)) == 1


def test_a_layer_on_the_bench_is_a_flat_puddle():
    surface = liquid_surface(puddle(), SPACING, [], BENCH)
    height = surface.vertices_w[surface.normals_w[:, 2] > 0.95, 2] - BENCH
    assert pieces(surface) == 1
    assert height.mean() == pytest.approx(SPACING, rel=0.2)
    assert height.std() < 0.0006


def test_the_same_particles_give_the_same_surface(cloud):
    positions, vessels, surface = cloud
    again = liquid_surface(positions.copy(), SPACING, vessels, BENCH)
    assert all(np.array_equal(a, b) for a, b in zip(surface, again, strict=True))


def test_no_particles_have_no_surface():
    surface = liquid_surface(np.empty((0, 3)), SPACING, [UPRIGHT], BENCH)
    assert len(surface.quads) == len(surface.vertices_w) == 0


def test_half_of_the_space_is_open_at_a_flat_bottom_and_a_quarter_in_its_corner():
    reach = 2 * SPACING
    space = inside_vessel(BEAKER, reach)

    placed = PlacedSpace(space, np.zeros(3), np.eye(3))

    def share(radius: float, height: float) -> float:
        return look_up(placed, radius, 0.0, height)[2]

    corner = BEAKER.inner[0][0]
    assert share(0.0, BEAKER.bottom) == pytest.approx(0.5, abs=0.03)
    assert share(corner, BEAKER.bottom) == pytest.approx(0.25, abs=0.05)
    assert share(0.0, BEAKER.height / 2) == pytest.approx(1)
    middle = BEAKER.height / 2
    assert share(BEAKER.inner_radius(middle), middle) == pytest.approx(0.5, abs=0.08)
