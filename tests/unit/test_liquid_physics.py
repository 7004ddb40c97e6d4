"""Liquids against references: the source stands with each claim."""

import os
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.glass.profile import Profile
from labutopia_lerobot.labware.glass.vessel import Vessel
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.solver.flow import GRAVITY, LIQUID_HZ
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import WATER
from labutopia_lerobot.world.model import PHYSICS_HZ
from liquid_experiments import FRONTS, collapse, filled, move_to, surface, swirl, world
from run_over import CAPILLARY_LENGTH, run_over, tilt_to_barrier


@pytest.mark.parametrize("count", [1000, 2000])
@pytest.mark.parametrize(
    ("vessel", "ml"),
    [
        (glassware("beaker", "250 ml", "glass"), 100.0),
        (glassware("conical_flask", "300 ml", "glass"), 150.0),
    ],
)
def test_a_volume_stands_as_high_as_the_cavity_has_room_for_it(
    vessel: Vessel, ml: float, count: int
) -> None:
    _, _, liquid = filled(vessel, Filling(ml), count)
    for _ in range(LIQUID_HZ // 3):
        liquid.step()
    bottom = vessel.profile.bottom
    depth = vessel.profile.fill_height(ml * 1e-6) - bottom
    assert surface(liquid)[0] - bottom == pytest.approx(depth, rel=0.05)


def test_a_full_cylinder_runs_over_at_once_and_half_a_one_when_its_diagonal_is_level() -> None:
    profile = Profile(((0.03, 0.0), (0.03, 0.1)), 0.001, 0.001)
    inner = profile.height - profile.bottom
    assert tilt_to_barrier(profile, 0.99 * profile.capacity) < np.radians(2.0)
    half = tilt_to_barrier(profile, profile.capacity / 2)
    assert half == pytest.approx(np.arctan2(inner, 2 * profile.inner_radius(0.1)), abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("vessel", "ml"),
    [
        (glassware("beaker", "250 ml", "glass"), 100.0),
        (glassware("conical_flask", "300 ml", "glass"), 200.0),
    ],
)
def test_a_vessel_runs_over_when_its_surface_is_a_capillary_length_above_the_barrier(
    vessel: Vessel, ml: float
) -> None:
    assert 0.0 < run_over(vessel, ml, 500).above < 1.5 * CAPILLARY_LENGTH


@pytest.mark.parametrize(
    "vessel",
    [
        glassware("beaker", "250 ml", "glass"),
        glassware("conical_flask", "300 ml", "glass"),
    ],
)
def test_the_surface_stays_level_in_a_vessel_that_is_tilted_slowly(vessel: Vessel) -> None:
    model, data, liquid = filled(vessel, Filling(100.0), height=0.1)
    tilt, seconds = np.radians(25.0), 2.0
    for step in range(round((seconds + 0.5) * LIQUID_HZ)):
        move_to(model, data, (0, 0, 0.1), tilt * min(1.0, step / (seconds * LIQUID_HZ)))
        liquid.step()
    assert liquid.take_account().counts[0, 0] == 1000
    assert np.degrees(surface(liquid)[1]) < 4.0


def test_the_bench_carries_the_vessel_and_its_liquid() -> None:
    vessel = glassware("beaker", "250 ml", "glass")
    model, data, liquid = filled(vessel, Filling(100.0))
    loads, force = [], np.empty(6)
    for step in range(PHYSICS_HZ):
        mujoco.mj_step2(model, data)
        mujoco.mj_step1(model, data)
        if step % (PHYSICS_HZ // LIQUID_HZ) == 0:
            liquid.step()
        mujoco.mj_forward(model, data)
        load = 0.0
        for index, contact in enumerate(data.contact):
            mujoco.mj_contactForce(model, data, index, force)
            load += abs(contact.frame.reshape(3, 3)[:, 2] @ force[:3])
        loads.append(load)
    weight = (vessel.mass + WATER.density * 100e-6) * GRAVITY
    assert np.mean(loads[-PHYSICS_HZ // 2 :]) == pytest.approx(weight, rel=0.02)


def test_a_vessel_held_at_a_tilt_feels_the_weight_where_the_liquid_is() -> None:
    model, data, liquid = filled(glassware("beaker", "250 ml", "glass"), Filling(100.0), height=0.1)
    for step in range(LIQUID_HZ):
        move_to(model, data, (0, 0, 0.1), np.radians(25.0) * min(1.0, 1.5 * step / LIQUID_HZ))
        liquid.step()
    wrenches, centres = [], []
    for _ in range(LIQUID_HZ // 2):
        liquid.step()
        wrenches.append(data.xfrc_applied[1].copy())
        centres.append(liquid.positions.mean(axis=0))
    wrench = np.mean(wrenches, axis=0)
    weight = np.array([0, 0, -WATER.density * 100e-6 * GRAVITY])
    moment = np.cross(np.mean(centres, axis=0) - data.xipos[1], weight)
    assert wrench[:3] == pytest.approx(weight, abs=0.02 * abs(weight[2]))
    # The lever arm is that of the centre of mass to within half a millimetre.
    assert wrench[3:] == pytest.approx(moment, abs=5e-4 * abs(weight[2]))


def test_a_breaking_dam_runs_as_in_martin_and_moyces_experiment() -> None:
    times, fronts, _ = collapse(across=12)
    assert np.interp(FRONTS[:, 0], times, fronts) == pytest.approx(FRONTS[:, 1], rel=0.15)


def test_glycerol_brakes_a_swirl_as_fast_as_its_viscosity_and_far_faster_than_water() -> None:
    water, ethanol, glycerol = map(swirl, ("water", "ethanol", "glycerol"))
    assert glycerol.rate == pytest.approx(glycerol.stokes, rel=0.25)
    assert glycerol.rate > 5 * water.rate
    assert ethanol.rate == pytest.approx(water.rate, rel=0.5)  # both below what particles can show


def test_a_falling_blob_moves_as_one_body() -> None:
    model, data = world(bench=False)
    liquid = Liquid(model, data, [], [Filling(20.0)], 200)
    places = np.random.default_rng(0).uniform(-0.012, 0.012, (200, 3))
    velocity, pull = np.array([0.3, 0.0, 1.0]), np.array([0.0, 0.0, -GRAVITY])
    liquid.release(places, np.tile(velocity, (200, 1)))
    steps, dt = LIQUID_HZ // 2, 1.0 / LIQUID_HZ
    for _ in range(steps):
        liquid.step()
    # Symplectic Euler, n steps of a constant acceleration.
    way = steps * dt * velocity + steps * (steps + 1) / 2 * dt**2 * pull
    assert liquid.positions.mean(axis=0) == pytest.approx(places.mean(axis=0) + way, abs=1e-10)
    assert liquid.velocities.mean(axis=0) == pytest.approx(velocity + steps * dt * pull, abs=1e-10)


def test_what_the_liquid_gains_in_momentum_the_vessel_gave_it() -> None:
    model, data, liquid = filled(
        glassware("beaker", "250 ml", "glass"), Filling(100.0), bench=False
    )
    mass = WATER.density * 100e-6
    for step in range(LIQUID_HZ):
        before = mass * liquid.velocities.mean(axis=0)
        shift = 0.05 * np.sin(10 * step / LIQUID_HZ)
        move_to(model, data, (shift, 0, 0), 0.2 * np.sin(7 * step / LIQUID_HZ))
        liquid.step()
        gain = mass * liquid.velocities.mean(axis=0) - before
        given = (np.array([0, 0, -mass * GRAVITY]) - data.xfrc_applied[1, :3]) / LIQUID_HZ
        assert gain == pytest.approx(given, abs=1e-12)


def spill(steps: int) -> tuple[mujoco.MjModel, mujoco.MjData, Liquid]:
    """Turn a beaker over, above the bench, within half a second."""
    model, data, liquid = filled(
        glassware("beaker", "250 ml", "glass"), Filling(100.0), 500, height=0.15
    )
    for step in range(steps):
        turn_over(model, data, step)
        liquid.step()
    return model, data, liquid


def turn_over(model: mujoco.MjModel, data: mujoco.MjData, step: int) -> None:
    move_to(model, data, (0, 0, 0.15), np.radians(135) * min(1.0, 2.0 * step / LIQUID_HZ))


def test_the_same_seed_gives_the_same_bits() -> None:
    first, second = (spill(LIQUID_HZ)[2].state() for _ in range(2))
    assert first.tobytes() == second.tobytes()


@pytest.mark.slow
def test_the_process_that_compiles_the_kernels_computes_the_same_bits(tmp_path: Path) -> None:
    spilling = f"import runpy; liquid = runpy.run_path({__file__!r})['spill'](30)[2]"
    command = [sys.executable, "-c", f"{spilling}; print(liquid.state().tobytes().hex())"]
    paths = {"NUMBA_CACHE_DIR": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)}
    environment = os.environ | paths
    first, later = (subprocess.check_output(command, env=environment) for _ in range(2))
    assert first == later


def test_a_restored_liquid_goes_on_with_the_same_bits() -> None:
    half, whole = LIQUID_HZ // 2, LIQUID_HZ
    _, _, through = spill(whole)
    model, data, saved = spill(half)
    turn_over(model, data, half - 1)
    other = Liquid(model, data, saved.vessels, [Filling(100.0)], 500)
    other.restore(saved.state())
    for step in range(half, whole):
        turn_over(model, data, step)
        other.step()
    assert other.state().tobytes() == through.state().tobytes()


def test_every_particle_is_in_the_vessel_spilled_clinging_or_in_flight() -> None:
    model, data, liquid = filled(
        glassware("beaker", "250 ml", "glass"), Filling(100.0), 500, height=0.15
    )
    profile, seen = glassware("beaker", "250 ml", "glass").profile, set()
    for step in range(2 * LIQUID_HZ):
        turn_over(model, data, step)
        liquid.step()
        local = (liquid.positions - data.xpos[1]) @ data.xmat[1].reshape(3, 3)
        radius, z = np.hypot(local[:, 0], local[:, 1]), local[:, 2]
        limit = np.array([profile.inner_radius(height) for height in z])
        held = (z > profile.bottom) & (z < profile.height) & (radius < limit)
        counts = liquid.take_account().counts
        inside, spilled, clinging, in_flight = counts[0].tolist()
        assert inside == held.sum()
        assert inside + spilled + clinging + in_flight == len(liquid.positions) == 500
        assert not counts[1].any()  # nothing comes from nowhere
        seen |= {("spilled", spilled > 0), ("in flight", in_flight > 0)}
        assert not clinging  # to no hand, and to nothing that falls
    # Some ran down the glass, some fell, and in the end all has arrived.
    assert seen == {(name, yes) for name in ("spilled", "in flight") for yes in (True, False)}
    assert (inside, spilled) == (0, 500)
    assert not liquid.diverged


def test_a_drop_that_a_box_closes_on_leaves_it_without_being_shot_out() -> None:
    depth, top = 0.045, 0.15
    model, data = world(boxes=[((0, 0, top - 0.05), (0.05, 0.05, 0.05))])
    liquid = Liquid(model, data, [], [Filling(100.0)])
    liquid.release(np.array([[0.0, 0.0, top - depth]]), np.zeros((1, 3)))
    fastest = 0.0
    for _ in range(LIQUID_HZ // 10):
        liquid.step()
        fastest = max(fastest, float(np.abs(liquid.velocities).max()))
    assert liquid.positions[0, 2] > top
    assert fastest < 0.5 * depth * LIQUID_HZ  # in one step it would leave twice as fast


@pytest.mark.parametrize("velocity", [np.nan, np.inf, 1e3, 1e30])
def test_a_solver_that_fails_says_so_and_keeps_finite_positions(velocity: float) -> None:
    _, data, liquid = filled(glassware("beaker", "250 ml", "glass"), Filling(100.0), 200)
    before = liquid.positions.copy()
    liquid.velocities[7, 0] = velocity
    for _ in range(2):
        liquid.step()
        assert liquid.diverged
        assert np.array_equal(liquid.positions, before)
        assert np.isfinite(liquid.state()).all()
        assert not data.xfrc_applied.any()
