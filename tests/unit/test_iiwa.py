"""The KUKA LBR iiwa 14 is where its data sheet puts it, within its limits, and gets to work."""

from collections.abc import Iterator
from dataclasses import dataclass

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import IIWA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.motion import ReactiveMotion
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.skills.expert import Expert
from labutopia_lerobot.skills.posture import hand_at
from labutopia_lerobot.skills.skill import Phase, arrived
from labutopia_lerobot.world import Pose, World

# Rows d [m], alpha [rad] of the Denavit-Hartenberg parameters (classic convention, a = 0) of the
# LBR iiwa 14 R820: 360, 420, 400 and 126 mm from base to shoulder, elbow, wrist and flange.
DENAVIT_HARTENBERG = [
    (0.360, -np.pi / 2),
    (0.0, np.pi / 2),
    (0.420, np.pi / 2),
    (0.0, -np.pi / 2),
    (0.400, -np.pi / 2),
    (0.0, np.pi / 2),
    (0.126, 0.0),
]
HAND_TURN = np.pi / 2


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.timestep = 1 / 300
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    IIWA.add_to(spec, spec.worldbody)
    return spec.compile()


@pytest.fixture
def data(model: mujoco.MjModel) -> mujoco.MjData:
    data = mujoco.MjData(model)
    for joint, angle in zip(IIWA.joints, IIWA.home, strict=True):
        data.joint(joint.name).qpos = data.actuator(joint.name).ctrl = angle
    mujoco.mj_forward(model, data)
    return data


def hand_pose(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Multiply the published transforms: Rz(theta) Tz(d) Rx(alpha), then the hand on the flange."""
    pose = np.eye(4)
    for (d, alpha), angle in zip([*DENAVIT_HARTENBERG, (0, 0)], [*angles, HAND_TURN], strict=True):
        c, s = np.cos(angle), np.sin(angle)
        along_z = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
        c, s = np.cos(alpha), np.sin(alpha)
        about_x = np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
        pose = pose @ along_z @ about_x
    return pose


def random_angles(count: int) -> NDArray[np.float64]:
    rng = np.random.default_rng(0)
    return rng.uniform(IIWA.lower[:-1], IIWA.upper[:-1], (count, len(IIWA.joints)))


@pytest.mark.parametrize("angles", [np.zeros(7), np.array(IIWA.home), *random_angles(8)])
def test_the_hand_is_where_the_published_kinematics_put_it(model, data, angles):
    for joint, angle in zip(IIWA.joints, angles, strict=True):
        data.joint(joint.name).qpos = angle
    mujoco.mj_forward(model, data)
    expected, hand = hand_pose(angles), data.body(IIWA.gripper.body)
    np.testing.assert_allclose(hand.xpos, expected[:3, 3], atol=1e-9)
    np.testing.assert_allclose(hand.xmat.reshape(3, 3), expected[:3, :3], atol=1e-9)


def test_the_limits_are_those_of_the_data_sheet(model):
    np.testing.assert_allclose(np.degrees(IIWA.upper[:-1]), [170, 120, 170, 120, 170, 120, 175])
    np.testing.assert_allclose(np.degrees(IIWA.speed[:-1]), [85, 85, 100, 75, 130, 135, 135])
    for element in IIWA.elements:
        limits = element.lower, element.upper
        np.testing.assert_allclose(model.actuator(element.name).ctrlrange, limits)
    for joint in IIWA.joints:
        assert joint.lower == -joint.upper
        np.testing.assert_allclose(model.joint(joint.name).range, (joint.lower, joint.upper))


def test_home_keeps_away_from_every_joint_limit():
    lower, home, upper = map(np.array, (IIWA.lower[:-1], IIWA.home, IIWA.upper[:-1]))
    assert np.minimum(home - lower, upper - home).min() > 0.35


def test_the_arm_with_its_hand_weighs_about_31_kg(model):
    franka_hand = 0.76
    assert model.body_mass.sum() == pytest.approx(29.9 + franka_hand, rel=0.05)


def test_at_home_the_hand_is_level_with_the_x_axis_of_the_grasp_up(data):
    x = data.site(IIWA.gripper.site).xmat.reshape(3, 3)[:, 0]
    np.testing.assert_allclose(x, (0, 0, 1), atol=2e-3)


def test_home_holds_still_under_gravity_without_touching_itself(model, data):
    mujoco.mj_step(model, data, nstep=300)
    assert data.ncon == 0
    angles = [data.joint(joint.name).qpos[0] for joint in IIWA.joints]
    np.testing.assert_allclose(angles, IIWA.home, atol=1e-4)


def test_a_kilogram_in_the_hand_lowers_it_by_less_than_two_millimetres(model, data):
    height = data.site(IIWA.gripper.site).xpos[2]
    data.xfrc_applied[model.body(IIWA.gripper.body).id, 2] = -9.81
    mujoco.mj_step(model, data, nstep=600)
    assert height - 0.002 < data.site(IIWA.gripper.site).xpos[2] < height


@pytest.mark.parametrize(("x", "y"), [(0.21, -0.075), (0.21, 0.075), (0.22, 0.04), (0.36, 0.075)])
def test_home_is_clear_of_a_flask_in_the_start_region(x, y):
    flask = glassware("conical_flask", "300 ml", "flask")
    simulation = Simulation(compile_scene([flask], IIWA, LABORATORY, VESSEL_VIEW))
    simulation.reset({flask: Placement(x, y, 0.0)})
    assert SimulatedWorld(simulation).touched_by("flask") == {"bench"}


@pytest.mark.parametrize(("joint", "limit"), [("joint2", 320.0), ("joint7", 40.0)])
def test_servo_torque_saturates_at_the_published_limit(model, data, joint, limit):
    data.ctrl[model.actuator(joint).id] += 1.0
    mujoco.mj_forward(model, data)
    assert data.actuator(joint).force[0] == pytest.approx(limit)


@dataclass(frozen=True)
class Reach:
    """Bring the hand to a pose."""

    goal: Pose

    def phases(self, world: World) -> Iterator[Phase]:
        yield Phase("reach", lambda _: self.goal, IIWA.max_opening, arrived(within=0.001))


@pytest.mark.parametrize(("x", "y"), [(0.21, -0.25), (0.21, 0.25), (0.36, -0.25), (0.36, 0.25)])
def test_the_hand_reaches_low_over_the_start_regions_within_the_limits(x, y):
    vessel = glassware("beaker", "250 ml", "beaker")
    simulation = Simulation(compile_scene([vessel], IIWA, LABORATORY, VESSEL_VIEW))
    simulation.reset({vessel: Placement(1.0, 0.7, 0.0)})
    world = SimulatedWorld(simulation)
    goal = hand_at(world, np.array([x, y, world.bench_height + vessel.grip_height]))
    lower, upper, speed = (np.array(limit[:-1]) for limit in (IIWA.lower, IIWA.upper, IIWA.speed))
    expert = Expert((Reach(goal),), world, ReactiveMotion(simulation, world))
    expert.start()
    for _ in range(150):
        command = expert.act().astype(float)
        joints = command[:-1]
        assert (np.abs(joints - simulation.command[:-1]) <= speed / 30).all()
        assert ((lower - 1e-6 <= joints) & (joints <= upper + 1e-6)).all()
        simulation.step(command)
    assert world.gripper.distance_to(goal) < 0.004
    assert not world.touched_by("bench") & {"arm", "hand"}
