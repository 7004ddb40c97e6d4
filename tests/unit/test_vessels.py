"""What a vessel is: its shape, its mass, and the body that is built of it."""

import math

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.profile import BOROSILICATE_DENSITY, Profile
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.world.model import COLLISION_GROUP, HULL_GROUP, VISUAL_GROUP
from vessels_on_a_bench import BEAKER_SIZES, FLASK_SIZES, VESSELS, bench, every_vessel


def test_the_mass_of_a_plain_cylinder_is_its_wall_and_bottom_times_density():
    radius, height, wall, bottom = 0.05, 0.12, 0.002, 0.003
    profile = Profile(((radius, 0.0), (radius, height)), wall, bottom)
    ring = 2 * math.pi * (radius - wall / 2) * wall * (height - bottom)
    disc = math.pi * radius**2 * bottom
    assert profile.mass_properties().mass == pytest.approx((ring + disc) * 2230.0, rel=1e-9)


@every_vessel
def test_mass_and_inertia_match_those_of_a_closed_mesh_of_the_wall(vessel):
    outline = [(0.0, 0.0), *vessel.profile.outer, *reversed(vessel.profile.inner)]
    outline.append((0.0, vessel.profile.bottom))
    around, corners = 180, len(outline)
    angles = np.arange(around) * 2 * np.pi / around
    vertices = [(r * np.cos(a), r * np.sin(a), z) for a in angles for r, z in outline]
    faces = []
    for i in range(around):
        for j in range(corners):
            a, d = i * corners + j, i * corners + (j + 1) % corners
            b, c = (k + corners if i < around - 1 else k - i * corners for k in (a, d))
            faces += [(a, b, c), (a, c, d)]
    spec = mujoco.MjSpec()
    spec.add_mesh(
        name="wall",
        uservert=np.ravel(vertices),
        userface=np.ravel(faces),
        inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_EXACT,
    )
    body = spec.worldbody.add_body(name="wall")
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="wall", density=BOROSILICATE_DENSITY)
    wall, mine = spec.compile().body("wall"), vessel.mass_properties
    assert mine.mass == pytest.approx(wall.mass[0], rel=0.005)
    assert mine.com_height == pytest.approx(wall.ipos[2], rel=0.005)
    expected = sorted((mine.transverse_inertia, mine.transverse_inertia, mine.axial_inertia))
    assert sorted(wall.inertia) == pytest.approx(expected, rel=0.02)


@every_vessel
def test_the_compiled_body_has_the_mass_properties_of_the_profile(vessel):
    body = bench(vessel).compile().body(vessel.name)
    mass, com_height, transverse, axial = vessel.mass_properties
    assert body.mass[0] == pytest.approx(mass)
    assert tuple(body.ipos) == pytest.approx((0, 0, com_height))
    assert tuple(body.inertia) == pytest.approx((transverse, transverse, axial))


@every_vessel
def test_the_cavity_is_smaller_than_the_vessel(vessel):
    radii, heights = zip(*vessel.profile.outer, strict=True)
    z = np.linspace(0, vessel.height, 10_001)
    outer_volume_ml = np.pi * np.trapezoid(np.interp(z, heights, radii) ** 2, z) * 1e6
    assert vessel.mass / BOROSILICATE_DENSITY * 1e6 + vessel.capacity == pytest.approx(
        outer_volume_ml, rel=1e-4
    )
    assert 0 < vessel.capacity < outer_volume_ml


@pytest.mark.parametrize(
    ("kind", "sizes", "series"),
    [
        ("conical_flask", FLASK_SIZES, (50, 100, 200, 250, 300, 500, 1000, 2000)),
        ("beaker", BEAKER_SIZES, (50, 100, 150, 250, 400, 600, 800, 1000, 2000)),
    ],
)
def test_the_nominal_volume_is_the_largest_that_leaves_a_tenth_of_the_vessel_empty(
    kind, sizes, series
):
    for size in sizes:
        fitting = [volume for volume in series if volume <= 0.9 * glassware(kind, size).capacity]
        assert size == f"{max(fitting)} ml"


def test_a_graduated_cylinder_for_250_ml_is_the_largest_that_leaves_a_tenth_of_it_empty():
    assert (
        250 <= 0.9 * glassware("measuring_cylinder", "250 ml", "vessel").capacity < 500
    )  # ISO 4788's next


def test_a_volumetric_flask_is_full_in_the_middle_half_of_its_neck():
    flask = glassware("pear_shaped_flask", "250 ml", "vessel")
    mark = flask.profile.fill_height(250e-6)
    assert 0.100 + 0.030 < mark < 0.220 - 0.030
    assert flask.profile.inner_radius(mark) == pytest.approx(flask.grip_width / 2 - 0.0018)


@every_vessel
def test_fill_height_is_the_inverse_of_capacity_below(vessel):
    for share in (0.0, 0.2, 0.7, 1.0):
        volume = share * vessel.capacity * 1e-6
        filled = vessel.profile.capacity_below(vessel.profile.fill_height(volume))
        assert filled == pytest.approx(volume, rel=1e-3)


def test_a_vessel_does_not_take_more_than_it_holds():
    with pytest.raises(ValueError, match="volume must lie between"):
        glassware("beaker", "250 ml", "vessel").profile.fill_height(1e-3)


