from importlib.resources import as_file, files

import mujoco
import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from scipy.spatial import KDTree

from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.robots.collada import read_collada
from labutopia_lerobot.robots.franka_hand_model import FRANKA_MESHES
from labutopia_lerobot.robots.meshes import load_mesh
from labutopia_lerobot.robots.thinning import creased, visible_from_outside

FINGER = f"{FRANKA_MESHES}/finger.dae"

# Rows a [m], d [m], alpha [rad], theta offset [rad] of the Franka Control Interface documentation,
# the flange and the hand as further rows; the joint angles are added to the first seven.
MODIFIED_DENAVIT_HARTENBERG = [
    (0, 0.333, 0, 0),
    (0, 0, -np.pi / 2, 0),
    (0, 0.316, np.pi / 2, 0),
    (0.0825, 0, np.pi / 2, 0),
    (-0.0825, 0.384, -np.pi / 2, 0),
    (0, 0, np.pi / 2, 0),
    (0.088, 0, np.pi / 2, 0),
    (0, 0.107, 0, 0),
    (0, 0, 0, -np.pi / 4),
]


def panda() -> mujoco.MjSpec:
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    PANDA.add_to(spec, spec.worldbody)
    return spec


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    spec = panda()
    spec.option.timestep = 1 / 300
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    return spec.compile()


@pytest.fixture
def data(model: mujoco.MjModel) -> mujoco.MjData:
    data = mujoco.MjData(model)
    data.qpos[:7] = data.ctrl[:7] = PANDA.home
    mujoco.mj_forward(model, data)
    return data


def hand_pose(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Multiply the published transforms: Rx(alpha) Tx(a) Rz(theta) Tz(d)."""
    pose = np.eye(4)
    for (a, d, alpha, offset), angle in zip(
        MODIFIED_DENAVIT_HARTENBERG, [*angles, 0.0, 0.0], strict=True
    ):
        c, s = np.cos(alpha), np.sin(alpha)
        along_x = np.array([[1, 0, 0, a], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
        c, s = np.cos(angle + offset), np.sin(angle + offset)
        along_z = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])
        pose = pose @ along_x @ along_z
    return pose


def random_angles(count: int) -> NDArray[np.float64]:
    rng = np.random.default_rng(0)
    return rng.uniform(PANDA.lower[:-1], PANDA.upper[:-1], (count, 7))


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    mujoco.mj_step(model, data, nstep=round(seconds / model.opt.timestep))


def opening(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    """Distance between the pads as the collision geometry has it [m]."""
    left, right = (data.geom(name) for name in PANDA.gripper.pads)
    thickness = (
        model.geom(PANDA.gripper.pads[0]).size[1] + model.geom(PANDA.gripper.pads[1]).size[1]
    )
    return float(np.linalg.norm(left.xpos - right.xpos) - thickness)


@pytest.mark.parametrize("angles", [np.zeros(7), np.array(PANDA.home), *random_angles(8)])
def test_the_hand_is_where_the_published_kinematics_put_it(model, data, angles):
    data.qpos[:7] = angles
    mujoco.mj_forward(model, data)
    expected = hand_pose(angles)
    hand = data.body(PANDA.gripper.body)
    np.testing.assert_allclose(hand.xpos, expected[:3, 3], atol=1e-9)
    np.testing.assert_allclose(hand.xmat.reshape(3, 3), expected[:3, :3], atol=1e-9)


def test_the_model_has_the_limits_that_the_robot_declares(model):
    for element in PANDA.elements:
        limits = element.lower, element.upper
        np.testing.assert_allclose(model.actuator(element.name).ctrlrange, limits)
    for joint in PANDA.joints:
        np.testing.assert_allclose(model.joint(joint.name).range, (joint.lower, joint.upper))


def test_home_keeps_away_from_every_joint_limit():
    lower, home, upper = map(np.array, (PANDA.lower[:-1], PANDA.home, PANDA.upper[:-1]))
    assert np.minimum(home - lower, upper - home).min() > 0.4


def test_the_arm_with_its_hand_weighs_about_18_kg(model):
    assert model.body_mass.sum() == pytest.approx(18.0, rel=0.05)


def test_at_home_the_hand_is_level_with_the_x_axis_of_the_grasp_up(data):
    x = data.site(PANDA.gripper.site).xmat.reshape(3, 3)[:, 0]
    np.testing.assert_allclose(x, (0, 0, 1), atol=2e-3)


def test_the_grasp_is_midway_between_the_pads(model, data):
    left, right = (data.geom(name).xpos for name in PANDA.gripper.pads)
    np.testing.assert_allclose((left + right) / 2, data.site(PANDA.gripper.site).xpos, atol=1e-3)


def test_home_holds_still_without_touching_itself(model, data):
    run(model, data, 1.0)
    assert data.ncon == 0
    np.testing.assert_allclose(data.qpos[:7], PANDA.home, atol=1e-4)


@pytest.mark.parametrize(("joint", "limit"), [("joint2", 87.0), ("joint7", 12.0)])
def test_servo_torque_saturates_at_the_published_limit(model, data, joint, limit):
    data.ctrl[model.actuator(joint).id] += 1.0
    mujoco.mj_forward(model, data)
    assert data.actuator(joint).force[0] == pytest.approx(limit)


@pytest.mark.parametrize("command", [0.0, 0.02, 0.05, 0.08])
def test_the_pads_open_as_far_as_commanded(model, data, command):
    data.ctrl[model.actuator("gripper").id] = command
    run(model, data, 1.5)
    assert opening(model, data) == pytest.approx(command, abs=1e-3)


def test_the_fingers_stay_even_under_a_push_on_one_of_them(model, data):
    data.ctrl[model.actuator("gripper").id] = 0.05
    run(model, data, 1.0)
    data.qfrc_applied[model.joint(PANDA.gripper.finger_joints[0]).dofadr] = -10.0
    run(model, data, 1.0)
    left, right = (data.joint(name).qpos[0] for name in PANDA.gripper.finger_joints)
    assert left < 0.0245
    assert left == pytest.approx(right, abs=1e-3)


@pytest.fixture
def holding(data: mujoco.MjData) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A 0.5 kg bottle between the pads, commanded 10 mm closer than its width, and no floor."""
    spec = panda()
    spec.option.timestep = 1 / 300
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 30
    bottle = spec.worldbody.add_body(name="bottle", pos=data.site(PANDA.gripper.site).xpos)
    bottle.add_freejoint()
    bottle.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(0.03, 0.05, 0), mass=0.5)
    model = spec.compile()
    held = mujoco.MjData(model)
    held.qpos[:7] = held.ctrl[:7] = PANDA.home
    for joint in PANDA.gripper.finger_joints:
        held.joint(joint).qpos = 0.03
    held.ctrl[model.actuator("gripper").id] = 0.05
    return model, held


