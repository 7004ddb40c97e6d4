"""Several substances in one picture: each in its colour, and in between where they mix."""

import mujoco
import numpy as np
import pytest
from scipy.ndimage import binary_dilation

from labutopia_lerobot.chemistry.palette import Palette
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.drawing.liquid_drawing import LiquidDrawing
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.liquids.drawing.surface_colors import colors_at
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer

SPACING = 1e-7 ** (1 / 3)
BLUE, RED = (0.1, 0.2, 0.9, 0.8), (0.9, 0.2, 0.1, 0.8)
PLACES = {
    glassware("beaker", "250 ml", "left"): (0.25, -0.1),
    glassware("beaker", "250 ml", "right"): (0.25, 0.1),
}


class Scene:
    """Two beakers with a layer of liquid each, of blue and red, seen from above."""

    def __init__(self, *colors: tuple[float, float, float, float]) -> None:
        spec = LABORATORY.build(VESSEL_VIEW)
        spec.stat.extent = 1.0
        spec.visual.map.znear, spec.visual.map.zfar = 0.01, 20.0
        self.poses = []
        for vessel, place in PLACES.items():
            body = vessel.add_to(spec, spec.worldbody)
            body.pos = (*place, LABORATORY.bench.height)
            self.poses.append(VesselPose(vessel.profile, np.array(body.pos), np.eye(3)))
        self.liquid = LiquidDrawing.add_to(spec, "both", colors, SPACING, 2000)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.renderer = ClassicRenderer(self.model, 256, 256, (self.liquid,))

    def picture(self, left: float, right: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the mean colour of either beaker's liquid, of which so much is red."""
        disc = cylinder(0.03, 5)
        positions = np.concatenate([pose.position_w + disc + (0, 0, 0.003) for pose in self.poses])
        red = np.repeat([left, right], len(disc))
        amounts = np.column_stack([1 - red, red])
        self.liquid.extract(
            positions, self.poses, LABORATORY.bench.height, amounts @ self.liquid.colors
        )
        color = self.renderer.color(self.data, "top").astype(int)
        body = self.model.body("both").id
        seen = self.renderer.segmentation(self.data, "top") == body
        # The beakers stand side by side along the picture's width.
        aside = np.arange(256) < 128
        first = [color[seen & side].mean(axis=0) for side in (aside, ~aside)]
        camera = self.data.cam("top")
        right_way = camera.xmat.reshape(3, 3)[1, 0] > 0  # does y grow to the right?
        return tuple(first) if right_way else tuple(first[::-1])


def cylinder(radius: float, layers: int) -> np.ndarray:
    """Return particles in a cylinder that stands on the origin."""
    steps = np.arange(-8, 9) * SPACING
    points = np.stack(np.meshgrid(steps, steps, (np.arange(layers) + 0.5) * SPACING), axis=-1)
    points = points.reshape(-1, 3)
    return points[np.hypot(points[:, 0], points[:, 1]) < radius]


@pytest.fixture(scope="module")
def scene() -> Scene:
    return Scene(BLUE, RED)


def test_two_substances_side_by_side_have_their_own_colours(scene: Scene) -> None:
    left, right = scene.picture(0.0, 1.0)
    assert left[2] - left[0] > 60
    assert right[0] - right[2] > 60
    other_left, other_right = scene.picture(1.0, 0.0)  # in the next frame they have changed places
    assert other_left == pytest.approx(right, abs=12)
    assert other_right == pytest.approx(left, abs=12)


def test_a_mixture_has_a_colour_in_between(scene: Scene) -> None:
    blue, red = scene.picture(0.0, 1.0)
    mixed, rather_red = scene.picture(0.5, 0.75)
    assert mixed == pytest.approx((blue + red) / 2, abs=12)
    assert mixed[0] + 10 < rather_red[0] < red[0]


def test_a_substance_is_as_transparent_as_its_own_opacity_says() -> None:
    faint = (*RED[:3], 0.2)
    strong, weak = Scene(BLUE, RED).picture(0.0, 1.0)[1], Scene(BLUE, faint).picture(0.0, 1.0)[1]
    assert strong[0] - strong[2] > 2 * (weak[0] - weak[2])


def test_one_of_several_substances_looks_as_if_it_were_the_only_one(scene: Scene) -> None:
    alone = Scene(BLUE)
    disc = cylinder(0.03, 5) + scene.poses[0].position_w + (0, 0, 0.003)
    pictures = []
    for each in (scene, alone):
        each.liquid.extract(
            disc,
            each.poses,
            LABORATORY.bench.height,
            each.liquid.colors[[0] * len(disc)],
        )
        pictures.append(each.renderer.color(each.data, "top").astype(int))
    segments = alone.renderer.segmentation(alone.data, "top")
    seen, glass = (segments == alone.model.body(name).id for name in ("both", "left"))
    # A texture tints highlights too, so that single pixels may differ.
    one, other = (picture[seen].mean(axis=0) for picture in pictures)
    assert one == pytest.approx(other, abs=14)
    beside = ~binary_dilation(seen | glass)
    assert np.array_equal(pictures[0][beside], pictures[1][beside])


def test_a_colour_is_the_mean_of_the_particles_around() -> None:
    line = np.array([[0.0, 0.0, 0.0], [0.01, 0.0, 0.0]])
    colors = np.array([[1.0, 0.0], [0.0, 1.0]])
    points = np.array([[0.0, 0, 0], [0.005, 0, 0], [0.0025, 0, 0], [0.5, 0, 0]], np.float32)
    found = colors_at(points, line, colors, 0.008)
    assert found[:2] == pytest.approx(np.array([[1.0, 0.0], [0.5, 0.5]]), abs=1e-6)
    assert found[2, 0] > 0.7
    assert not found[3].any()


def test_a_stated_colour_is_that_of_a_vessel_so_that_a_strong_solution_is_not_black() -> None:
    """Copper sulfate of 0.5 mol/l is a deep blue in a beaker."""
    weak, strong = Palette(["Cu^2+(aq)"], {}).seen(np.array([[100.0], [500.0]]))[:, :3]
    assert 0.35 < weak[0] < weak[1] < weak[2]
    assert strong[0] < 0.05 < strong[1] < 0.5 < strong[2]
