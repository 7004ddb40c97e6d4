"""What the cameras give: colour, metric depth, segmentation."""

import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.setting import CAMERAS, Setting


@pytest.fixture(scope="module")
def env() -> LabEnv:
    env = LabEnv(Setting("level1/pick"))
    env.reset(seed=3)
    return env


def test_depth_is_in_metres(env):
    depth = env.depth("top")
    assert depth.dtype == np.float32
    # The overhead camera hangs at 2.5 m, the bench top is at 0.775 m; the corner shows bare bench.
    assert depth[5, 128] == pytest.approx(2.5 - 0.775, abs=0.005)


@pytest.mark.parametrize("camera", CAMERAS)
def test_segmentation_names_what_the_camera_sees(env, camera):
    model = env.workcell.simulation.scene.model
    seen = {model.body(index).name for index in np.unique(env.segmentation(camera)) if index >= 0}
    assert {"flask", "bench"} <= seen


def test_colour_comes_back_after_depth_and_segmentation(env):
    before = env.workcell.color("front")
    env.depth("front")
    env.segmentation("front")
    assert np.array_equal(before, env.workcell.color("front"))
    assert before.std() > 10


def test_any_resolution_can_be_asked_for():
    env = LabEnv(Setting("level1/pick", cameras=("front",), width=320, height=180))
    observation, _ = env.reset(seed=0)
    assert observation["pixels"]["front"].shape == (180, 320, 3)
