"""Robots and rooms are values: nothing counts to seven, and unknown names are reported."""

import re
import subprocess
import sys
from dataclasses import dataclass, fields, replace
from importlib import import_module
from pathlib import Path

import mujoco
import numpy as np
import pytest

import labutopia_lerobot
from labutopia_lerobot import setting
from labutopia_lerobot.devices import LabUtopiaRobotConfig
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.errors import UserError
from labutopia_lerobot.evaluation.policies import RandomPolicy, StillPolicy
from labutopia_lerobot.features import action_feature, observation_features
from labutopia_lerobot.gymnasium_ids import make_env
from labutopia_lerobot.layout import Workspace
from labutopia_lerobot.lerobot_plugin import LabUtopiaEnvConfig
from labutopia_lerobot.robots import IIWA, PANDA, ROBOTS, Element, Robot, load_robot
from labutopia_lerobot.robots.drives import Drives
from labutopia_lerobot.robots.robot import Roles
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.scenes import LABORATORY, ROOMS, Surface, load_room
from labutopia_lerobot.setting import Setting
from six_joint_arm import SIX


@pytest.fixture
def env(monkeypatch) -> LabEnv:
    monkeypatch.setitem(ROBOTS, "six", SIX)
    monkeypatch.setattr(setting, "ROBOT_NAMES", (*setting.ROBOT_NAMES, "six"))
    return LabEnv(Setting("level1/pick", obs="state", robot="six"))


def test_features_have_as_many_numbers_as_the_robot(env):
    names = (*(f"axis{i}" for i in range(6)), "gripper")
    assert action_feature(env.setting).names == names
    observed = observation_features(env.setting, lambda: canonical_task(env.setting))
    assert observed["agent_pos"].names == names
    assert observed["agent_pos"].shape == (7,)


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
        command = env.workcell.motion.follow(goal, SIX.max_opening, touches=frozenset(), holds=None)
        assert command.shape == (7,)
        env.step(command.astype(np.float32))
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
    np.testing.assert_array_equal([data.actuator(name).ctrl[0] for name in SIX.names], positions)
    assert data.actuator("fan").ctrl[0] == 0.0
    assert data.actuator("gripper").ctrl[0] == positions[-1]


@dataclass(frozen=True)
class GripperFirst(Robot):
    """A robot whose elements come in another order than usual."""

    @property
    def elements(self) -> tuple[Element, ...]:
        return (self.gripper.element, *self.joints)

    @property
    def roles(self) -> Roles:
        return Roles(slice(1, 1 + len(self.joints)), 0, slice(0))

    @property
    def start(self) -> tuple[float, ...]:
        return (self.max_opening, *self.home)


def test_elements_go_by_what_they_do_and_in_whatever_order_give_the_same_motion(monkeypatch):
    traces = {}
    for kind in (Robot, GripperFirst):
        robot = kind(**{field.name: getattr(PANDA, field.name) for field in fields(PANDA)})
        monkeypatch.setitem(ROBOTS, "panda", robot)
        env = LabEnv(Setting("level1/pick", obs="state"))
        env.reset(seed=1)
        expert, trace = env.expert(), []
        expert.start()
        for _ in range(120):  # to the flask, and the hand begins to close
            env.step(expert.act())
            world = env.workcell.world
            opening = [world.gripper_opening, world.commanded_opening]
            trace.append([*world.gripper.position_w, *opening])
        assert env.workcell.filter.clipped == 0
        traces[kind] = np.array(trace)
    assert np.ptp(traces[Robot][:, 4]) > 0.02
    np.testing.assert_allclose(traces[Robot], traces[GripperFirst], atol=1e-5)


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
def test_an_unknown_robot_or_room_is_reported_with_the_choices(load, message):
    with pytest.raises(UserError, match=message):
        load("ur5")


@pytest.mark.parametrize(
    ("option", "told"),
    [("robot", "robot='ur5' is unknown. Choose from: panda, iiwa"), ("room", "room='ur5' is")],
)
@pytest.mark.parametrize(
    "line",
    [
        ["view", "level1/pick", "out=here"],
        ["record", "level1/pick", "root=here"],
        ["evaluate", "level1/pick", "policy=expert", "out=here", "videos=0"],
        ["evaluate", "level2/pour_liquid", "policy=expert", "out=here", "play=staged", "videos=0"],
        ["bench", "level1/pick"],
    ],
    ids=" ".join,
)
def test_no_program_begins_with_an_unknown_robot_or_room(
    monkeypatch, capsys, tmp_path, line, option, told
):
    program, *words = line
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [f"labutopia-{program}", *words, f"{option}=ur5"])
    with pytest.raises(SystemExit, match="2"):
        import_module(f"labutopia_lerobot.cli.{program}").main()
    (message,) = capsys.readouterr().err.splitlines()
    assert message.startswith(f"Error: {told}")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("wrong", [{"robot": "ur5"}, {"room": "ur5"}])
@pytest.mark.parametrize("make", [LabUtopiaEnvConfig, LabUtopiaRobotConfig, make_env])
def test_no_environment_of_others_begins_with_an_unknown_robot_or_room(make, wrong):
    task = {"task": "level1/pick"}
    with pytest.raises(UserError, match="='ur5' is unknown"):
        make(**task, **wrong)


def test_no_other_module_names_a_robot():
    package = Path(labutopia_lerobot.__file__).parent
    named = re.compile(r"panda|iiwa|kuka|franka", re.IGNORECASE)
    elsewhere = [
        path.relative_to(package)
        for path in package.rglob("*.py")
        if path.relative_to(package).parts[0] not in ("robots", "setting.py")
        and named.search(path.read_text())
    ]
    assert elsewhere == []


@pytest.mark.slow
def test_names_and_limits_are_known_without_mujoco():
    code = (
        "import sys, labutopia_lerobot.robots, labutopia_lerobot.scenes\n"
        "import labutopia_lerobot.features, labutopia_lerobot.robots.action_filter\n"
        "assert 'mujoco' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
