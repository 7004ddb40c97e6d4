"""A Panda on a base that drives: what it weighs, how it moves, what it touches."""

import math

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.env import LabEnv
from labutopia_lerobot.features import action_feature, observation_features
from labutopia_lerobot.robots import PANDA, RIDGEBACK_PANDA
from labutopia_lerobot.robots.ridgeback import RIDGEBACK
from labutopia_lerobot.scenario import canonical_task
from labutopia_lerobot.setting import Setting
from labutopia_lerobot.world import CONTROL_HZ, FloatArray

SETTING = Setting("level1/pick", obs="state", robot="ridgeback_panda")
BASE = RIDGEBACK_PANDA.roles.base


@pytest.fixture(scope="module")
def env() -> LabEnv:
    return LabEnv(SETTING)


def bidden(env: LabEnv, *velocity: float) -> np.ndarray:
    """Return the action that keeps the arm and drives the base at a velocity."""
    action = env.workcell.simulation.command
    action[BASE] = velocity
    return action.astype(np.float32)


def drive(env: LabEnv, seconds: float, *velocity: float) -> FloatArray:
    """Drive for a time; return where the base is: x, y [m] and heading [rad]."""
    for _ in range(round(seconds * CONTROL_HZ)):
        env.step(bidden(env, *velocity))
    pose: FloatArray = env.workcell.simulation.base_pose.copy()
    return pose


def test_its_limits_are_those_of_the_data_sheets():
    assert RIDGEBACK.limits.speed == 1.1
    assert RIDGEBACK.limits.acceleration == pytest.approx(1.0)
    assert RIDGEBACK.size == (0.960, 0.793)
    rims = RIDGEBACK.limits.turning * (0.319 + 0.2755)
    assert rims == pytest.approx(1.1)


def test_arm_and_riser_are_no_more_than_it_may_carry(env):
    env.reset(seed=0)
    model = env.workcell.simulation.scene.model
    base, carried = model.body(RIDGEBACK.body), model.body("arm_mount")
    assert 135.0 < base.mass[0] < 200.0
    assert 25.0 < model.body_subtreemass[carried.id] < RIDGEBACK.payload


def test_what_collides_is_as_large_as_what_is_seen_and_clear_of_the_floor(env):
    env.reset(seed=0)
    model, data = env.workcell.simulation.scene.model, env.workcell.simulation.data
    seen, box = model.geom("base_visual"), model.geom("base_collision")
    mesh = model.mesh("ridgeback")
    start, count = mesh.vertadr[0], mesh.vertnum[0]
    turn = data.geom_xmat[seen.id].reshape(3, 3)
    corners = model.mesh_vert[start : start + count] @ turn.T + data.geom_xpos[seen.id]
    body = corners[corners[:, 2] > 0.08]  # above the wheels' lower half
    low, high = (data.geom_xpos[box.id] + side * box.size for side in (-1, 1))
    assert (body.min(axis=0)[:2] >= low[:2] - 0.005).all()
    assert (body.max(axis=0) <= high + 0.005).all()
    assert (body.min(axis=0)[:2] <= low[:2] + 0.02).all()
    assert 0.0 < low[2] < 0.05
    assert corners[:, 2].min() == pytest.approx(0.0, abs=0.002)  # wheels stand on the floor


def test_features_and_spaces_follow_from_the_robot(env):
    observation, _ = env.reset(seed=0)
    state = observation_features(SETTING, lambda: canonical_task(SETTING))["agent_pos"]
    assert state.names[:8] == (*PANDA.names,)
    assert state.names[8:11] == ("base_velocity_x", "base_velocity_y", "base_velocity_yaw")
    assert state.names[11:] == ("base_x", "base_y", "base_yaw")
    assert action_feature(SETTING).names == state.names[:11]
    assert observation["agent_pos"].shape == state.shape
    assert env.observation_space.contains(observation)
    assert env.action_space.high[BASE] == pytest.approx([1.1, 1.1, 1.1 / 0.5945])


def test_a_heading_is_observed_within_half_a_turn(env):
    env.reset(seed=0)
    simulation = env.workcell.simulation
    simulation.data.joint("base_yaw").qpos = 4.0
    assert simulation.robot_state[-1] == pytest.approx(4.0 - 2 * math.pi)
    assert simulation.base_pose[2] == 4.0


def test_it_begins_with_its_arm_where_an_arm_on_a_stand_has_it(env):
    env.reset(seed=0)
    world = env.workcell.world
    fixed = LabEnv(Setting("level1/pick", obs="state"))
    fixed.reset(seed=0)
    stand = fixed.workcell.world
    assert world.robot_base.distance_to(stand.robot_base) < 1e-6
    assert world.gripper.distance_to(stand.gripper) < 1e-3
    assert stand.mobile_base is None
    assert "pedestal" not in {
        env.workcell.simulation.scene.model.body(body).name
        for body in range(env.workcell.simulation.scene.model.nbody)
    }


