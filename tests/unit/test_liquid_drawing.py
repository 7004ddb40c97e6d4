"""Liquids in the pictures: colour, depth, segmentation."""

import mujoco
import numpy as np
import pytest
from scipy.ndimage import binary_dilation

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer

SPACING = 1e-7 ** (1 / 3)
BLUE, RED = (0.1, 0.3, 0.9, 0.6), (0.9, 0.2, 0.1, 0.6)
VESSELS = {
    glassware("beaker", "250 ml", "left"): (0.25, -0.1),
    glassware("beaker", "250 ml", "right"): (0.25, 0.1),
}
PUDDLE = (0.1, 0.0)


class Scene:
    """Two beakers on the bench, room for a blue and a red liquid, and a renderer."""

    def __init__(self) -> None:
        spec = LABORATORY.build(VESSEL_VIEW)
        spec.stat.extent = 1.0
        spec.visual.map.znear, spec.visual.map.zfar = 0.01, 20.0
        self.poses = {}
        for vessel, (x, y) in VESSELS.items():
            body = vessel.add_to(spec, spec.worldbody)
            body.pos = (x, y, LABORATORY.bench.height)
            self.poses[vessel.name] = VesselPose(vessel.profile, np.array(body.pos), np.eye(3))
        self.blue = LiquidDrawing.add_to(spec, "blue", [BLUE], SPACING, 1000)
        self.red = LiquidDrawing.add_to(spec, "red", [RED], SPACING, 1000)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.renderer = ClassicRenderer(self.model, 256, 256, (self.blue, self.red))

    def show(self, blue: np.ndarray, red: np.ndarray) -> None:
        """Let the next pictures show these particles, shape (n, 3)."""
        for liquid, positions in ((self.blue, blue), (self.red, red)):
            liquid.extract(positions, list(self.poses.values()), LABORATORY.bench.height)

    def contents(self, vessel: str) -> np.ndarray:
        """Return particles that fill a vessel 6 spacings high."""
        profile, origin, _ = self.poses[vessel]
        cloud = cylinder(profile.inner_radius(profile.bottom), 6)
        return cloud + origin + np.array([0, 0, profile.bottom])

    def color(self, camera: str) -> np.ndarray:
        """Return a colour picture."""
        return self.renderer.color(self.data, camera).astype(int)

    def seen(self, camera: str, body: str) -> np.ndarray:
        """Return where a camera sees a body, shape (256, 256)."""
        return self.renderer.segmentation(self.data, camera) == self.model.body(body).id


NOTHING = np.empty((0, 3))


def cylinder(radius: float, layers: int) -> np.ndarray:
    """Return particles in a cylinder that stands on the origin."""
    steps = np.arange(-20, 21) * SPACING
    x, y, z = np.meshgrid(steps, steps, (np.arange(layers) + 0.5) * SPACING)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    return points[np.hypot(points[:, 0], points[:, 1]) < radius]


def puddle() -> np.ndarray:
    """Return one layer of particles on the bench, 6 cm wide."""
    return cylinder(0.03, 1) + np.array([*PUDDLE, LABORATORY.bench.height])


@pytest.fixture(scope="module")
def scene() -> Scene:
    return Scene()


@pytest.mark.parametrize("camera", ["front", "top"])
def test_a_camera_sees_the_liquid_through_the_glass_and_nowhere_else(scene, camera):
    scene.show(NOTHING, NOTHING)
    dry = scene.color(camera)
    beaker_seen = scene.seen(camera, "left")
    scene.show(scene.contents("left"), NOTHING)
    changed = np.abs(scene.color(camera) - dry).max(axis=-1) > 8
    assert changed.sum() > 0.3 * beaker_seen.sum()
    assert not np.any(changed & ~binary_dilation(beaker_seen, iterations=2))


@pytest.mark.parametrize("camera", ["front", "top"])
def test_liquids_have_the_colours_of_their_substances(scene, camera):
    scene.show(NOTHING, NOTHING)
    dry = scene.color(camera)
    vessels = [scene.seen(camera, name) for name in ("left", "right")]
    scene.show(scene.contents("left"), scene.contents("right"))
    tint = scene.color(camera) - dry
    left, right = (tint[vessel].mean(axis=0) for vessel in vessels)
    assert left[2] - left[0] > 12  # on the mean over a beaker that is a third full
    assert right[0] - right[2] > 12


