"""Robots and rooms are values: nothing counts to seven, and names that do not exist are told."""

import math
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

import labutopia_lerobot
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.policies import RandomPolicy, StillPolicy
from labutopia_lerobot.features import action_feature, observation_features
from labutopia_lerobot.layout import Workspace
from labutopia_lerobot.robots import IIWA, PANDA, ROBOTS, Element, Robot, load_robot
from labutopia_lerobot.robots.action_filter import ActionFilter
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.franka_hand import FRANKA_HAND
from labutopia_lerobot.robots.franka_hand_model import add_franka_hand
from labutopia_lerobot.robots.parts import add_joint_servo
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenes import LABORATORY, ROOMS, Surface, load_room
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import Approach

JOINTS = tuple(Element(f"axis{i}", -3.0, 3.0, 2.0 + 0.1 * i) for i in range(6))
# Axis, place of the link on the one before [m], end of the link [m]: a turret, upper arm, forearm
# and three axes of a wrist, as most arms in industry have them.
LINKS = (
    ((0, 0, 1), (0.0, 0.0, 0.10), (0.0, 0.0, 0.20)),
    ((0, 1, 0), (0.0, 0.0, 0.20), (0.0, 0.0, 0.42)),
    ((0, 1, 0), (0.0, 0.0, 0.42), (0.35, 0.0, 0.0)),
    ((1, 0, 0), (0.35, 0.0, 0.0), (0.08, 0.0, 0.0)),
    ((0, 1, 0), (0.08, 0.0, 0.0), (0.06, 0.0, 0.0)),
    ((1, 0, 0), (0.06, 0.0, 0.0), (0.04, 0.0, 0.0)),
)


def build(spec: mujoco.MjSpec, parent: mujoco.MjsBody) -> None:
    """An arm of six joints, after a fan with a motor of its own, which is no element of it."""
    spec.add_material(name="plain", rgba=(0.5, 0.5, 0.6, 1.0))
    body = parent.add_body(name="socket", gravcomp=1)
    fan = body.add_body(name="fan", pos=(-0.2, 0, 0.1))
    fan.add_joint(name="fan", axis=(0, 0, 1))
    fan.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.01, 0.01), contype=0, conaffinity=0)
    spec.add_actuator(name="fan", target="fan", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    for joint, (axis, place, end) in zip(JOINTS, LINKS, strict=True):
        body = body.add_body(name=f"{joint.name}_link", pos=place, gravcomp=1)
        limits = (joint.lower, joint.upper)
        body.add_joint(name=joint.name, axis=axis, range=limits, armature=0.1, damping=1.0)
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=(0, 0, 0, *end),
            size=(0.04, 0, 0),
            mass=1.5,
            contype=0,
            conaffinity=0,
        )
        add_joint_servo(spec, joint, stiffness=2000.0, damping=60.0, force=100.0)
    half = math.sqrt(0.5)  # of the hand: z along the last axis, fingers side by side
    hand = body.add_body(name="hand", pos=(0.06, 0, 0), quat=(half, 0, half, 0), gravcomp=1)
    add_franka_hand(spec, hand, material="plain")


SIX = Robot(
    name="six",
    add_to=build,
    joints=JOINTS,
    gripper=FRANKA_HAND,
    home=(0.3, -0.3, 0.3, 0.0, 0.0, 0.0),
    reach=0.9,
    base_body="socket",
    vessel_approach=Approach(yaw=0.0, pitch=0.1),
    handle_approach=Approach(yaw=0.0, pitch=0.1),
)


@pytest.fixture
def env(monkeypatch) -> LabEnv:
    monkeypatch.setitem(ROBOTS, "six", SIX)
    return LabEnv(Setting("level1/pick", obs="state", robot="six"))


def test_features_have_as_many_numbers_as_the_robot(env):
    names = (*(f"axis{i}" for i in range(6)), "gripper")
    assert action_feature(env.setting).names == names
    observed = observation_features(env.setting, lambda: canonical_task(env.setting))
    assert observed["agent_pos"].names == names
    assert observed["agent_pos"].shape == (7,)


def test_the_filter_clips_every_element_to_its_own_limits():
    act = ActionFilter(SIX)
    act.start(np.array(SIX.start))
    applied = act(np.full(7, 100.0, np.float32))
    np.testing.assert_allclose(
        applied, np.minimum(np.array(SIX.start) + np.array(SIX.speed) / 30, SIX.upper), atol=1e-6
    )
    assert act.clipped == 1


