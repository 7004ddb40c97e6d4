"""The reactive motion keeps clear of what stands in its way, and hits it where it may."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np
import pytest

from adversary import begun
from attacks.arm import Arm
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.sim.motion import ReactiveMotion
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.posture import hand_at
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.world import Approach, Pose, World

OBSTACLE = glassware("conical_flask", "1000 ml", "obstacle")


@dataclass(frozen=True)
class Sweep:
    """Carry the empty hand over the bench, from left to right."""

    touches: frozenset[str] = frozenset()

    def phases(self, world: World) -> Iterator[Phase]:
        for name, y in (("start", 0.28), ("sweep", -0.28)):
            goal = hand_at(world, np.array([0.25, y, 0.90]))
            yield Phase(name, lambda w, goal=goal: goal, 0.08, arrived(0.02, 0.1), self.touches)


def sweep(skill: Sweep, obstacle: bool) -> tuple[int, Expert]:
    """Play a sweep; return the control steps in which robot and obstacle touched."""
    simulation = Simulation(compile_scene([OBSTACLE], PANDA, LABORATORY, VESSEL_VIEW))
    world = SimulatedWorld(simulation)
    aside = Placement(0.25, 0.0, 0.0) if obstacle else Placement(1.0, 0.7, 0.0)
    simulation.reset({OBSTACLE: aside})
    expert = Expert((skill,), world, ReactiveMotion(simulation, world))
    expert.start()
    touches = 0
    for _ in range(450):
        simulation.step(expert.act().astype(np.float64))
        robot = {"arm", "hand", "left_pad", "right_pad"}
        touches += bool(robot & world.touched_by("obstacle"))
    return touches, expert


def test_the_way_is_free_without_the_obstacle():
    touches, expert = sweep(Sweep(), obstacle=False)
    assert touches == 0
    assert expert.finished


def test_an_obstacle_in_the_way_is_hit_without_avoidance():
    touches, _ = sweep(Sweep(touches=frozenset({"obstacle"})), obstacle=True)
    assert touches > 0


def test_an_obstacle_in_the_way_is_not_touched_with_avoidance():
    touches, expert = sweep(Sweep(), obstacle=True)
    assert touches == 0
    assert not expert.unexpected


def test_commands_stay_within_the_limits_of_the_joints():
    simulation = Simulation(compile_scene([OBSTACLE], PANDA, LABORATORY, VESSEL_VIEW))
    world = SimulatedWorld(simulation)
    simulation.reset({OBSTACLE: Placement(1.0, 0.7, 0.0)})
    motion = ReactiveMotion(simulation, world)
    limits = np.array(PANDA.speed[:-1]) / 30
    far = world.gripper.moved(x=3.0, z=2.0)
    for _ in range(90):
        command = motion.follow(far, 0.08, touches=frozenset(), holds=None)
        joints = command[:-1]
        assert (np.abs(joints - simulation.command[:-1]) <= limits).all()
        assert (joints >= np.array(PANDA.lower[:-1]) - 1e-6).all()
        assert (joints <= np.array(PANDA.upper[:-1]) + 1e-6).all()
        simulation.step(command)


@dataclass(frozen=True)
class Dive:
    """Send the hand into the bench."""

    depth: float

    def goal(self, world: World) -> Pose:
        return hand_at(world, np.array([0.3, 0.0, world.bench_height - self.depth]))

    def phases(self, world: World) -> Iterator[Phase]:
        goal = self.goal(world)
        yield Phase("dive", lambda w: goal, 0.08, arrived(0.002))


@pytest.mark.parametrize("depth", [-0.02, 0.0, 0.02])
def test_the_hand_stops_above_the_bench(depth):
    simulation = Simulation(compile_scene([OBSTACLE], PANDA, LABORATORY, VESSEL_VIEW))
    world = SimulatedWorld(simulation)
    simulation.reset({OBSTACLE: Placement(1.0, 0.7, 0.0)})
    expert = Expert((Dive(depth),), world, ReactiveMotion(simulation, world))
    expert.start()
    while expert.failure is None:
        simulation.step(expert.act().astype(np.float64))
    assert not expert.unexpected
    missed = 1e3 * world.gripper.distance_to(Dive(depth).goal(world))
    assert expert.shortfall.startswith(f"{missed:.0f} mm and ")
    assert "arm kept from bench" in expert.shortfall
    # No phase may let the arm touch the bench; the hand it may.
    assert ("touches" in expert.shortfall) == ("hand kept from bench" in expert.shortfall)


def test_the_hand_reaches_a_point_as_low_as_the_tutorial_says():
    simulation = Simulation(compile_scene([OBSTACLE], PANDA, LABORATORY, VESSEL_VIEW))
    world = SimulatedWorld(simulation)
    simulation.reset({OBSTACLE: Placement(1.0, 0.7, 0.0)})
    expert = Expert((Dive(-0.035),), world, ReactiveMotion(simulation, world))
    expert.start()
    while not expert.finished and expert.failure is None:
        simulation.step(expert.act().astype(np.float64))
    assert expert.failure is None


def test_the_hand_points_to_the_right_of_the_bearing_and_down_by_default_or_as_one_says():
    world = SimulatedWorld(Simulation(compile_scene([OBSTACLE], PANDA, LABORATORY, VESSEL_VIEW)))
    point = np.array([0.3, 0.2, 1.0])
    bearing = point - world.robot_base.position_w
    for approach, right, down in ((None, 60, 7), (Approach(yaw=0.5, pitch=0.3), -28.65, 17.19)):
        pose = hand_at(world, point, approach)
        turned = np.arctan2(bearing[1], bearing[0]) - np.arctan2(pose.z_axis[1], pose.z_axis[0])
        assert np.degrees(turned) == pytest.approx(right, abs=0.01)
        assert np.degrees(np.arcsin(-pose.z_axis[2])) == pytest.approx(down, abs=0.01)
        assert pose.y_axis[2] == pytest.approx(0.0), "the fingers are level"


def test_what_the_hand_is_kept_from_is_reported_with_its_cure_and_not_what_is_far():
    simulation = Simulation(compile_scene([OBSTACLE], PANDA, LABORATORY, VESSEL_VIEW))
    world = SimulatedWorld(simulation)
    simulation.reset({OBSTACLE: Placement(0.3, 0.0, 0.0)})
    expert = Expert((Into(),), world, ReactiveMotion(simulation, world))
    expert.start()
    assert "kept" not in expert.shortfall
    while expert.failure is None:
        simulation.step(expert.act().astype(np.float64))
    assert "hand kept from obstacle, " in expert.shortfall
    assert "`touches` of a phase lists what hand and load may touch" in expert.shortfall


@dataclass(frozen=True)
class Into:
    """Send the closed hand into the obstacle, which it is not to touch."""

    def phases(self, world: World) -> Iterator[Phase]:
        goal = hand_at(world, world.pose(OBSTACLE).moved(z=0.1).position_w)
        yield Phase("into", lambda w: goal, 0.0, arrived(0.002))


def played_out(env: LabEnv) -> str:
    """Let the expert play from here to the end; return the outcome."""
    expert = env.expert()
    expert.start()
    while not env.workcell.progress.over:
        info = env.step(expert.act())[-1]
    return info["outcome"]


@pytest.mark.parametrize("seed", [3, pytest.param(4, marks=pytest.mark.slow)])
def test_an_arm_that_was_stretched_with_a_rod_in_the_hand_folds_again(seed: int):
    env = begun("level1/stir", liquid="off")
    env.reset(seed=seed)
    arm = Arm(env)
    for action in chain(arm.go(arm.pose.moved(z=0.08)), arm.stay(0.7)):
        env.step(action)
    assert abs(env.workcell.simulation.measured[3]) < 0.6  # the elbow is nearly straight
    assert played_out(env) == "success"


@pytest.mark.slow
def test_an_arm_that_is_stretched_behind_an_open_door_folds_again():
    env = begun("level4/device_operation", liquid="off")
    env.reset(seed=100065)
    assert played_out(env) == "success"


def test_an_arm_that_wound_itself_up_goes_back_and_tries_again():
    env = begun("level1/tare", split="ood", axes=("robot_start",))
    env.reset(seed=100001)
    assert played_out(env) == "success"


@dataclass(frozen=True)
class Before:
    """Go to where a press of the balance's button begins."""

    touches: frozenset[str]

    def phases(self, world: World) -> Iterator[Phase]:
        goal = world.frame("balance_tare").advanced(-0.10 - world.robot.finger_reach)
        yield Phase("go", lambda w: goal, 0.08, arrived(0.01, 0.1), self.touches, timeout_s=9.0)


@pytest.mark.parametrize(
    ("touches", "arrives"), [(frozenset(), True), (frozenset({"bench"}), False)]
)
def test_an_arm_goes_back_with_a_hand_that_is_free_and_with_no_other(touches, arrives):
    env = begun("level1/tare", split="ood", axes=("robot_start",))
    env.reset(seed=100001)
    cell = env.workcell
    expert = Expert((Before(touches),), cell.world, cell.motion)
    expert.start()
    for _ in range(260):
        cell.simulation.step(expert.act().astype(np.float64))
    assert expert.finished == arrives


def test_what_was_held_before_leaves_no_trace_in_the_next_episode():
    with LabEnv(Setting("level3/pour_sizes", obs="state", split="train")) as env:
        starts = [env.reset(seed=30)[0]["environment_state"].tobytes() for _ in range(3)]
    assert len(set(starts)) == 1