def test_liquid_is_transparent(scene):
    scene.show(NOTHING, NOTHING)
    dry = scene.color("top")
    scene.show(puddle(), NOTHING)
    wet = scene.color("top")[scene.seen("top", "blue")]
    assert np.all(np.abs(wet - np.array(BLUE[:3]) * 255).max(axis=-1) > 8)
    assert np.all(np.abs(wet - dry[128, 128]).max(axis=-1) > 8)


def test_a_tenth_of_a_millilitre_on_the_bench_is_seen(scene):
    scene.show(NOTHING, NOTHING)
    dry = scene.color("top")
    scene.show(np.array([[*PUDDLE, LABORATORY.bench.height + SPACING / 2]]), NOTHING)
    assert np.any(np.abs(scene.color("top") - dry).max(axis=-1) > 20)


def test_depth_is_that_of_the_liquids_surface(scene):
    scene.show(NOTHING, NOTHING)
    dry = scene.renderer.depth(scene.data, "top")
    scene.show(puddle(), NOTHING)
    wet = scene.renderer.depth(scene.data, "top")
    puddle_seen = scene.seen("top", "blue")
    assert np.median((dry - wet)[puddle_seen]) == pytest.approx(SPACING, abs=0.001)
    assert np.array_equal(dry[~puddle_seen], wet[~puddle_seen])


def test_segmentation_calls_a_liquid_by_its_own_body(scene):
    scene.show(scene.contents("left"), puddle())
    segments = np.unique(scene.renderer.segmentation(scene.data, "top"))
    names = {scene.model.body(index).name for index in segments if index >= 0}
    assert {"blue", "red", "left", "right", "bench"} <= names
    # A beaker's glass is in front of what is in it, but not over its mouth.
    assert not scene.seen("front", "blue").any()


def test_pictures_without_liquid_are_as_if_there_were_none(scene):
    scene.show(scene.contents("left"), puddle())
    scene.color("front")
    scene.show(NOTHING, NOTHING)
    without = ClassicRenderer(scene.model, 256, 256)
    try:
        assert np.array_equal(scene.color("front"), without.color(scene.data, "front"))
        assert np.array_equal(
            scene.renderer.segmentation(scene.data, "top"), without.segmentation(scene.data, "top")
        )
    finally:
        without.close()


def test_colour_comes_back_after_depth_and_segmentation(scene):
    scene.show(scene.contents("left"), scene.contents("right"))
    before = scene.color("front")
    scene.renderer.depth(scene.data, "front")
    scene.renderer.segmentation(scene.data, "front")
    assert np.array_equal(before, scene.color("front"))


def test_every_particle_may_be_a_drop_of_its_own(scene):
    grid = np.stack(np.meshgrid(*[np.arange(10) * 5.3 * SPACING] * 3), axis=-1).reshape(-1, 3)
    surface = scene.blue.extract(grid + np.array([0.0, 0.0, 1.0]), [], LABORATORY.bench.height)
    assert len(grid) == 1000
    assert len(surface.quads) > 20 * len(grid)


def test_more_particles_than_were_promised_are_refused():
    drawing = LiquidDrawing.add_to(mujoco.MjSpec(), "few", [BLUE], SPACING, 1)
    apart = np.array([[0.0, 0.0, 1.0], [0.1, 0.0, 1.0], [0.2, 0.0, 1.0]])
    with pytest.raises(RuntimeError, match="3 particles of few"):
        drawing.extract(apart, [], LABORATORY.bench.height)


def test_a_viewer_is_given_as_much_liquid_as_there_is_and_forgets_what_was(scene: Scene) -> None:
    shown = mujoco.MjvScene(scene.model, 10_000)
    for positions in (scene.contents("left"), puddle()):
        scene.blue.draw_particles(shown, positions)
        balls = shown.geoms[: shown.ngeom]
        assert np.allclose([ball.pos for ball in balls], positions, atol=1e-6)
        volume = sum(4 / 3 * np.pi * ball.size[0] ** 3 for ball in balls)
        assert volume == pytest.approx(len(positions) * SPACING**3, rel=1e-5)
