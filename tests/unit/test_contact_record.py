"""What happens between two control steps is seen: falls, knocks and pushes of milliseconds."""

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.predicates import broken, falling
from labutopia_lerobot.world import BENCH


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return begun("level1/pick")


def let_fall(env: LabEnv, height: float) -> dict[str, float]:
    """Let the flask fall onto the bench; return the extremes of a second."""
    env.reset(seed=0)
    (flask,) = env.workcell.task.start
    simulation, world = env.workcell.simulation, env.workcell.world
    simulation.data.joint(f"{flask.name}_free").qpos[2] += height
    reported = {"fall": 0.0, "speed": 0.0, "force": 0.0, "broken": 0.0, "falling": 0.0}
    for _ in range(30):
        simulation.step(simulation.command)
        now = {
            "fall": world.fall_speed(flask),
            "speed": world.approach_speed(flask.name, BENCH),
            "force": world.contact_force(flask.name, BENCH),
            "broken": broken().holds(world),
            "falling": falling(flask, faster_than=0.4).holds(world),
        }
        reported = {name: max(value, now[name]) for name, value in reported.items()}
    return reported


@pytest.mark.parametrize("height", [0.001, 0.010, 0.050])
def test_a_fall_and_a_knock_have_the_speed_of_free_fall(env, height):
    reported, speed = let_fall(env, height), np.sqrt(2 * 9.81 * height)
    one_step = 9.81 / 300
    assert abs(reported["fall"] - speed) < 1.5 * one_step
    assert abs(reported["speed"] - speed) < 1.5 * one_step


def test_at_rest_the_bench_carries_the_weight_and_nothing_falls(env):
    env.reset(seed=0)
    (flask,) = env.workcell.task.start
    simulation, world = env.workcell.simulation, env.workcell.world
    simulation.step(simulation.command)
    weight = 9.81 * simulation.scene.model.body(flask.name).mass[0]
    assert world.contact_force(flask.name, BENCH) == pytest.approx(weight, rel=0.02)
    assert world.contact_force(BENCH, flask.name) == world.contact_force(flask.name, BENCH)
    assert world.approach_speed(flask.name, BENCH) < 0.001
    assert world.fall_speed(flask) < 0.001


def test_ten_millimetres_are_a_drop_and_one_is_none(env):
    assert let_fall(env, 0.010)["falling"]
    light = let_fall(env, 0.001)
    assert not light["falling"]
    assert not light["broken"]


def test_a_thing_breaks_from_four_millimetres_on(env):
    assert not let_fall(env, 0.002)["broken"]
    assert let_fall(env, 0.004)["broken"]
