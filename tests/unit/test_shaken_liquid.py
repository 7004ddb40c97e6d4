"""Liquid on shakers, mixers and pumps moves as hydrostatics and their drives have it."""

import math

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import ware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.instruments.mixing.vortex_mixer import VortexMixer
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

LEVEL = math.radians(10.0)
"""Position of the platform of a rocking shaker at which it is level [rad]."""


def standing_on(piece, vessel, ml: float, at: tuple[float, float, float]) -> Simulation:
    """Return an instrument on the bench, and a vessel of water at a place of its frame [m]."""
    contents = {vessel: Filling(ml=ml)}
    scene = compile_scene([piece, vessel], PANDA, LABORATORY, DOOR_VIEW, contents)
    simulation = Simulation(scene)
    simulation.reset({piece: Placement(0.3, 0.3, 0.0), vessel: Placement(0.9, -0.3, 0.0)})
    if piece.name == "shaker":
        simulation.data.joint(piece.platform.joint).qpos[:] = LEVEL
    place = np.array([0.3, 0.3, LABORATORY.bench.height]) + at
    simulation.data.joint(f"{vessel.name}_free").qpos[:3] = place
    play(simulation, 0.3)
    simulation.fill(np.random.default_rng(0))
    return simulation


def play(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


@pytest.mark.slow
def test_the_surface_stays_level_in_a_beaker_that_is_rocked():
    shaker = instrument("rocking_shaker", "shaker")
    beaker = ware("beaker_low", "250 ml", "beaker")
    simulation = standing_on(shaker, beaker, 100.0, (-0.010, 0.0, 0.1435))
    data, liquid = simulation.data, simulation.liquid
    assert liquid is not None
    data.joint(shaker.speed.joint).qpos[:] = 0.5 * shaker.speed.widest  # 30 rpm
    data.joint(shaker.power.joint).qpos[:] = shaker.power.widest
    play(simulation, 3.0)
    leans, middles = [], []
    for _ in range(120):
        play(simulation, 1 / 30)
        turn = data.body("beaker").xmat.reshape(3, 3)
        leans.append(turn[0, 2] / turn[2, 2])
        middles.append((turn.T @ (liquid.positions.mean(axis=0) - data.body("beaker").xpos))[0])
    assert np.ptp(leans) == pytest.approx(2 * math.tan(LEVEL), rel=0.05)
    # Of a cylinder of radius R, filled to h, whose surface stays level, the centre moves by R^2/4h
    # times the tangent of its lean (hydrostatics: second moment of the surface over the volume).
    radius = beaker.profile.inner_radius(0.02)
    height = 100e-6 / (math.pi * radius**2)
    slope, _ = np.polyfit(leans, middles, 1)
    assert slope == pytest.approx(radius**2 / (4 * height), rel=0.25)
    assert np.corrcoef(leans, middles)[0, 1] > 0.95
    account = simulation.account
    assert account is not None
    assert account.inside["beaker"] == pytest.approx(100e-6, rel=0.01)


@pytest.mark.slow
def test_a_tube_on_a_vortex_mixer_has_a_vortex_once_it_runs():
    mixer = VortexMixer("mixer", set_to=1500.0)
    tube = ware("test_tube", "16 x 160 mm", "tube")
    simulation = standing_on(mixer, tube, 6.0, (0.0145, 0.0, 0.150))
    data, liquid = simulation.data, simulation.liquid
    assert liquid is not None
    held = data.joint("tube_free").qpos.copy()

    def spin(seconds: float) -> float:
        """Hold the tube upright; return how fast its water turns about its axis [rad/s]."""
        turning = []
        for _ in range(round(30 * seconds)):
            data.joint("tube_free").qpos[3:] = held[3:]
            data.joint("tube_free").qvel[3:] = 0.0
            play(simulation, 1 / 30)
            off = liquid.positions - data.body("tube").xpos
            off[:, :2] -= off[:, :2].mean(axis=0)
            moving = liquid.velocities - liquid.velocities.mean(axis=0)
            moment = off[:, 0] * moving[:, 1] - off[:, 1] * moving[:, 0]
            turning.append(moment.sum() / (off[:, :2] ** 2).sum())
        return float(np.mean(turning[-30:]))

    assert abs(spin(1.0)) < 2.0
    data.joint(mixer.power.joint).qpos[:] = mixer.power.widest
    assert spin(3.0) > 10.0  # a quarter of 157 rad/s within 6 mm, less what the wall takes


@pytest.mark.slow
def test_a_syringe_pump_fills_a_beaker_at_the_rate_that_it_is_set_to():
    pump, beaker = instrument("syringe_pump", "pump"), ware("beaker_low", "100 ml", "beaker")
    scene = compile_scene([pump, beaker], PANDA, LABORATORY, DOOR_VIEW, {pump: Filling(ml=5)})
    simulation = Simulation(scene)
    outlet = (0.3 + 0.030, 0.3 + 0.185)
    simulation.reset({pump: Placement(0.3, 0.3, 0.0), beaker: Placement(*outlet, 0.0)})
    simulation.fill(np.random.default_rng(0))
    data = simulation.data
    data.joint(pump.rate.joint).qpos[:] = pump.rate.widest  # 60 ml/h
    for push in (5.0, 0.0):
        data.joint(pump.start.joint).qfrc_applied[:] = push
        play(simulation, 0.3)
    play(simulation, 4.4)
    assert simulation.account is not None
    before, given = simulation.account.inside["beaker"], "pump_given"
    begun = simulation.apparatus.reading(given).value
    play(simulation, 30.0)
    moved = simulation.account.inside["beaker"] - before
    assert 1e6 * moved == pytest.approx(60.0 / 3600.0 * 30.0, abs=0.015)  # three particles
    shown = simulation.apparatus.reading(given).value - begun
    assert shown == pytest.approx(60.0 / 3600.0 * 30.0, rel=0.02)
    assert simulation.account.spilled == 0.0
