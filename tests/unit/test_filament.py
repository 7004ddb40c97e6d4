"""Filament draws the scene that the classic renderer draws, and says where it cannot."""

import os
import subprocess
import sys
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.setting import Setting, UnknownOptionError
from labutopia_lerobot.sim.filament_light import light_for_filament
from labutopia_lerobot.sim.filament_renderer import FilamentRenderer, NoFilamentError
from labutopia_lerobot.sim.renderers import renderer_name
from labutopia_lerobot.sim.vulkan import vulkan_device
from labutopia_lerobot.sim.workcells import Workcells

needs_vulkan = pytest.mark.skipif(vulkan_device() is None, reason="there is no Vulkan")
PICK = Setting("level1/pick", liquid="off", width=160, height=120)
AWAY = 1.0
"""How far a thing is taken out of the picture [m]."""


def differ(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Tell for each pixel whether it is another colour."""
    return np.abs(first.astype(int) - second).max(axis=-1) > 4


@pytest.fixture(scope="module")
def cells():
    """Return the same episode, drawn by both."""
    kept = {kind: Workcells(replace(PICK, renderer=kind)) for kind in ("classic", "filament")}
    yield {kind: each.begin(0)[0] for kind, each in kept.items()}
    for each in kept.values():
        each.close()


@needs_vulkan
@pytest.mark.parametrize("camera", ["front", "top", "wrist"])
def test_a_thing_is_where_the_classic_renderer_draws_it(cells, camera):
    where = cells["classic"].segmentation(camera)
    flask = where == cells["classic"].simulation.scene.model.body("flask").id
    cell = cells["filament"]
    data = cell.simulation.data
    before, pose = cell.color(camera), data.joint("flask_free").qpos.copy()
    data.joint("flask_free").qpos[1] += AWAY
    mujoco.mj_forward(data.model, data)
    seen = differ(before, cell.color(camera))
    data.joint("flask_free").qpos = pose
    mujoco.mj_forward(data.model, data)
    assert flask.sum() > 100
    assert (seen & flask).sum() > 0.8 * flask.sum()
    middles = [np.array(np.nonzero(mask)).mean(axis=1) for mask in (flask, seen)]
    assert np.abs(middles[0] - middles[1]).max() < 4  # shade beside it is seen, too


@needs_vulkan
def test_one_moment_gives_the_same_bits_whatever_was_drawn_before(cells):
    cell = cells["filament"]
    first = cell.color("front")
    for camera in ("top", "wrist", "top"):
        cell.color(camera)
    assert np.array_equal(first, cell.color("front"))
    assert first.shape == (120, 160, 3)
    assert 60 < first.mean() < 200
    assert (first == 255).all(axis=-1).mean() < 0.03


@needs_vulkan
def test_what_an_episode_changes_of_the_look_is_seen(cells):
    cell = cells["filament"]
    model, before = cell.simulation.scene.model, cell.color("front")
    bench = model.material("bench_top")
    rgba = bench.rgba.copy()
    bench.rgba = (0.8, 0.1, 0.1, 1.0)
    red = cell.color("front")
    bench.rgba = rgba
    assert (red[-20:, :, 0].astype(int) - before[-20:, :, 0]).mean() > 30
    assert np.array_equal(cell.color("front"), before)


def pane_and_pool(colors: list[tuple[float, ...]]) -> tuple[mujoco.MjModel, LiquidDrawing]:
    """Return a floor, a hot plate and a liquid."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    light_for_filament(spec)
    spec.visual.headlight.diffuse = [0.12] * 3  # as in the laboratory
    plate = instrument("stirring_hot_plate", "plate")
    plate.add_to(spec, spec.worldbody)
    spec.worldbody.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE, size=[2, 2, 0.1], rgba=[0.4, 0.4, 0.4, 1]
    )
    spec.worldbody.add_light(
        dir=[0.5, 0.0, -0.8], type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, diffuse=[0.4] * 3
    )
    facing = [0.5, 0.5, -0.5, -0.5]  # along +x, z up
    spec.worldbody.add_camera(name="front", pos=[-0.6, 0.0, 0.06], quat=facing, fovy=30)
    spec.worldbody.add_camera(name="top", pos=[-0.5, 0.0, 1.0], fovy=30)
    liquid = LiquidDrawing.add_to(spec, "pool", colors, 0.01, 500, skin=False)
    return spec.compile(), liquid


