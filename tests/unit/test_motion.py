"""The reactive motion keeps clear of what stands in its way, and hits it when told that it may."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.glassware import erlenmeyer_flask
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.motion import ReactiveMotion
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.posture import hand_at
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.world import World

OBSTACLE = erlenmeyer_flask("obstacle", "1000 ml")


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

    def phases(self, world: World) -> Iterator[Phase]:
        goal = hand_at(world, np.array([0.3, 0.0, world.bench_height - self.depth]))
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