@pytest.mark.parametrize(
    ("kind", "sizes"), [("conical_flask", FLASK_SIZES), ("beaker", BEAKER_SIZES)]
)
def test_an_unknown_size_is_an_error_that_lists_the_sizes(kind, sizes):
    with pytest.raises(ValueError, match="3 gallons") as error:
        glassware(kind, "3 gallons")
    assert all(size in str(error.value) for size in sizes)


@pytest.mark.parametrize(
    ("outer", "wall", "bottom", "complaint"),
    [
        (((0.04, 0.0), (0.04, 0.0)), 0.002, 0.003, "heights must rise"),
        (((0.04, 0.01), (0.04, 0.1)), 0.002, 0.003, "heights must rise"),
        (((0.04, 0.0), (0.04, 0.1)), 0.05, 0.003, "wall must lie between"),
        (((0.04, 0.0), (0.04, 0.1)), 0.002, 0.2, "bottom must lie between"),
    ],
)
def test_an_impossible_profile_is_refused(outer, wall, bottom, complaint):
    with pytest.raises(ValueError, match=complaint):
        Profile(outer, wall, bottom)


def test_vessels_are_values():
    assert glassware("conical_flask", "300 ml", "flask") == glassware(
        "conical_flask", "300 ml", "flask"
    )
    assert {glassware("conical_flask", "300 ml", "flask"): "full"}[
        glassware("conical_flask", "300 ml", "flask")
    ] == "full"
    assert glassware("conical_flask", "300 ml", "flask") != glassware(
        "conical_flask", "500 ml", "flask"
    )


@every_vessel
def test_every_element_is_named_after_its_vessel(vessel):
    spec = mujoco.MjSpec()
    body = vessel.add_to(spec, spec.worldbody)
    for element in (*body.geoms, *body.sites, *spec.meshes, *spec.materials):
        assert element.name.startswith(f"{vessel.name}_")


def test_two_vessels_of_one_kind_live_in_one_model():
    model = bench(
        glassware("beaker", "250 ml", "left"),
        glassware("beaker", "250 ml", "right"),
    ).compile()
    assert model.body("left").mass == model.body("right").mass


@every_vessel
def test_the_sites_are_where_the_vessel_says(vessel):
    model = bench(vessel).compile()
    assert tuple(model.site("vessel_grasp").pos) == (0, 0, vessel.grip_height)
    assert tuple(model.site("vessel_rim").pos) == (0, 0, vessel.height)


@every_vessel
def test_only_the_invisible_shape_collides_and_the_look_stays_light(vessel):
    model = bench(vessel).compile()
    triangles = 0
    for geom in (model.geom(i) for i in range(model.ngeom)):
        if geom.name == "bench":
            continue
        collides = bool(geom.contype[0] or geom.conaffinity[0])
        assert collides == (geom.group[0] == COLLISION_GROUP)
        assert geom.group[0] in (VISUAL_GROUP, COLLISION_GROUP, HULL_GROUP)
        if geom.group[0] == VISUAL_GROUP:
            triangles += model.mesh_facenum[geom.dataid[0]]
    assert triangles < 1500


@every_vessel
def test_the_hull_encloses_the_vessel(vessel):
    model = bench(vessel).compile()
    hull = [model.geom(f"vessel_hull_{part}") for part in ("lower", "upper")]
    for radius, height in vessel.profile.outer:
        assert any(
            abs(height - geom.pos[2]) <= geom.size[1] + 1e-9 and radius <= geom.size[0] + 1e-9
            for geom in hull
        )


@every_vessel
def test_the_collision_wall_is_round_to_within_a_few_percent(vessel):
    model = bench(vessel, free=False).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    groups = np.array([i == COLLISION_GROUP for i in range(6)], dtype=np.uint8)
    struck = np.zeros(1, dtype=np.int32)
    for azimuth in np.linspace(0, np.pi, 23):
        outward = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        axis = np.array([0.0, 0.0, vessel.grip_height])
        inner = mujoco.mj_ray(model, data, axis, outward, groups, 1, -1, struck)
        outer = 0.2 - mujoco.mj_ray(
            model, data, axis + 0.2 * outward, -outward, groups, 1, -1, struck
        )
        assert inner == pytest.approx(vessel.profile.inner_radius(vessel.grip_height), rel=0.025)
        assert outer == pytest.approx(vessel.grip_width / 2, rel=0.025)


@pytest.mark.parametrize("vessel", VESSELS[:-1], ids=str)
def test_what_is_to_be_picked_fits_the_gripper(vessel):
    franka_hand_stroke = 0.08
    assert vessel.grip_width < franka_hand_stroke


def test_a_plain_tube_of_two_corners_can_be_built_and_stands():
    tube = Vessel("tube", Profile(((0.02, 0.0), (0.02, 0.12)), 0.0012, 0.003), 0.08)
    spec = mujoco.MjSpec()
    tube.add_to(spec, spec.worldbody)
    model = spec.compile()
    hulls = [model.geom(i).name for i in range(model.ngeom) if "hull" in model.geom(i).name]
    assert hulls == ["tube_hull_lower"]
    assert model.geom("tube_hull_lower").size[:2] == pytest.approx((0.02, 0.06))