def pool(at: float) -> np.ndarray:
    """Return the particles of a puddle, shape (n, 3) [m]."""
    x, y = np.meshgrid(np.arange(-5, 5), np.arange(-5, 5))
    flat = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=-1) * 0.01
    layers = [flat + np.array([at, 0.0, height]) for height in (0.005, 0.015)]
    return np.vstack(layers)


@needs_vulkan
def test_a_liquid_is_seen_where_it_is_in_its_colour_and_goes_again():
    model, liquid = pane_and_pool([(0.1, 0.2, 0.9, 0.9)])
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    renderer = FilamentRenderer(model, 120, 120, [liquid])
    dry = renderer.color(data, "top")
    liquid.extract(pool(-0.5), (), 0.0)
    wet = renderer.color(data, "top")
    seen = differ(dry, wet)
    rows, columns = np.nonzero(seen)
    assert seen[55:65, 55:65].all()
    assert 0.02 < seen.mean() < 0.08  # 0.10 m of 0.54 m to each side
    assert abs(rows.mean() - 60) < 3
    assert abs(columns.mean() - 60) < 3
    red, _, blue = wet[60, 60].astype(int)
    assert blue > red + 40
    liquid.extract(np.zeros((0, 3)), (), 0.0)
    assert np.array_equal(renderer.color(data, "top"), dry)
    renderer.close()


@needs_vulkan
def test_two_liquids_have_two_colours():
    model, liquid = pane_and_pool([(0.1, 0.2, 0.9, 0.9), (0.9, 0.1, 0.1, 0.9)])
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    particles = pool(-0.5)
    second = particles[:, 1] > 0.0
    liquid.extract(particles, (), 0.0, liquid.colors[second.astype(int)])
    renderer = FilamentRenderer(model, 120, 120, [liquid])
    picture = renderer.color(data, "top").astype(int)
    renderer.close()
    (left, right) = picture[52, 60], picture[68, 60]  # y is up in the picture
    assert left[0] > left[2] + 40
    assert right[2] > right[0] + 40


@needs_vulkan
def test_a_display_shows_the_reading_of_now():
    model, _ = pane_and_pool([(0.1, 0.2, 0.9, 0.9)])
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    apparatus = Apparatus(model, data, instrument("stirring_hot_plate", "plate").processes)
    apparatus.start(np.random.default_rng(0))
    renderer = FilamentRenderer(model, 200, 200, (), apparatus)
    slow = renderer.color(data, "front")
    speed = data.joint("plate_speed_hinge")
    speed.qpos[0] = np.radians(300.0)  # without forward kinematics nothing else has moved
    apparatus.step()
    fast = renderer.color(data, "front")
    assert 3 < differ(slow, fast).sum() < 2000
    speed.qpos[0] = 0.0
    for _ in range(round(3.0 / apparatus.period)):
        apparatus.step()
    assert np.array_equal(renderer.color(data, "front"), slow)
    renderer.close()


@needs_vulkan
def test_what_it_cannot_draw_it_refuses(cells):
    for draw in (cells["filament"].depth, cells["filament"].segmentation):
        with pytest.raises(NoFilamentError, match="choose renderer=classic"):
            draw("front")


def test_a_setting_that_it_cannot_draw_is_refused():
    with pytest.raises(UnknownOptionError, match="needs renderer=classic"):
        replace(PICK, renderer="filament", extras=("depth",))
    assert replace(PICK, renderer="filament", extras=("forces",)).extras == ("forces",)
    with pytest.raises(UnknownOptionError, match="Choose from: classic, filament"):
        replace(PICK, renderer="vulkan")


@needs_vulkan
def test_the_two_have_names_that_nobody_takes_for_each_other():
    assert renderer_name("filament").startswith("Filament on ")
    assert "Filament" not in renderer_name("classic")


PLAY = """
import json
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.setting import Setting
env = LabEnv(Setting("level1/pick", liquid="off", renderer="filament"))
try:
    observation, _ = env.reset(seed=0)
except UserError as error:
    raise SystemExit(str(error))
print(json.dumps({name: picture.shape for name, picture in observation["pixels"].items()}))
"""


def playing(**environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", PLAY],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_without_vulkan_it_is_said_what_to_install():
    done = playing(VK_DRIVER_FILES="/nowhere.json", VK_ICD_FILENAMES="/nowhere.json")
    assert done.returncode == 1
    assert "apt-get install libvulkan1 mesa-vulkan-drivers" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@needs_vulkan
def test_nothing_but_what_a_program_says_is_on_its_output():
    done = playing()
    assert done.returncode == 0, done.stderr
    (line,) = done.stdout.splitlines()
    assert line.startswith('{"front": [256, 256, 3]')
