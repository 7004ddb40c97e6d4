"""Liquid nitrogen: it boils off by the heat that gets in; what is let down into it gets cold."""

import math

import numpy as np
import pytest

from heat_bench import alone, celsius, turn, warm_up
from instrument_bench import Bench
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation

DEWAR, TUBE = instrument("nitrogen_dewar", "it"), glassware("test_tube", "12 x 75 mm", "tube")
LATENT, DENSITY = 1.992e5, 806.6
NECK = math.pi * 0.047**2
RADIATED = NECK * 5.670e-8 * (293.15**4 - 77.35**4)
"""What a room of 20 degrees C radiates into a black hole as wide as the neck [W]."""


def left(simulation: Simulation) -> float:
    """Return how much nitrogen there is [kg]."""
    return float(simulation.apparatus.memory(DEWAR.nitrogen)[0])


def test_shut_it_loses_what_its_data_sheet_says_and_stays_at_its_boiling_point():
    simulation = alone(DEWAR)
    assert celsius(simulation, "it_level") == pytest.approx(35e-3 / (math.pi * 0.2**2) * 1e3)
    before = left(simulation)
    warm_up(simulation, 120.0)
    per_day = (before - left(simulation)) / DENSITY * 1e3 * 86400.0 / 120.0
    assert per_day == pytest.approx(0.3, rel=1e-3)
    assert celsius(simulation, "it_boil_off") == pytest.approx(0.3, rel=1e-3)
    assert celsius(simulation, "it_temperature") == pytest.approx(-195.8, abs=1e-3)


def test_open_it_boils_off_by_what_the_room_radiates_down_its_neck_as_well():
    simulation = alone(DEWAR)
    turn(simulation, DEWAR.stopper.joint, 0.400)
    before = left(simulation)
    warm_up(simulation, 60.0)
    power = RADIATED + 0.3e-3 / 86400.0 * DENSITY * LATENT
    assert before - left(simulation) == pytest.approx(60.0 * power / LATENT, rel=1e-3)
    assert celsius(simulation, "it_boil_off") > 5.0 * 0.3


def test_a_dry_vessel_warms_up_by_what_gets_in():
    simulation = alone(DEWAR)
    turn(simulation, DEWAR.stopper.joint, 0.400)
    simulation.apparatus.memory(DEWAR.nitrogen)[0] = 1e-4
    warm_up(simulation, 60.0)
    assert left(simulation) == 0.0
    assert celsius(simulation, "it_level") == 0.0
    power = RADIATED + 0.3e-3 / 86400.0 * DENSITY * LATENT
    gained = (60.0 * power - 1e-4 * LATENT) / (35e-3 * DENSITY * 2042.0)
    warmer = celsius(simulation, "it_temperature") + 195.8
    assert warmer == pytest.approx(gained, rel=2e-3)


def cooling(drawn: float) -> Simulation:
    """Return a tube in the canister, which is drawn up by so much [m]."""
    simulation = Simulation(compile_scene([DEWAR, TUBE], PANDA, LABORATORY, DOOR_VIEW))
    low = 0.6705 - 0.480 + 0.0045
    where = {
        DEWAR: Placement(1.0, 0.0, 0.0),
        TUBE: Placement(1.0, 0.0, 0.0, height=low + drawn),
    }
    simulation.reset(where)
    turn(simulation, DEWAR.stopper.joint, drawn)
    return simulation


def test_what_stands_in_the_canister_gets_as_cold_and_boils_off_what_its_heat_does():
    simulation = cooling(0.0)
    (glass,) = (
        mass
        for mass in simulation.apparatus.processes["surface_at_hand"].masses
        if mass.body == "tube"
    )
    before, radius = left(simulation), TUBE.profile.outer[0][0]
    lag = glass.capacity / (150.0 * (glass.area + math.pi * radius**2))
    warm_up(simulation, lag)
    apart = celsius(simulation, "tube_temperature") + 195.8
    assert apart == pytest.approx(215.8 / math.e, rel=0.02)
    warm_up(simulation, 100.0)
    assert celsius(simulation, "tube_temperature") == pytest.approx(-195.8, abs=0.2)
    static = (lag + 100.0) * 0.3e-3 / 86400.0 * DENSITY
    boiled = glass.capacity * 215.8 / LATENT
    assert before - left(simulation) == pytest.approx(boiled + static, rel=0.01)


def test_drawn_up_the_canister_is_out_of_the_neck_and_warms_again():
    bench = Bench("nitrogen_dewar")
    bench.put(bench.piece.stopper, 1.0)
    bench.wait(0.1)
    assert bench.data.site(bench.piece.canister.name).xpos[2] > 0.670
    simulation = cooling(0.5)
    memory = simulation.apparatus.memory(simulation.apparatus.processes["tube_temperature"])
    memory[0] = 77.35
    warm_up(simulation, 30.0)
    assert celsius(simulation, "tube_temperature") > -160.0


def mist(simulation: Simulation) -> float:
    """Return the opacity of its densest puff."""
    simulation.apparatus.show()
    model = simulation.scene.model
    return max(float(model.geom(f"it_boil_off_{n}").rgba[3]) for n in range(16))


def test_mist_is_seen_over_an_open_neck_and_more_where_something_warm_is_let_down():
    simulation = alone(DEWAR)
    warm_up(simulation, 0.1)
    assert mist(simulation) == 0.0
    turn(simulation, DEWAR.stopper.joint, 0.4)
    warm_up(simulation, 0.1)
    opened = mist(simulation)
    puffs = [simulation.data.geom(f"it_boil_off_{n}").xpos for n in range(16)]
    mouth = simulation.data.site("it_mouth").xpos
    assert opened > 0.02
    assert all(puff[2] <= mouth[2] for puff in puffs)  # it is heavier than air
    assert max(np.linalg.norm((puff - mouth)[:2]) for puff in puffs) > 0.075  # over the rim
    warm = cooling(0.0)
    warm_up(warm, 0.1)
    assert mist(warm) > opened
