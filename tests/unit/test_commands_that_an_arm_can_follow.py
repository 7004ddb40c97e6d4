"""Whatever is commanded, set-points stay within the limits, and what acted acts again."""

from dataclasses import dataclass
from typing import Self

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.robots import IIWA, PANDA, Robot
from labutopia_lerobot.robots.action_filter import ActionFilter
from labutopia_lerobot.robots.braking import longest_step
from labutopia_lerobot.robots.hand_kinematics import HandKinematics
from labutopia_lerobot.robots.set_points import SPAN, set_points
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import FloatArray
from labutopia_lerobot.world.model import PHYSICS_HZ
from six_joint_arm import SIX

ROBOTS = (PANDA, IIWA, SIX)


@dataclass
class Arm:
    """A robot's commands without its body: filter and set-points, as in a simulation."""

    robot: Robot
    hand: HandKinematics
    filter: ActionFilter
    commands: FloatArray

    @classmethod
    def of(cls, robot: Robot) -> Self:
        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        robot.add_to(spec, spec.worldbody)
        hand = HandKinematics(spec.compile(), robot)
        arm = cls(robot, hand, ActionFilter(robot, hand), np.tile(robot.start, (SPAN, 1)))
        arm.filter.start(arm.commands[-1])
        return arm

    def play(self, actions: FloatArray) -> FloatArray:
        """Return the set-points of a sequence of actions, shape (physics steps, elements)."""
        points = [self.commands[-1:]]
        for action in actions:
            command = self.filter(action.astype(np.float32), self.commands)
            self.commands = np.vstack([self.commands[1:], command])
            points.append(set_points(self.commands)[0])
        return np.concatenate(points)


def bang_bang(robot: Robot, seed: int, steps: int) -> FloatArray:
    """Return jumps between the ends of every range, each held for up to 20 control steps."""
    rng = np.random.default_rng(seed)
    ends = np.array([robot.lower, robot.upper])
    jumps = [rng.integers(0, 2, len(robot.elements)) for _ in range(steps)]
    held = np.repeat(jumps, rng.integers(1, 20, steps), axis=0)[:steps]
    return np.where(held, ends[1], ends[0])


@pytest.fixture(params=ROBOTS, ids=lambda robot: robot.name, scope="module")
def arm(request: pytest.FixtureRequest) -> Arm:
    return Arm.of(request.param)


@pytest.fixture
def resting(arm: Arm) -> Arm:
    arm.commands = np.tile(arm.robot.start, (SPAN, 1))
    arm.filter.start(arm.commands[-1])
    return arm


@pytest.mark.slow
def test_bang_bang_commands_stay_within_every_limit_at_every_physics_step(arm):
    robot = arm.robot
    points = arm.play(bang_bang(robot, seed=0, steps=1500))
    assert (points >= np.array(robot.lower) - 1e-6).all()
    assert (points <= np.array(robot.upper) + 1e-6).all()
    limits = (robot.speed, robot.acceleration, robot.jerk)
    for order, limit in enumerate(limits, start=1):
        reached = np.abs(np.diff(points, n=order, axis=0)).max(axis=0) * PHYSICS_HZ**order
        assert (reached <= limit).all(), order
        assert order == 3 or reached.max() > 0.5 * max(limit)
    joints = points[:, : len(robot.joints)]
    steps = zip(joints[:-1], np.diff(joints, axis=0), strict=True)
    speeds = [np.linalg.norm(arm.hand.jacobian(at) @ step) * PHYSICS_HZ for at, step in steps]
    assert max(speeds) <= robot.hand_speed


def test_what_has_acted_acts_again_when_it_is_replayed_bit_for_bit(resting):
    acted = []
    for action in bang_bang(resting.robot, seed=1, steps=500):
        resting.play(action[np.newaxis])
        acted.append(resting.commands[-1].astype(np.float32))
    again = Arm.of(resting.robot)
    for command in acted:
        again.play(command[np.newaxis])
        assert again.commands[-1].astype(np.float32).tobytes() == command.tobytes()
    assert again.filter.clipped == 0


def test_an_action_that_stays_is_reached_without_overshoot(resting):
    robot = resting.robot
    goal = np.array(robot.start)
    goal[0] += 0.5
    points = resting.play(np.tile(goal, (60, 1)))
    np.testing.assert_allclose(points[-1], goal, atol=1e-6)
    assert points[:, 0].max() <= goal[0] + 1e-6


def test_a_small_step_passes_unchanged_and_is_not_counted(resting):
    goal = (resting.commands[-1] - 0.0005).astype(np.float32)
    assert resting.filter(goal, resting.commands).astype(np.float32).tobytes() == goal.tobytes()
    assert resting.filter.clipped == 0


def test_changed_and_undefined_actions_are_counted(resting):
    size = len(resting.robot.elements)
    resting.play(np.array([np.full(size, 100.0), np.full(size, np.nan)]))
    assert (resting.filter.clipped, resting.filter.nonfinite) == (2, 1)


def test_an_action_of_another_length_is_refused_by_naming_the_elements():
    arm = Arm.of(SIX)
    with pytest.raises(ValueError, match=r"\(7,\) \(axis0, .*, gripper\), not \(8,\)"):
        arm.filter(np.zeros(8, np.float32), arm.commands)


def test_commands_that_stand_still_give_set_points_that_do_so_to_the_last_bit():
    commands = np.tile(PANDA.start, (SPAN, 1))
    positions, rates = set_points(commands)
    assert (positions == commands[0]).all()
    assert (rates == 0.0).all()


@pytest.mark.parametrize("distance", [0.0, 0.3, 1.0, 3.0, 7.7, 100.0])
def test_the_longest_step_comes_to_rest_exactly_at_the_end(distance):
    step, way = float(longest_step(np.array(distance), np.array(1.0))), 0.0
    while step > 0.0:
        way, step = way + step, step - 1.0
    assert way == pytest.approx(distance)


def test_a_restored_moving_arm_goes_on_bit_for_bit():
    env = LabEnv(Setting("level1/pick", obs="state", liquid="off"))
    env.reset(seed=0)
    goal = np.array((*PANDA.home, 0.02), np.float32) + np.float32(0.2)
    for _ in range(5):
        env.step(goal)
    saved = env.workcell.simulation.state()
    states = []
    for _ in range(2):
        env.workcell.simulation.restore(saved)
        for _ in range(5):
            env.step(goal)
        states.append(env.workcell.simulation.state().tobytes())
    assert states[0] == states[1]
