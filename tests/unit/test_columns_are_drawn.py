"""What stands in a burette is drawn: a closed column, as high as its volume says."""

from dataclasses import replace

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.handling.burette_stand import BuretteStand
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.liquids.drawing.column import Column, column_surface
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import BURETTE_VIEW
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import ETHANOL, WATER

BURETTE = replace(glassware("burette", "50 ml", "burette"), clamped=True)
HERE = np.array([0.3, 0.1, 0.9])


def volume(vertices: np.ndarray, quads: np.ndarray) -> float:
    """Return what a closed mesh encloses [m^3]; negative if it is inside out."""
    corners = (vertices - HERE)[quads].astype(float)
    first = np.einsum("ni,ni->n", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    second = np.einsum("ni,ni->n", corners[:, 0], np.cross(corners[:, 2], corners[:, 3]))
    return float((first + second).sum() / 6)


@pytest.mark.parametrize("ml", [2.0, 5.0, 50.0])
def test_it_is_as_high_as_its_volume_says(ml):
    tube = VesselPose(BURETTE.profile, HERE, np.eye(3))
    surface = column_surface(Column(tube, ml * 1e-6, np.ones(4)))
    top = float(surface.vertices_w[:, 2].max() - HERE[2])
    assert top == pytest.approx(BURETTE.profile.fill_height(ml * 1e-6), abs=1e-6)
    # Twelve corners, and a gap to the glass: a tenth is not drawn.
    assert volume(surface.vertices_w, surface.quads) == pytest.approx(0.89e-6 * ml, rel=0.05)


@pytest.fixture
def stand() -> BuretteStand:
    return BuretteStand("stand")


def filled(stand: BuretteStand, fillings: dict) -> Simulation:
    beaker = glassware("beaker_low", "150 ml", "beaker")
    contents = {stand.burette: fillings["burette"]}
    if "beaker" in fillings:
        contents[beaker] = fillings["beaker"]
    scene = compile_scene([stand, beaker], PANDA, LABORATORY, BURETTE_VIEW, contents, 500)
    simulation = Simulation(scene)
    simulation.reset({stand: Placement(0.25, 0.0, -1.57), beaker: Placement(0.1, -0.3, 0.0)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def blue_rows(simulation: Simulation) -> np.ndarray:
    """Return in which rows of a picture the burette is blue: its glass is, but a little."""
    model = simulation.scene.model
    assert simulation.scene.liquid is not None
    renderer = ClassicRenderer(model, 256, 256, [simulation.scene.liquid])
    simulation.draw_liquid()
    seen = renderer.segmentation(simulation.data, "front") == model.body("stand_burette").id
    color = renderer.color(simulation.data, "front").astype(int)
    renderer.close()
    blue = color[..., 2] - color[..., 0] > 60
    return np.flatnonzero((seen & blue).any(axis=1))


@pytest.mark.slow
def test_a_camera_sees_its_level_sink(stand):
    simulation = filled(stand, {"burette": Filling(ml=45.0)})
    before = blue_rows(simulation)
    simulation.data.joint(stand.stopcock.joint).qpos[:] = stand.stopcock.widest
    for _ in range(300):
        simulation.step(simulation.command)
    assert blue_rows(simulation)[0] > before[0] + 5


def test_of_two_liquids_the_column_has_its_own_colour(stand):
    fillings = {"burette": Filling(ml=45.0, of="ethanol"), "beaker": Filling(ml=50.0)}
    simulation = filled(stand, fillings)
    simulation.draw_liquid()
    texels = simulation.scene.liquid.quads[2].astype(float)
    ethanol, water = ETHANOL.rgba, WATER.rgba
    assert texels[-1, :3] / 255 == pytest.approx(ethanol[:3], abs=0.01)
    assert texels[0, :3] / 255 == pytest.approx(water[:3], abs=0.01)
