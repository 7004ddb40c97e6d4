"""The Fetch is where its URDF puts it, within its limits, clear of itself, and gets to work."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib.metadata import PackageNotFoundError, version
from itertools import product

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.features import action_feature
from labutopia_lerobot.layout import Workspace
from labutopia_lerobot.predicates import at_hand
from labutopia_lerobot.robots import FETCH, PANDA, ROBOTS
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.fetch_base import FETCH_BASE
from labutopia_lerobot.robots.mesh_package import MeshPackage, NoMeshesError
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenes import LABORATORY, load_room, rooms_to_drive_in
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.skills.posture import hand_at
from labutopia_lerobot.skills.skill import Condition, Phase, arrived, at, settled
from labutopia_lerobot.skills.way import base_at
from labutopia_lerobot.tasks.driving import AT_HAND
from labutopia_lerobot.world import CONTROL_HZ, FloatArray, World


def has_meshes() -> bool:
    """Return whether the package with its meshes is installed."""
    try:
        version("gymnasium-robotics")
    except PackageNotFoundError:
        return False
    return True


installed = pytest.mark.skipif(not has_meshes(), reason="the extra `fetch` is not installed")

# Joint, origin in the frame of the link before [m], axis, of `fetch.urdf` (ZebraDevs/fetch_ros).
URDF = [
    ("torso_lift", (-0.086875, 0, 0.37743), None),
    ("shoulder_pan", (0.119525, 0, 0.34858), "z"),
    ("shoulder_lift", (0.117, 0, 0.06), "y"),
    ("upperarm_roll", (0.219, 0, 0), "x"),
    ("elbow_flex", (0.133, 0, 0), "y"),
    ("forearm_roll", (0.197, 0, 0), "x"),
    ("wrist_flex", (0.1245, 0, 0), "y"),
    ("wrist_roll", (0.1385, 0, 0), "x"),
]
GRIPPER = (0.16645, 0, 0)


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = 1 / 300
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    FETCH.add_to(spec, spec.worldbody)
    return spec.compile()


@pytest.fixture
def data(model: mujoco.MjModel) -> mujoco.MjData:
    return posed(model, FETCH.home)


@pytest.fixture(scope="module")
def env() -> Iterator[LabEnv]:
    with LabEnv(Setting("level1/pick", obs="state", robot="fetch")) as env:
        yield env


def posed(model: mujoco.MjModel, joints: tuple[float, ...]) -> mujoco.MjData:
    """Return the robot with its joints somewhere, and commanded to be there."""
    data, drives = mujoco.MjData(model), Drives(model, FETCH)
    elements = np.array([*joints, FETCH.max_opening, 0.0, 0.0, 0.0])
    drives.place(data.qpos, elements)
    drives.command(data, elements)
    mujoco.mj_forward(model, data)
    return data


def test_without_its_meshes_it_says_how_to_get_them_before_anything_is_played(monkeypatch):
    lacking = replace(FETCH, meshes=MeshPackage("no-such-package", "meshes", extra="fetch"))
    monkeypatch.setitem(ROBOTS, "fetch", lacking)
    with pytest.raises(NoMeshesError, match=r"pip install 'lerobot_env_labutopia\[fetch\]'"):
        canonical_task(Setting("level5/navigate", robot="fetch"))


def test_its_elements_are_torso_arm_gripper_and_base_by_what_they_do():
    roles, names = FETCH.roles, FETCH.names
    assert names[roles.torso] == ("torso_lift",)
    assert names[roles.arm] == tuple(name for name, _, axis in URDF if axis)
    assert names[roles.joints] == tuple(name for name, _, _ in URDF)
    assert names[roles.gripper] == "gripper"
    assert names[roles.base] == tuple(element.name for element in FETCH_BASE.elements)
    assert action_feature(Setting("level1/pick", robot="fetch")).names == names
    assert PANDA.roles.torso == slice(0, 0)
    assert PANDA.names[PANDA.roles.arm] == PANDA.names[PANDA.roles.joints]


def test_its_limits_are_those_of_the_urdf_and_the_data_sheet():
    torso, gripper = FETCH.elements[0], FETCH.gripper.element
    assert (torso.lower, torso.upper, torso.speed) == (0.0, 0.38615, 0.1)
    assert (gripper.lower, gripper.upper, gripper.speed) == (0.0, 0.1, 0.1)
    assert FETCH.speed[1:8] == (1.256, 1.454, 1.571, 1.521, 1.571, 2.268, 2.268)
    assert FETCH_BASE.limits.speed == 1.0


def test_it_stands_as_near_to_the_bench_as_its_base_lets_it():
    x, y = LABORATORY.arm_place(FETCH_BASE)
    front = x - FETCH_BASE.arm[0] + FETCH_BASE.size[0] / 2
    assert LABORATORY.bench.x[0] - front == pytest.approx(0.10)
    assert Workspace.of(LABORATORY, FETCH).robot == (x, y)
    assert Workspace.of(LABORATORY, PANDA).robot == LABORATORY.robot_stand[:2]


@installed
@pytest.mark.parametrize("seed", range(6))
def test_the_hand_is_where_the_urdf_puts_it(model, seed):
    lower, upper = (np.array(ends[:8]) for ends in (FETCH.lower, FETCH.upper))
    joints = np.random.default_rng(seed).uniform(lower, upper)
    point, turn = np.zeros(3), Rotation.identity()
    for (_, place, axis), position in zip(URDF, joints, strict=True):
        point = point + turn.apply(place)
        if axis is None:
            point = point + np.array([0.0, 0.0, position])
        else:
            turn = turn * Rotation.from_euler(axis, position)
    hand = posed(model, tuple(joints)).body(FETCH.gripper.body)
    np.testing.assert_allclose(hand.xpos, point + turn.apply(GRIPPER), atol=1e-9)
    np.testing.assert_allclose(hand.xmat.reshape(3, 3), turn.as_matrix(), atol=1e-9)


@installed
def test_it_weighs_what_the_data_sheet_says_within_a_tenth(model):
    assert model.body_mass.sum() == pytest.approx(113.3, rel=0.1)
    carried = model.body_subtreemass[model.body("arm_mount").id]
    assert carried + 6.0 <= FETCH_BASE.payload


@installed
def test_what_collides_is_as_large_as_what_is_seen_and_clear_of_the_floor(model):
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    seen, cylinder = model.geom("base_visual"), model.geom("base_collision")
    start = model.mesh_vertadr[int(seen.dataid[0])]
    corners = model.mesh_vert[start : start + model.mesh_vertnum[int(seen.dataid[0])]]
    corners = corners @ data.geom_xmat[seen.id].reshape(3, 3).T + data.geom_xpos[seen.id]
    widest = np.hypot(*corners[:, :2].T).max()
    assert widest == pytest.approx(cylinder.size[0], abs=0.005)
    assert corners[:, 2].max() == pytest.approx(FETCH_BASE.height, abs=0.005)
    assert 0.0 < cylinder.pos[2] - cylinder.size[1] < 0.05


@installed
def test_at_home_the_hand_is_level_with_the_x_axis_of_the_grasp_up(data):
    x = data.site(FETCH.gripper.site).xmat.reshape(3, 3)[:, 0]
    np.testing.assert_allclose(x, (0, 0, 1), atol=5e-3)


@installed
@pytest.mark.parametrize("posture", ["home", "stowed"])
def test_it_holds_still_under_gravity_without_touching_itself(model, posture):
    joints = getattr(FETCH, posture)
    data = posed(model, joints)
    mujoco.mj_step(model, data, nstep=300)
    assert data.ncon == 0
    positions = [data.joint(joint.name).qpos[0] for joint in FETCH.joints]
    np.testing.assert_allclose(positions, joints, atol=1e-4)


@installed
def test_postures_keep_away_from_every_end_of_a_range():
    lower, upper = (np.array(ends[:8]) for ends in (FETCH.lower, FETCH.upper))
    for posture, share in ((FETCH.home, 0.15), (FETCH.stowed, 0.02)):
        near = np.minimum(posture - lower, upper - posture) / (upper - lower)
        assert near.min() > share


@installed
def test_a_kilogram_in_the_hand_lowers_it_by_less_than_three_millimetres(model, data):
    height = data.site(FETCH.gripper.site).xpos[2]
    data.xfrc_applied[model.body(FETCH.gripper.body).id, 2] = -9.81
    mujoco.mj_step(model, data, nstep=600)
    assert height - 0.003 < data.site(FETCH.gripper.site).xpos[2] < height


@installed
def test_a_start_that_is_displaced_leaves_the_torso_where_it_is(env):
    with LabEnv(
        Setting("level1/pick", obs="state", robot="fetch", axes=("robot_start",))
    ) as varied:
        varied.reset(seed=0)
        start = varied.workcell.simulation.measured
    off = np.abs(start[FETCH.roles.joints] - FETCH.home)
    assert off[0] < 1e-3
    assert 0.01 < np.linalg.norm(off[1:]) < 0.3


@installed
def test_the_expert_picks_with_torso_and_arm_and_the_base_stands(env):
    env.reset(seed=100100)
    expert, over, lifted = env.expert(), False, []
    expert.start()
    place = env.workcell.simulation.base_pose
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        lifted.append(env.workcell.simulation.measured[0])
        over = terminated or truncated
    assert info["outcome"] == "success"
    assert not expert.unexpected
    assert info["clipped_actions"] == 0
    assert np.ptp(lifted) > 0.02
    np.testing.assert_allclose(env.workcell.simulation.base_pose, place, atol=2e-3)


@installed
@pytest.mark.slow
@pytest.mark.parametrize("task", ["level1/pick", "level1/place", "level1/pour"])
def test_the_expert_plays_ten_episodes_with_it(task):
    with LabEnv(Setting(task, obs="state", robot="fetch")) as env:
        assert [outcome(env, seed) for seed in range(100100, 100110)] == ["success"] * 10


@installed
@pytest.mark.slow
@pytest.mark.parametrize("task", ["navigation_and_manipulation", "fetch_reagent"])
def test_the_expert_drives_with_it_to_a_beaker_or_a_cupboard_and_does_there_what_it_is_to(task):
    with LabEnv(Setting(f"level5/{task}", obs="state", robot="fetch")) as env:
        assert [outcome(env, seed) for seed in range(100100, 100103)] == ["success"] * 3


@installed
@pytest.mark.slow
@pytest.mark.parametrize(
    ("task", "seeds"),
    [
        ("transport_to_oven", (100000, 100007)),  # one of them in an aisle that it turns far from
        ("fetch_reagent", (100000, 100003)),  # its hand comes out beside the open door
        ("clear_bench", (100000,)),  # its hand comes out of the basin
    ],
)
def test_each_step_begins_as_early_as_the_one_before_is_done(task: str, seeds: tuple[int, ...]):
    with LabEnv(Setting(f"level5/{task}", obs="state", liquid="off", robot="fetch")) as env:
        for seed in seeds:
            env.reset(seed=seed)
            last = env.workcell.task.steps[-2].name
            begun = env.reset(seed=seed, options={"after": last})[1]
            assert begun["setup_failures"] == 0
            assert played_out(env) == "success"


@installed
@pytest.mark.slow
def test_in_an_aisle_hardly_wider_than_its_disc_it_has_the_room_to_open_a_door():
    narrow = (100012, 100023, 100036)  # where its disc could back off by 0.30 m at most
    with LabEnv(Setting("level5/fetch_reagent", obs="state", robot="fetch")) as env:
        assert [outcome(env, seed) for seed in narrow] == ["success"] * len(narrow)


@installed
def test_before_its_footprint_the_stowed_arm_is_where_docks_keep_clear_of_things(model):
    data, spans = posed(model, FETCH.stowed), np.array(FETCH_BASE.folded)
    reaching = 0
    for geom in np.flatnonzero(model.geom_contype | model.geom_conaffinity):
        points = corners_of(model, geom)
        points = points @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
        before = points[points[:, 0] > FETCH_BASE.size[0] / 2]
        if len(before):
            reaching += 1
            assert (before > spans[:, 0]).all(), model.geom(geom).name
            assert (before < spans[:, 1]).all(), model.geom(geom).name
    assert reaching >= 5


def corners_of(model: mujoco.MjModel, geom: int) -> FloatArray:
    """Return the corners of a mesh, or of the box around a geom, in its frame, shape (n, 3)."""
    mesh = model.geom_dataid[geom]
    if mesh >= 0:
        first = model.mesh_vertadr[mesh]
        corners: FloatArray = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
        return corners
    middle, half = model.geom_aabb[geom].reshape(2, 3)
    return middle + half * np.array(list(product((-1, 1), repeat=3)))


@installed
@pytest.mark.slow
def test_its_folded_hand_meets_no_tripod_on_the_bench_that_it_docks_at():
    with LabEnv(Setting("level5/navigation_and_manipulation", obs="state", robot="fetch")) as env:
        assert outcome(env, 100107) == "success"


@installed
@pytest.mark.slow
def test_its_arm_brakes_before_a_wall_cupboard_and_takes_beakers_on_high_benches_from_above():
    with LabEnv(Setting("level5/clear_bench", obs="state", robot="fetch")) as env:
        assert [outcome(env, seed) for seed in (100002, 100004)] == ["success"] * 2


@installed
@pytest.mark.slow
def test_a_finger_that_swings_breaks_no_rim_and_a_lift_at_the_ends_of_joints_is_one():
    with LabEnv(Setting("level5/clear_bench", obs="state", robot="fetch")) as env:
        assert [outcome(env, seed) for seed in (100033, 100052)] == ["success"] * 2


@dataclass(frozen=True)
class TurnDown:
    """Turn the hand down where it is."""

    done: Condition

    def phases(self, world: World) -> Iterator[Phase]:
        down = hand_at(world, world.gripper.position_w, FETCH.deep_approach)
        yield Phase("turn", at(down), 0.1, self.done)


@installed
@pytest.mark.parametrize(
    ("done", "slowest", "fastest"),
    [(arrived(0.015, 0.1), 0.2, 0.3), (settled(0.015, 0.1), 0.0, 0.05)],
    ids=["arrived", "settled"],
)
def test_its_hand_swings_when_it_arrives_and_hardly_when_it_has_settled(done, slowest, fastest):
    with LabEnv(Setting("level1/pick", obs="state", robot="fetch")) as env:
        env.reset(seed=0)
        world = env.workcell.world
        expert = env.workcell.expert((TurnDown(done),))
        expert.start()
        while not expert.finished and expert.failure is None:
            before = world.gripper.position_w
            env.step(expert.act())
            speed = float(np.linalg.norm(world.gripper.position_w - before)) * CONTROL_HZ
        assert expert.finished
        assert slowest < speed < fastest


@pytest.mark.slow
def test_it_gets_to_two_benches_of_every_room_to_drive_in():
    for names in rooms_to_drive_in():
        for name in names:
            assert len(load_room(name).ground(FETCH_BASE).benches) >= 2, name


def outcome(env: LabEnv, seed: int) -> str:
    """Play the expert's episode of a seed; return how it ended."""
    env.reset(seed=seed)
    return played_out(env)


