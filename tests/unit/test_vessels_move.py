"""Vessels in real MuJoCo, at the physics step and with the contact options of every scene."""

import math

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.vessel import Vessel
from vessels_on_a_bench import bench, every_vessel


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)


def tilt(data: mujoco.MjData, name: str) -> float:
    """Angle between the vessel's axis and the vertical [rad]."""
    return math.acos(min(1.0, data.body(name).xmat[8]))


def settle_from_tilt(vessel: Vessel, angle: float) -> float:
    """Let go of a vessel on the edge of its base at `angle` [rad]; return the final tilt."""
    model = bench(vessel).compile()
    data = mujoco.MjData(model)
    edge = vessel.profile.outer[0][0]
    data.qpos[:3] = (0, 0, edge * math.sin(angle))
    data.qpos[3:] = (math.cos(angle / 2), 0, math.sin(angle / 2), 0)
    run(model, data, 3.0)
    return tilt(data, vessel.name)


@every_vessel
def test_a_standing_vessel_stays_still(vessel):
    model = bench(vessel).compile()
    data = mujoco.MjData(model)
    run(model, data, 0.5)
    start = data.qpos.copy()
    run(model, data, 5.0)
    assert np.linalg.norm(data.qpos[:3] - start[:3]) < 2e-4
    assert abs(data.qpos[2]) < 5e-4
    assert tilt(data, vessel.name) < math.radians(0.1)


def test_a_small_beaker_dropped_into_a_larger_one_stands_on_its_bottom():
    large, small = (
        glassware("beaker", "800 ml", "large"),
        glassware("beaker", "150 ml", "small"),
    )
    model = bench(large, small).compile()
    data = mujoco.MjData(model)
    data.joint("small").qpos[:3] = (0.005, 0.003, large.height + 0.01)
    run(model, data, 3.0)
    assert data.body("small").xpos[2] == pytest.approx(large.profile.bottom, abs=5e-4)
    assert tilt(data, "small") < math.radians(1)
    assert tilt(data, "large") < math.radians(1)


@pytest.mark.parametrize("azimuth", np.linspace(0, 2 * np.pi / 16, 4))
@pytest.mark.parametrize("inside", [True, False])
@every_vessel
def test_a_ball_thrown_at_the_wall_does_not_pass_through(vessel, inside, azimuth):
    spec = bench(vessel, free=False)
    ball = spec.worldbody.add_body(name="ball")
    ball.add_freejoint(name="ball")
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.008, 0, 0), mass=0.005)
    model = spec.compile()
    data = mujoco.MjData(model)
    direction = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    start = 0.0 if inside else -vessel.footprint_radius - 0.03
    data.qpos[:3] = start * direction + (0, 0, 0.02)
    data.qvel[:3] = direction  # 1 m/s; no controlled motion is faster
    run(model, data, 0.3)
    distance = np.hypot(*data.qpos[:2])
    if inside:
        assert distance < vessel.profile.inner_radius(vessel.profile.bottom)
        assert vessel.profile.bottom < data.qpos[2] < vessel.height
    else:
        assert distance > vessel.profile.outer_radius(data.qpos[2])


@every_vessel
def test_a_vessel_tilted_ten_degrees_rights_itself(vessel):
    assert settle_from_tilt(vessel, math.radians(10)) < math.radians(0.2)


@every_vessel
def test_a_vessel_tips_at_the_angle_of_its_centre_of_mass_over_the_edge_of_its_base(vessel):
    tipping = math.atan2(vessel.profile.outer[0][0], vessel.mass_properties.com_height)
    assert settle_from_tilt(vessel, 0.93 * tipping) < math.radians(0.2)
    assert settle_from_tilt(vessel, 1.07 * tipping) > math.radians(60)
