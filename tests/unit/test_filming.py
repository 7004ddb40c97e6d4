"""Pictures for people: what the task is about is in the middle, shadows fall, edges fade."""

from dataclasses import replace
from statistics import mean

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.beauty_camera import beauty_camera
from labutopia_lerobot.sim.eye import eye_at, eye_of_camera, turned_by_pixels
from labutopia_lerobot.sim.filming import FilmCamera
from labutopia_lerobot.sim.linear_light import graded, light_of, picture_of
from labutopia_lerobot.sim.supersampling import Sample, samples
from labutopia_lerobot.sim.vulkan import vulkan_device
from labutopia_lerobot.sim.workcells import Workcells

needs_vulkan = pytest.mark.skipif(vulkan_device() is None, reason="there is no Vulkan")
PICK = Setting("level1/pick", liquid="off", width=160, height=90)
ASPECT = 160 / 90


@pytest.fixture(scope="module")
def cell():
    cells = Workcells(PICK)
    yield cells.begin(0)[0]
    cells.close()


def in_picture(pose, points):
    """Return where points are in a picture: right and up, -1 to 1, shape (n, 2)."""
    forward = np.array(pose.direction_w) / np.linalg.norm(pose.direction_w)
    right = np.cross(forward, pose.up_w)
    right /= np.linalg.norm(right)
    along = points - np.array(pose.position_w)
    half = np.tan(np.radians(pose.field_of_view_deg) / 2) * (along @ forward)
    up = np.cross(right, forward)
    return np.column_stack([along @ right / half / ASPECT, along @ up / half])


@pytest.mark.parametrize(
    "task", ["level1/pick", "level1/open_door", "level1/press", "level4/liquid_fusion"]
)
def test_the_things_of_a_task_are_in_the_picture_and_fill_it(task):
    cells = Workcells(replace(PICK, task=task))
    cell, _, _ = cells.begin(0)
    scene, data = cell.simulation.scene, cell.simulation.data
    pose = beauty_camera(scene, data, cell.task.view.front, ASPECT)
    things = np.array([data.body(piece.name).xpos for piece in scene.pieces])
    lifted = [data.body(p.name).xpos + np.array([0, 0, 0.2]) for p in scene.pieces if p.movable]
    places = in_picture(pose, np.vstack([things, *lifted]))
    assert np.abs(places).max() < 0.85
    assert pose.position_w[2] > cell.world.bench_height + 0.2  # it looks down on the bench
    cells.close()


def test_in_a_room_the_camera_does_not_stand_behind_a_wall_or_in_a_cupboard():
    cells = Workcells(replace(PICK, room="organic_7"))
    cell, _, _ = cells.begin(0)
    scene, data = cell.simulation.scene, cell.simulation.data
    pose = beauty_camera(scene, data, cell.task.view.front, ASPECT)
    eye, flask = np.array(pose.position_w), data.body("flask").xpos + np.array([0, 0, 0.05])
    met, groups = np.zeros(1, np.int32), np.array([1, 1, 1, 0, 0, 0], np.uint8)
    for start, end in ((eye, flask), (flask, eye)):
        mujoco.mj_ray(scene.model, data, start, end - start, groups, True, -1, met)
        if met[0] >= 0:
            body = scene.model.body(scene.model.geom_bodyid[met[0]]).name
            assert body == "flask"
    cells.close()


def test_an_eye_at_the_pose_of_a_camera_sees_what_the_camera_sees(cell):
    model, data = cell.simulation.scene.model, cell.simulation.data
    named, placed = eye_of_camera(model, data, "front"), eye_at(model, cell.task.view.front)
    for part in ("pos", "forward", "up"):
        assert np.allclose(getattr(named, part), getattr(placed, part), atol=1e-5)
    assert placed.frustum_top == pytest.approx(named.frustum_top, rel=1e-4)
    assert placed.frustum_near == pytest.approx(named.frustum_near, rel=1e-4)


def test_an_eye_that_turns_by_ten_pixels_moves_the_picture_by_ten_pixels(cell):
    data, height = cell.simulation.data, PICK.height
    eye = eye_at(cell.simulation.scene.model, cell.task.view.front)
    middle = Sample(0.0, 0.0, (0.0, 0.0), glass_shades=True)
    before = cell.renderer.exposure(data, eye, middle)
    after = cell.renderer.exposure(data, turned_by_pixels(eye, 10, 0, height), middle)
    assert np.abs(after[20:70, 20:-30] - before[20:70, 30:-20]).mean() < 0.01
    assert np.abs(after - before).mean() > 0.01


def test_samples_spread_over_the_pixel_and_over_the_lamp():
    drawn = samples(16)
    for values in (
        [each.right for each in drawn],
        [each.up for each in drawn],
        [each.lamp[0] / 2 for each in drawn],
        [each.lamp[1] / 2 for each in drawn],
    ):
        assert abs(mean(values)) < 0.07
        assert max(values) > 0.3
        assert min(values) < -0.3
        assert max(map(abs, values)) <= 0.5
    assert len({(each.right, each.up) for each in drawn}) == 16


def test_more_exposures_make_softer_edges(cell):
    quick, smooth = (FilmCamera(cell, "front", ASPECT, count).picture() for count in (1, 8))
    steps = [np.abs(np.diff(each.astype(int), axis=1)).max(axis=-1) for each in (quick, smooth)]
    assert (steps[1] > 60).sum() < 0.7 * (steps[0] > 60).sum()
    assert abs(quick.mean() - smooth.mean()) < 3


@needs_vulkan
def test_shadows_move_with_the_place_that_the_lamp_shines_from_and_walls_cast_none():
    cells = Workcells(replace(PICK, renderer="filament"))
    cell, _, _ = cells.begin(0)
    plain = cell.color("front")
    data, eye = cell.simulation.data, eye_at(cell.simulation.scene.model, cell.task.view.front)
    left, right = (
        cell.renderer.exposure(data, eye, Sample(0.0, 0.0, (place, 0.0), glass_shades=True))
        for place in (-1.0, 1.0)
    )
    moved = np.abs(left - right).max(axis=-1) > 0.05
    assert 20 < moved.sum() < 0.1 * moved.size  # edges of shadows: the arm's and the flask's
    brighter = picture_of(left).mean() / plain.mean()  # if the ceiling shaded all: 0.8
    assert 0.98 < brighter < 1.2
    cells.close()


@needs_vulkan
def test_filming_leaves_the_pictures_of_policies_as_they_are():
    cells = Workcells(replace(PICK, renderer="filament"))
    cell, _, _ = cells.begin(0)
    before = cell.color("front")
    FilmCamera(cell, "beauty", ASPECT, 3).picture()
    assert np.array_equal(cell.color("front"), before)
    cells.close()


def test_light_and_pictures_are_each_others_inverse_and_grading_keeps_black_white_and_grey():
    levels = np.arange(256, dtype=np.uint8)[:, None].repeat(3, axis=1)
    assert np.array_equal(picture_of(light_of(levels)), levels)
    greys = graded(light_of(levels))
    assert np.ptp(greys, axis=1).max() < 1e-6
    assert greys[0, 0] == 0.0
    assert greys[-1, 0] == 1.0
    assert (np.diff(greys[:, 0]) >= 0).all()
    dull = graded(np.array([[0.5, 0.4, 0.4]], np.float32))[0]
    assert dull[0] - dull[1] > 0.1
