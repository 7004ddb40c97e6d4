"""Odometry of a base: where its wheels say that it is."""

import math
from typing import Any

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.processes import Apparatus
from labutopia_lerobot.robots.odometry import BEND, LENGTH, TURN, Odometry
from labutopia_lerobot.setting import Setting, UnknownOptionError

JOINTS = ("base_x", "base_y", "base_yaw")
BASE = """
<mujoco><worldbody><body><geom size="0.1"/><joint name="base_x" type="slide" axis="1 0 0"/>
<joint name="base_y" type="slide" axis="0 1 0"/><joint name="base_yaw" type="hinge" axis="0 0 1"/>
</body></worldbody></mujoco>
"""


def believed(places: NDArray[np.float64], errors: tuple[float, float, float]) -> Any:
    """Return where a base believes to be that has gone along places, shape (n, 3)."""
    model = mujoco.MjModel.from_xml_string(BASE)
    data, odometry = mujoco.MjData(model), Odometry("odometry", JOINTS)
    apparatus = Apparatus(model, data, [odometry])
    data.qpos[:] = places[0]
    apparatus.start(np.random.default_rng(0))
    apparatus.memory(odometry)[:3] = errors
    for place in places[1:]:
        data.qpos[:] = place
        apparatus.step()
    return odometry.pose(apparatus)


def test_without_errors_it_is_where_it_is() -> None:
    turns = np.linspace(0.0, 9.0, 400)
    places = np.column_stack([np.sin(turns), 2.0 * turns, 3.0 * np.cos(turns)])
    assert believed(places, (0.0, 0.0, 0.0)) == pytest.approx(places[-1], abs=2e-3)


@pytest.mark.parametrize("yaw", [0.0, 2.2])
def test_a_straight_way_gets_longer_and_bends_as_an_arc_does(yaw: float) -> None:
    along = np.linspace(0.0, 10.0, 900)[:, None] * [math.cos(yaw), math.sin(yaw)]
    places = np.column_stack([along, np.full(900, yaw)])
    x, y, heading = believed(places, (0.02, 0.0, 0.01))
    assert heading == pytest.approx(yaw + 0.1)
    radius = 1.02 / 0.01  # an arc of 10.2 m that turns by 0.1 rad
    ahead, left = radius * math.sin(0.1), radius * (1.0 - math.cos(0.1))
    c, s = math.cos(yaw), math.sin(yaw)
    assert (x, y) == pytest.approx((c * ahead - s * left, s * ahead + c * left), abs=1e-4)


def test_what_bends_a_way_ahead_bends_it_back_in_reverse() -> None:
    """Wheels of two sizes (Borenstein and Feng, 1996) turn a base the other way when it backs."""
    along = np.concatenate([np.linspace(0.0, 10.0, 900), np.linspace(10.0, 0.0, 900)])
    places = np.column_stack([along, np.zeros((1800, 2))])
    assert believed(places, (0.0, 0.0, 0.01)) == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)


def test_turns_come_out_too_large_and_sideways_ways_too_long() -> None:
    turning = np.column_stack([np.zeros((90, 2)), np.linspace(0.0, 3.0, 90)])
    assert believed(turning, (0.5, 0.02, 0.5)) == pytest.approx([0.0, 0.0, 3.06])
    sideways = np.column_stack([np.zeros(90), np.linspace(0.0, 2.0, 90), np.zeros(90)])
    assert believed(sideways, (0.05, 0.0, 0.0)) == pytest.approx([0.0, 2.1, 0.0])


def test_errors_are_drawn_for_each_episode() -> None:
    model = mujoco.MjModel.from_xml_string(BASE)
    apparatus = Apparatus(model, mujoco.MjData(model), [odometry := Odometry("odometry", JOINTS)])
    drawn = []
    for seed in range(400):
        apparatus.start(np.random.default_rng(seed))
        drawn.append(apparatus.memory(odometry)[:3].copy())
    assert np.std(drawn, axis=0) == pytest.approx([LENGTH, TURN, BEND], rel=0.15)
    assert np.abs(np.mean(drawn, axis=0) / [LENGTH, TURN, BEND]).max() < 0.2


def test_what_is_observed_drifts_the_world_does_not_and_a_state_brings_it_back() -> None:
    setting = Setting("level5/navigate", obs="state", room="organic_7", odometry="drift")
    with LabEnv(setting) as env:
        observation, _ = env.reset(seed=4)
        simulation = env.workcell.simulation
        assert observation["agent_pos"][-3:] == pytest.approx(simulation.base_pose, abs=1e-3)
        expert = env.expert()
        expert.start()
        for step in range(150):
            if step == 60:
                saved, there = simulation.state(), observation["agent_pos"].copy()
            observation, *_ = env.step(expert.act())
        off = np.abs(observation["agent_pos"][-3:-1] - simulation.base_pose[:2]).max()
        assert 0.002 < off < 0.3
        simulation.restore(saved)
        assert np.array_equal(simulation.robot_state.astype(np.float32), there)


def test_an_arm_that_stands_has_no_odometry() -> None:
    with pytest.raises(UnknownOptionError, match="odometry=exact, or a robot that drives"):
        LabEnv(Setting("level1/pick", obs="state", odometry="drift"))
    with pytest.raises(UnknownOptionError, match="exact, drift"):
        Setting("level5/navigate", odometry="perfect")
