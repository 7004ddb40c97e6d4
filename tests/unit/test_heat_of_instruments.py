"""Instruments that heat: each against what its power, its mass and its losses give."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heat_bench import alone, celsius, turn, warm_up
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.sim.simulation import Simulation

ROOM = 20.0


def switched_on(kind: str, share: float) -> Simulation:
    """Return an instrument with a knob and a switch, its knob at a share of its way."""
    piece = instrument(kind, "it")
    simulation = alone(piece)
    turn(simulation, piece.heat.joint, share * piece.heat.widest)
    turn(simulation, piece.power.joint, piece.power.widest)
    return simulation


def running(kind: str, timer: str, minutes: float) -> Simulation:
    """Return an instrument whose program has begun."""
    simulation = alone(instrument(kind, "it"))
    simulation.apparatus.memory(simulation.apparatus.processes[timer])[0] = 60.0 * minutes
    return simulation


def warmed(watt: float, capacity: float, seconds: float, leak: float, area: float) -> float:
    """Integrate one mass that faces up, or loses through its insulation only [degrees C]."""
    length = math.sqrt(area / math.pi) / 2 if area else 1.0

    def rate(_: float, y: np.ndarray) -> list[float]:
        above, kelvin = float(y[0]) - ROOM, float(y[0]) + 273.15
        convected = 1.32 * (max(above, 0.0) / length) ** 0.25 * above
        radiated = 0.9 * 5.670e-8 * (kelvin**4 - (ROOM + 273.15) ** 4)
        return [(watt - leak * above - area * (convected + radiated)) / capacity]

    return float(solve_ivp(rate, (0.0, seconds), [ROOM], rtol=1e-6, max_step=1.0).y[0, -1])


@pytest.mark.parametrize("seconds", [60, 600])
def test_a_mantle_warms_up_by_what_its_regulator_lets_through_and_has_no_set_point(seconds):
    simulation = switched_on("heating_mantle", 0.5)
    warm_up(simulation, seconds)
    assert celsius(simulation, "it_power_now") == 100.0
    expected = warmed(100.0, 160.0, seconds, 0.25, math.pi * 0.054**2)
    now = celsius(simulation, "it_cloth")
    assert now - ROOM == pytest.approx(expected - ROOM, rel=0.03)


def test_a_melting_point_block_heats_with_all_its_power_and_holds_what_its_knob_sets():
    simulation = switched_on("melting_point_apparatus", 0.5)
    warm_up(simulation, 60.0)
    expected = warmed(150.0, 240.0, 60.0, 0.2, 2.5e-3)
    assert celsius(simulation, "it_surface") - ROOM == pytest.approx(expected - ROOM, rel=0.03)
    warm_up(simulation, 500.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(190.0, abs=4.0)


def test_an_autoclave_gets_to_121_degrees_as_its_power_has_it_and_only_while_its_cycle_runs():
    simulation = running("autoclave", "it_left", 60.0)
    capacity = 3.0 * 0.997 * 4182.0 + 12.0 * 480.0
    warm_up(simulation, 300.0)
    full = 2000.0 / 2.0  # where power and leak would balance [K]
    expected = ROOM + full * -math.expm1(-300.0 * 2.0 / capacity)
    assert celsius(simulation, "it_steam") == pytest.approx(expected, rel=0.02)
    warm_up(simulation, 900.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(121.0, abs=1.0)
    turn(simulation, instrument("autoclave", "it").lid.joint, math.radians(60.0))
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_thermometer") < 119.0


def test_a_cycler_goes_through_its_temperatures_in_time_at_3_k_per_second():
    simulation = running("thermal_cycler", "it_time", 90.0)
    warm_up(simulation, 10.0)
    assert celsius(simulation, "it_surface") == pytest.approx(ROOM + 700.0 / 230.0 * 10.0, rel=0.05)
    held = []
    for seconds in (105.0, 30.0, 30.0, 60.0):  # 5 s before the end of each step
        warm_up(simulation, seconds)
        held.append(celsius(simulation, "it_thermometer"))
    assert held == pytest.approx([95.0, 95.0, 55.0, 72.0], abs=0.5)


def test_the_oven_of_a_chromatograph_heats_during_a_run_and_stops_when_it_is_opened():
    simulation = running("gas_chromatograph", "it_run", 20.0)
    warm_up(simulation, 800.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(100.0, abs=4.0)
    apparatus = simulation.apparatus
    assert apparatus.processes["it_thermometer"].text(apparatus).endswith("\u00b0C")
    turn(simulation, instrument("gas_chromatograph", "it").door.joint, math.radians(90.0))
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_run") == 0.0
    assert celsius(simulation, "it_thermometer") < 80.0
    assert apparatus.processes["it_thermometer"].text(apparatus) == "OVEN OPEN"