def test_friction_holds_half_a_kilogram_with_the_rated_force(holding):
    model, data = holding
    height = model.body("bottle").pos[2]
    run(model, data, 2.0)
    assert data.body("bottle").xpos[2] == pytest.approx(height, abs=3e-3)
    assert data.actuator("gripper").force[0] == pytest.approx(-35.0, rel=0.1)


def test_the_wrist_camera_sees_both_pads(model, data):
    height = width = 128
    with mujoco.Renderer(model, height, width) as renderer:
        renderer.enable_segmentation_rendering()
        renderer.update_scene(data, "wrist")
        visible = renderer.render()[..., 0]
    for finger in ("left_finger_visual", "right_finger_visual"):
        assert np.count_nonzero(visible == model.geom(finger).id) > 50
    blocked = np.isin(visible, [model.geom(f"{name}_visual").id for name in ("hand", "link7")])
    assert blocked.mean() < 0.25


def test_a_cached_mesh_is_the_mesh(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    made = load_mesh(FINGER, 200)
    assert len(list((tmp_path / "labutopia_lerobot").iterdir())) == 1
    cached = load_mesh(FINGER, 200)
    for fresh, kept in zip(made, cached, strict=True):
        np.testing.assert_array_equal(fresh, kept)


def test_a_cache_that_cannot_be_written_only_warns(tmp_path, monkeypatch, caplog):
    (tmp_path / "labutopia_lerobot").write_text("a file where the folder should be")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert len(load_mesh(FINGER, 200).faces) == pytest.approx(200, rel=0.1)
    assert "cannot be written" in caplog.text


def test_an_unknown_mesh_is_named_in_the_error():
    with pytest.raises(FileNotFoundError, match="no mesh 'nowhere\\.stl'"):
        load_mesh("nowhere.stl", 500)


@pytest.mark.parametrize("link", ["link1", pytest.param("link2", marks=pytest.mark.slow), "hand"])
def test_a_thinned_mesh_has_no_holes_and_no_spikes(link):
    with as_file(files("rtbdata") / f"{FRANKA_MESHES}/{link}.dae") as path:
        largest = max(read_collada(path), key=lambda part: len(part.faces))
    visible = visible_from_outside(largest.vertices, largest.faces)
    whole = sampled(largest.vertices, largest.faces[visible])
    thin = load_mesh(f"{FRANKA_MESHES}/{link}.dae", 700)
    shown = thin.tones == np.float32(largest.tone)
    kept = sampled(thin.vertices, thin.faces[shown[thin.faces].all(axis=1)])
    from_whole, _ = KDTree(kept).query(whole)
    assert np.quantile(from_whole, 0.99) < 0.004
    assert KDTree(whole).query(kept)[0].max() < 0.006


def test_shading_is_smooth_where_faces_meet_at_less_than_a_crease():
    ridge = np.array([[0, 0, 0], [0, 1, 0], [1, 0, -0.2], [-1, 0, -0.2]])
    faces = np.array([[0, 2, 1], [0, 1, 3]], np.int32)
    vertices, normals, _ = creased(ridge, faces)
    assert len(vertices) == 4
    np.testing.assert_allclose(normals[vertices[:, 0] == 0], [[0, 0, 1]] * 2, atol=1e-9)
    vertices, *_ = creased(ridge * (1, 1, 5), faces)
    assert len(vertices) == 6


def sampled(vertices: NDArray[np.floating], faces: NDArray[np.int32]) -> NDArray[np.float64]:
    """Points on triangles, a millimetre apart on average."""
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    return trimesh.sample.sample_surface(mesh, int(mesh.area / 1e-6), seed=0)[0]
