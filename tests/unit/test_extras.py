"""What is observed beside the usual: metric depth, segmentation, forces on the pads."""

import warnings

import gymnasium
import mujoco
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.features import observation_features
from labutopia_lerobot.pictures import FARTHEST_M
from labutopia_lerobot.registry import task_files
from labutopia_lerobot.scenario import canonical_task, draw_scenario
from labutopia_lerobot.setting import ALL, DEPTH, FORCES, SEGMENTATION, Setting, UnknownOptionError
from labutopia_lerobot.sim.segments import segment_names

SMALL = {"width": 64, "height": 64, "cameras": ("top",)}

EXTRAS = (DEPTH, SEGMENTATION, FORCES)
"""What every task has."""


@pytest.fixture(scope="module")
def env() -> LabEnv:
    """An episode in which nothing has moved yet."""
    env = LabEnv(Setting("level1/pick", liquid="off", extras=EXTRAS, **SMALL))
    env.reset(seed=3)
    return env


def numbers(env: LabEnv) -> NDArray[np.uint8]:
    """Return what the camera above sees, by number, shape (height, width)."""
    seen: NDArray[np.uint8] = env.workcell.pictures(["top_segmentation"])["top_segmentation"]
    assert (seen == seen[..., :1]).all()
    return seen[..., 0]


def through_pixels(env: LabEnv, rows: NDArray, columns: NDArray) -> NDArray[np.float64]:
    """Return how far MuJoCo's own rays go along the axis of the camera above [m]."""
    model, data = env.workcell.simulation.scene.model, env.workcell.simulation.data
    camera = model.camera("top")
    focal = 32 / np.tan(np.radians(camera.fovy[0]) / 2)
    right, up, backward = data.camera("top").xmat.reshape(3, 3).T
    seen = np.array([1, 1, 1, 0, 0, 0], np.uint8)
    reached = []
    for row, column in zip(rows, columns, strict=True):
        ray = (column - 31.5) / focal * right - (row - 31.5) / focal * up - backward
        far = mujoco.mj_ray(
            model, data, data.camera("top").xpos, ray, seen, 1, -1, np.zeros(1, np.int32)
        )
        reached.append(far)  # in lengths of the ray, which is 1 along the axis
    return np.array(reached)


def test_extras_come_beside_what_is_observed_and_change_nothing_of_it(env):
    plain = LabEnv(Setting("level1/pick", liquid="off", **SMALL))
    without, _ = plain.reset(seed=3)
    observation = env._observe()
    assert without.keys() == {"agent_pos", "pixels"}
    assert without["pixels"].keys() == {"top"}
    assert observation.keys() - without.keys() == {"forces", "images.top_depth"}
    assert observation["pixels"].keys() == {"top", "top_segmentation"}
    assert np.array_equal(observation["pixels"]["top"], without["pixels"]["top"])
    assert np.array_equal(observation["agent_pos"], without["agent_pos"])
    assert plain.observation_space.contains(without)
    assert env.observation_space.contains(observation)


def test_gymnasium_finds_no_fault_with_them():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", message=".*symmetric and normalized space")
        warnings.filterwarnings("ignore", message=".*maximum value is infinity")  # of a force
        made = gymnasium.make("labutopia/level1-pick-v0", liquid="off", extras=EXTRAS, **SMALL)
        check_env(made.unwrapped)


def test_pictures_need_cameras_and_forces_do_not():
    with pytest.raises(UnknownOptionError, match="needs cameras: choose obs=pixels"):
        Setting("level1/pick", obs="state", extras=("forces", "depth"))
    with pytest.raises(UnknownOptionError, match="depth, segmentation, forces, readings"):
        Setting("level1/pick", extras=("touch",))
    blind = Setting("level1/pick", extras=EXTRAS).without_pictures()
    assert (blind.obs, blind.extras) == ("state", ("forces",))


def test_only_the_privileged_state_can_be_left_without_something():
    with pytest.raises(UnknownOptionError, match=r"hidden=\['levels'\] needs obs=state"):
        Setting("level1/pour", hidden=("levels",))
    with pytest.raises(UnknownOptionError, match="handles, homes, lamps, displays, sizes, levels"):
        Setting("level1/pour", obs="state", hidden=("poses",))
    assert Setting("level1/pour", obs="state", hidden=("levels", "sizes")).hidden == (
        "sizes",
        "levels",
    )
    with pytest.raises(
        UnknownOptionError, match=r"hidden=\[levels\]: the state of level1/pick has"
    ):
        LabEnv(Setting("level1/pick", obs="state", hidden=("levels",)))


def test_depth_is_the_distance_along_the_axis_to_the_bench(env):
    depth = env.workcell.pictures(["top_depth"])["top_depth"][..., 0]
    height = env.workcell.simulation.data.camera("top").xpos[2] - env.workcell.world.bench_height
    # The same everywhere on a plane that the axis is normal to, however slanting the ray.
    for row, column in ((8, 32), (20, 10), (20, 54)):
        assert depth[row, column] == pytest.approx(height, abs=0.0005)