def test_it_drives_forward_sideways_and_turns_in_its_own_frame(env):
    env.reset(seed=0)
    start = env.workcell.simulation.base_pose.copy()
    drive(env, 0.6, -0.15, 0.0, 0.0)
    back = drive(env, 0.5, 0.0, 0.0, 0.0)
    assert back[0] - start[0] == pytest.approx(-0.09, abs=0.005)
    assert abs(back[1] - start[1]) < 1e-3
    drive(env, 1.0, 0.0, 0.0, 0.4)
    turned = drive(env, 0.8, 0.0, 0.0, 0.0)
    assert turned[2] == pytest.approx(0.4, abs=0.01)
    assert np.hypot(*(turned - back)[:2]) < 0.01
    drive(env, 0.5, 0.0, 0.2, 0.0)
    along = drive(env, 0.5, 0.0, 0.0, 0.0)
    way = along[:2] - turned[:2]
    assert np.hypot(*way) == pytest.approx(0.1, abs=0.01)
    assert math.atan2(way[1], way[0]) == pytest.approx(0.4 + math.pi / 2, abs=0.05)
    assert env.workcell.world.mobile_base.position_w[:2] == pytest.approx(along[:2])


def test_its_speed_and_acceleration_stay_within_the_limits_whatever_is_commanded(env):
    env.reset(seed=0)
    simulation, trace = env.workcell.simulation, []
    for step in range(60):
        sign = 1.0 if step // 7 % 2 else -1.0
        simulation.step(
            env.workcell.filter(bidden(env, 9 * sign, -9, 9 * sign), simulation.commands)
        )
        trace += simulation.set_points[:, BASE].tolist()
    velocities = np.array(trace)
    changes = np.diff(velocities, axis=0) * 300
    for axis, element in enumerate(RIDGEBACK.elements):
        assert np.abs(velocities[:, axis]).max() <= element.upper + 1e-6
        assert np.abs(changes[:, axis]).max() <= element.speed * 1.001
        assert np.abs(changes[:, axis]).max() > 0.9 * element.speed
    assert env.workcell.filter.clipped > 50


def test_a_base_whose_command_is_undefined_stops(env):
    env.reset(seed=0)
    drive(env, 0.4, -0.3, 0.0, 0.0)
    simulation, command = env.workcell.simulation, bidden(env, np.nan, np.inf, np.nan)
    for _ in range(18):
        simulation.step(env.workcell.filter(command, simulation.commands))
    assert np.abs(simulation.command[BASE]).max() < 1e-3
    assert env.workcell.filter.nonfinite == 18


def test_a_hand_that_has_to_brake_does_not_keep_the_base_from_braking(env):
    env.reset(seed=0)
    simulation = env.workcell.simulation
    drive(env, 0.4, -0.3, 0.0, 0.0)
    lower, upper = np.array(RIDGEBACK_PANDA.lower), np.array(RIDGEBACK_PANDA.upper)
    for step in range(18):  # the arm flails as fast as it can
        wild = np.where(step // 4 % 2, upper, lower)
        wild[BASE] = 0.0
        simulation.step(env.workcell.filter(wild.astype(np.float32), simulation.commands))
    assert np.abs(simulation.command[BASE]).max() < 1e-3


def test_it_holds_its_place_while_the_arm_works(env):
    env.reset(seed=0)
    expert, over, off = env.expert(), False, 0.0
    expert.start()
    start = env.workcell.simulation.base_pose.copy()
    while not over:
        _, _, terminated, truncated, info = env.step(expert.act())
        over = terminated or truncated
        off = max(off, float(np.abs(env.workcell.simulation.base_pose - start).max()))
    assert info["outcome"] == "success"
    assert not expert.unexpected
    assert 0.0 < off < 0.002


def test_a_base_that_runs_into_the_bench_ends_the_episode(env):
    env.reset(seed=0)
    for _ in range(CONTROL_HZ):
        _, _, terminated, _, info = env.step(bidden(env, 0.4, 0.0, 0.0))
        if terminated:
            break
    assert info["outcome"] == "collided"
    assert env.workcell.world.touched_by("base") == {"bench"}


def test_behind_the_end_of_an_episode_it_stands_still(env):
    env.reset(seed=0)
    for _ in range(3 * CONTROL_HZ):
        _, _, _, _, info = env.step(bidden(env, 0.4, 0.0, 0.0))
    assert info["outcome"] == "collided"
    assert np.abs(env.workcell.simulation.measured[BASE]).max() < 1e-3


def test_a_state_that_is_restored_drives_on_bit_for_bit(env):
    env.reset(seed=0)
    simulation = env.workcell.simulation
    drive(env, 0.3, -0.3, 0.1, 0.5)
    state = simulation.state()
    ends = []
    for _ in range(2):
        simulation.restore(state)
        for _ in range(10):
            simulation.step(simulation.command)
        ends.append(simulation.state().tobytes())
    assert ends[0] == ends[1]


def test_no_body_is_glued_and_the_base_has_three_ways_to_move(env):
    env.reset(seed=0)
    scene = env.workcell.simulation.scene
    assert scene.welds == 0
    body = scene.model.body(RIDGEBACK.body)
    kinds = scene.model.jnt_type[body.jntadr[0] : body.jntadr[0] + body.jntnum[0]]
    slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
    assert list(kinds) == [slide, slide, hinge]
