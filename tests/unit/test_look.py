"""What makes pictures good to look at, and must not be in depth, segmentation or physics."""

import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.liquids.drawing.strands import FALL, LINK, strands
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.contact_shadows import ContactShadows

SPACING = 0.005


@pytest.fixture(scope="module")
def env() -> LabEnv:
    env = LabEnv(Setting("level1/pick", obs="state", liquid="off"))
    env.reset(seed=0)
    return env


def pictures(env: LabEnv, shadows: bool) -> dict[str, NDArray]:
    """Colour, depth and segmentation from above, with or without the spots."""
    renderer = env.workcell.renderer
    kept = renderer._shadows
    if not shadows:
        renderer._shadows = None
    data = env.workcell.simulation.data
    taken = {
        "color": renderer.color(data, "top").astype(int),
        "depth": renderer.depth(data, "top"),
        "segmentation": renderer.segmentation(data, "top"),
    }
    renderer._shadows = kept
    return taken


def test_what_stands_darkens_the_bench_around_it_and_nothing_else(env):
    lit, shaded = pictures(env, shadows=False), pictures(env, shadows=True)
    darker = (lit["color"] - shaded["color"]).sum(axis=-1)
    model = env.workcell.simulation.scene.model
    assert darker.max() > 30
    assert darker.min() >= 0
    assert (darker > 3).mean() < 0.1
    bench = lit["segmentation"] == model.body("bench").id
    assert (darker[bench] > 3).any()
    np.testing.assert_array_equal(lit["depth"], shaded["depth"])
    np.testing.assert_array_equal(lit["segmentation"], shaded["segmentation"])


def test_a_spot_fades_as_its_thing_is_lifted(env):
    simulation = env.workcell.simulation
    scene, data = simulation.scene, simulation.data
    before = simulation.state()
    shadows = ContactShadows(scene.model, ["flask"], scene.room.bench)
    drawn = env.workcell.renderer._renderer.scene
    opacities = []
    for lift in (0.0, 0.1, 0.2, 1.0):
        data.body("flask").xpos[2] += lift
        drawn.ngeom = 0
        shadows.draw(drawn, data)
        opacities.append(drawn.geoms[0].rgba[3] if drawn.ngeom else 0.0)
        data.body("flask").xpos[2] -= lift
    simulation.restore(before)
    assert opacities[0] > 2 * opacities[1] > 4 * opacities[2] > 0.0
    assert opacities[3] == 0.0


def test_an_empty_flask_lets_the_bench_be_seen_through_its_middle(env):
    renderer, simulation = env.workcell.renderer, env.workcell.simulation
    model, data = simulation.scene.model, simulation.data
    seen = renderer.color(data, "front").astype(float)
    flask = renderer.segmentation(data, "front") == model.body("flask").id
    opaque = model.mat_rgba.copy()
    for material in range(model.nmat):
        if model.material(material).name.startswith("flask_"):
            model.mat_rgba[material, 3] = 0.0
    without = renderer.color(data, "front").astype(float)
    model.mat_rgba[:] = opaque
    change = np.abs(seen - without).sum(axis=-1)
    rows = np.flatnonzero(flask.any(axis=1))
    row = rows[len(rows) * 2 // 3]
    columns = np.flatnonzero(flask[row])
    third = len(columns) // 3
    outline = change[row, columns[[0, 1, -2, -1]]].mean()
    assert change[row, columns[third:-third]].min() < 0.5 * outline


def test_lone_drops_are_drawn_where_they_are():
    apart = np.array([[0.0, 0.0, 0.0], [0.05, 0.0, 0.0], [0.0, 0.0, 0.1]])
    points, weights = strands(apart, np.ones(3, np.float32), SPACING)
    np.testing.assert_allclose(points, apart)
    np.testing.assert_array_equal(weights, 1.0)


def test_threads_join_what_falls_in_a_stream_but_not_what_falls_side_by_side():
    row = np.arange(12) * 0.9 * LINK * FALL * SPACING / 2
    stream = np.column_stack([0 * row, 0 * row, row])
    assert len(strands(stream, np.ones(12, np.float32), SPACING)[0]) > 24
    abreast = 2 * stream[:, ::-1]
    assert len(strands(abreast, np.ones(12, np.float32), SPACING)[0]) == 12


def test_a_ragged_stream_is_drawn_smoother_than_it_is():
    rng = np.random.default_rng(0)
    off = rng.normal(0, 0.5 * SPACING, (40, 2))
    stream = np.column_stack([off, np.arange(40) * 0.6 * SPACING])
    points, _ = strands(stream, np.ones(40, np.float32), SPACING)
    assert np.std(points[:40, :2]) < 0.5 * np.std(off)


def test_there_are_never_more_than_three_balls_of_thread_for_a_particle():
    cloud = np.random.default_rng(0).uniform(0, 30 * SPACING, (4000, 3))
    for scale in (0.3, 0.6, 1.0):
        points, _ = strands(scale * cloud, np.ones(4000, np.float32), SPACING)
        assert len(points) <= 16000