def test_depth_is_the_distance_along_the_axis_to_a_flask(env):
    depth = env.workcell.pictures(["top_depth"])["top_depth"][..., 0]
    names = segment_names(env.workcell.task)
    rows, columns = np.nonzero(numbers(env) == names.index("flask"))
    off = np.abs(depth[rows, columns] - through_pixels(env, rows, columns))
    # Glass is steep: at its edges the ray through the middle of a pixel may miss what OpenGL hits.
    assert np.median(off) < 0.0005
    assert (off < 0.002).mean() > 0.9
    assert np.ptp(depth[rows, columns]) > 0.05


def test_what_is_further_than_lerobot_holds_is_reported_as_the_farthest():
    env = LabEnv(Setting("level1/open_door", extras=("depth",), width=64, height=64))
    observation, _ = env.reset(seed=3)
    assert env.depth("front").max() > FARTHEST_M
    assert observation["images.front_depth"].max() == np.float32(FARTHEST_M)
    assert env.observation_space.contains(observation)


def test_the_pixels_of_a_thing_move_with_it(env):
    names, data = segment_names(env.workcell.task), env.workcell.simulation.data
    before, state = numbers(env), env.workcell.simulation.state()
    camera = env.workcell.simulation.scene.model.camera("top")
    focal = 32 / np.tan(np.radians(camera.fovy[0]) / 2)
    right, up, _ = data.camera("top").xmat.reshape(3, 3).T
    way = np.array([0.05, -0.08, 0.0])
    data.joint("flask_free").qpos[:3] += way
    mujoco.mj_forward(env.workcell.simulation.scene.model, data)
    after = numbers(env)
    depth = data.camera("top").xpos[2] - data.body("flask").xipos[2]
    env.workcell.simulation.restore(state)

    def middle(picture: NDArray[np.uint8]) -> NDArray[np.float64]:
        return np.argwhere(picture == names.index("flask")).mean(axis=0)

    expected = np.array([-(way @ up), way @ right]) * focal / depth
    assert np.allclose(middle(after) - middle(before), expected, atol=0.6)  # pixels
    robot = names.index("robot")
    assert ((before == robot) == (after == robot)).mean() > 0.99


def test_a_liquid_has_a_number_of_its_own_in_whatever_vessel_it_is():
    env = LabEnv(Setting("level1/pour", extras=("segmentation",), particles=100, **SMALL))
    observation, _ = env.reset(seed=0)
    names = segment_names(env.workcell.task)
    seen = {names[number] for number in np.unique(observation["pixels"]["top_segmentation"])}
    assert {"background", "robot", "liquid"} <= seen


def test_numbers_mean_the_same_in_every_episode_of_a_task():
    for task in task_files():
        names = segment_names(canonical_task(Setting(task)))
        assert names[:3] == ("background", "robot", "liquid")
        drawn = draw_scenario(Setting(task, split="train", axes=(ALL,)), 1)
        assert segment_names(drawn.task) == names, task
        assert {piece.name for piece in drawn.variation.distractors} <= set(names), task


def test_the_pads_feel_what_the_hand_presses_with_and_nothing_in_the_air():
    env = LabEnv(Setting("level1/pick", obs="state", liquid="off", extras=("forces",)))
    observation, _ = env.reset(seed=3)
    expert, servo = env.expert(), env.workcell.simulation.data.actuator("gripper")
    expert.start()
    forces, pressed = [observation["forces"]], [0.0]
    terminated = False
    while not terminated:
        observation, _, terminated, _, _ = env.step(expert.act())
        forces.append(observation["forces"])
        pressed.append(-float(servo.force[0]))
    assert not np.any(forces[:20])  # on the way to the flask
    felt, commanded = np.array(forces[-30:]), np.array(pressed[-30:])  # held still for a second
    assert felt.dtype == np.float32
    assert commanded.min() > 5.0
    # One servo closes both fingers, and each presses with what the servo does; the two are alike,
    # since what is held does not move.
    assert felt[:, 0] == pytest.approx(commanded, rel=0.1)
    assert felt[:, 1] == pytest.approx(commanded, rel=0.1)
    assert felt[:, 0] == pytest.approx(felt[:, 1], rel=0.05)


def test_a_camera_above_the_ceiling_sees_what_is_below_it():
    env = LabEnv(Setting("level1/open_door", extras=EXTRAS, **SMALL))
    observation, _ = env.reset(seed=3)
    names = segment_names(env.workcell.task)
    assert observation["images.top_depth"].min() > 2.0
    assert {names.index("robot"), names.index("oven")} < set(numbers(env).flat)


def test_readings_are_what_displays_show_and_whether_they_have_settled():
    env = LabEnv(Setting("level1/tare", obs="state", extras=("readings",)))
    observation, info = env.reset(seed=0)
    assert env.observation_space["readings"].shape == (2,)
    shown, settled = observation["readings"]
    assert shown == np.float32(info["readings"]["balance_reading"])
    assert settled == 1.0
    assert observation_names(env) == ("balance_reading", "balance_reading.settled")


def observation_names(env: LabEnv) -> tuple[str, ...]:
    return observation_features(env.setting, lambda: env.workcell.task)["readings"].names


def test_readings_of_a_task_that_shows_none_are_refused():
    with pytest.raises(UnknownOptionError, match=r"nothing in level1/pick shows a reading"):
        LabEnv(Setting("level1/pick", obs="state", extras=("readings",)))