def played_out(env: LabEnv) -> str:
    """Play the expert's episode from where it has begun; return how it ended."""
    expert, over = env.expert(), False
    expert.start()
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    assert not expert.unexpected
    said: str = info["outcome"]
    return said


def test_a_turn_of_its_rolling_axes_has_one_number():
    assert [math.degrees(upper) for upper in FETCH.upper[3:8:2]] == pytest.approx([180.0] * 3)


@pytest.mark.parametrize(("robot", "far"), [("ridgeback_panda", 1.1), ("fetch", 0.968)])
def test_at_hand_is_what_the_arm_reaches_that_is_there(robot: str, far: float) -> None:
    env = LabEnv(Setting("level5/navigate", obs="state", robot=robot, room="organic_7"))
    env.reset(seed=0)
    world, (beaker,) = env.workcell.world, env.workcell.task.start
    goal = at_hand(beaker, share=AT_HAND)
    base, data = env.workcell.simulation.data.joint, env.workcell.simulation.data
    for off in (-0.02, 0.02):
        (x, y), (at_x, at_y) = base_at(world)[0], world.pose(beaker).position_w[:2]
        base("base_x").qpos += at_x - far - off - x
        base("base_y").qpos += at_y - y
        mujoco.mj_forward(env.workcell.simulation.scene.model, data)
        assert goal.holds(world) == (off < 0.0)
    env.close()