def test_heights_come_from_the_room(monkeypatch):
    """The expert picks a flask from a bench that is 15 cm higher and 10 cm to the left."""
    bench, (x, y, z) = LABORATORY.bench, LABORATORY.robot_stand
    higher = replace(
        LABORATORY,
        name="higher",
        bench=Surface(bench.height + 0.15, bench.x, (bench.y[0] + 0.1, bench.y[1] + 0.1)),
        robot_stand=(x, y + 0.1, z + 0.15),
    )
    monkeypatch.setitem(ROOMS, "higher", higher)
    env = LabEnv(Setting("level1/pick", obs="state", room="higher"))
    env.reset(seed=0)
    flask = next(iter(env.workcell.task.start))
    assert env.workcell.world.bench_height == bench.height + 0.15
    assert env.workcell.world.robot_base.position_w[1] == pytest.approx(0.1)
    stands = env.workcell.world.pose(flask).position_w[2]
    assert stands == pytest.approx(bench.height + 0.15, abs=1e-3)
    expert, over = env.expert(), False
    expert.start()
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
    assert info["outcome"] == "success"
    assert not expert.unexpected


def test_an_action_of_another_length_is_refused_by_naming_the_elements():
    act = ActionFilter(SIX)
    act.start(np.array(SIX.start))
    with pytest.raises(ValueError, match=r"\(7,\) \(axis0, .*, gripper\), not \(8,\)"):
        act(np.zeros(8, np.float32))


def test_spaces_observations_and_policies_have_as_many_numbers_as_the_robot(env):
    assert env.action_space.shape == env.observation_space["agent_pos"].shape == (7,)
    observation, _ = env.reset(seed=0)
    np.testing.assert_allclose(observation["agent_pos"], SIX.start, atol=5e-3)
    for policy in (RandomPolicy(), StillPolicy()):
        policy.start(env, seed=0)
        for _ in range(5):
            action = policy.act(observation)
            assert env.action_space.contains(action)
            observation, *_ = env.step(action)


def test_the_expert_moves_a_six_joint_arm_to_where_it_wants(env):
    env.reset(seed=0)
    goal = env.workcell.world.gripper.moved(x=0.05, y=-0.05, z=-0.05)
    for _ in range(90):
        joints = env.workcell.motion.follow(goal, touches=frozenset(), holds=None)
        assert joints.shape == (6,)
        env.step(np.append(joints, SIX.max_opening).astype(np.float32))
    assert env.workcell.world.gripper.distance_to(goal) < 0.005
    assert env.workcell.world.gripper.angle_to(goal) < 0.05
    assert env.workcell.simulation.data.joint("fan").qpos[0] == 0.0


def test_drives_find_the_elements_wherever_they_are_in_the_model():
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    SIX.add_to(spec, spec.worldbody)
    model = spec.compile()
    data, drives = mujoco.MjData(model), Drives(model, SIX)
    positions = np.linspace(0.1, 0.07, 7)
    drives.place(data.qpos, positions)
    np.testing.assert_allclose(drives.measured(data), positions)
    assert data.joint("fan").qpos[0] == 0.0
    assert data.joint("axis0").qpos[0] == positions[0]
    assert data.joint("finger_joint1").qpos[0] == data.joint("finger_joint2").qpos[0]
    drives.command(data, positions)
    np.testing.assert_array_equal(drives.targets(data), positions)
    assert data.actuator("fan").ctrl[0] == 0.0
    assert data.actuator("gripper").ctrl[0] == positions[-1]


def test_the_same_seed_is_the_same_layout_for_every_robot():
    layouts = []
    for robot in (PANDA, IIWA):
        env = LabEnv(Setting("level1/pick", obs="state", robot=robot.name))
        env.reset(seed=3)
        layouts.append(env.workcell.world.pose(next(iter(env.workcell.task.start))).position_w)
    np.testing.assert_allclose(*layouts, atol=1e-6)


def test_what_can_be_reached_follows_from_room_and_robot():
    assert Workspace.of(LABORATORY, IIWA) == Workspace(
        x=(-0.2, 1.2), y=(-0.9, 0.9), robot=(-0.4, 0.0), reach=IIWA.reach
    )


def test_robots_and_rooms_are_found_by_their_names():
    assert all(load_robot(name).name == name for name in ROBOTS)
    assert all(load_room(name).name == name for name in ROOMS)


@pytest.mark.parametrize(
    ("load", "message"),
    [
        (load_robot, "robot='ur5' is unknown. Choose from: panda, iiwa"),
        (load_room, "room='ur5' is unknown. Choose from: laboratory"),
        (lambda name: LabEnv(Setting("level1/pick", robot=name)), "robot='ur5' is unknown"),
    ],
)
def test_an_unknown_robot_or_room_is_told_with_the_choices(load, message):
    with pytest.raises(UserError, match=message):
        load("ur5")


def test_no_other_module_names_a_robot():
    package = Path(labutopia_lerobot.__file__).parent
    named = re.compile(r"panda|iiwa|kuka|franka", re.IGNORECASE)
    elsewhere = [
        path.relative_to(package)
        for path in package.rglob("*.py")
        if path.relative_to(package).parts[0] != "robots" and named.search(path.read_text())
    ]
    assert elsewhere == []


def test_names_and_limits_are_known_without_mujoco():
    code = (
        "import sys, labutopia_lerobot.robots, labutopia_lerobot.scenes\n"
        "import labutopia_lerobot.features, labutopia_lerobot.robots.action_filter\n"
        "assert 'mujoco' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
