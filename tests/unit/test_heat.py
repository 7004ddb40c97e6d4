"""Heat: a plate warms water as power and losses have it, and nothing is lost on the way."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.processes import HeatExchange
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

HEATER = Heater("heater")
BEAKER = glassware("beaker", "150 ml")
ROOM = 293.15


def on_the_plate(ml: float = 100.0, particles: int = 200) -> Simulation:
    """Return a beaker of water on a hot plate that is off."""
    scene = compile_scene(
        [HEATER, BEAKER], PANDA, LABORATORY, DOOR_VIEW, {BEAKER: Filling(ml)}, particles
    )
    simulation = Simulation(scene)
    top = HEATER.top_height + 0.0005
    simulation.reset(
        {HEATER: Placement(0.2, 0.0, 0.0), BEAKER: Placement(0.2, 0.0, 0.0, height=top)}
    )
    simulation.fill(np.random.default_rng(0))
    return simulation


def warm_up(simulation: Simulation, seconds: float) -> None:
    """Let the processes work alone: nothing moves, and only heat flows."""
    for _ in range(round(30 * seconds)):
        simulation.apparatus.step()


def switch_on(simulation: Simulation) -> None:
    simulation.apparatus.memory(HEATER.switch)[0] = 1.0


def celsius(simulation: Simulation, name: str) -> float:
    return simulation.apparatus.reading(name).value


def energy(simulation: Simulation) -> tuple[float, float, float]:
    """Return the heat that is in all things above 0 K, what was supplied and what was lost [J]."""
    apparatus, liquid = simulation.apparatus, simulation.liquid
    exchange = apparatus.processes["surface_at_hand"]
    assert isinstance(exchange, HeatExchange)
    assert liquid is not None
    held = liquid.warmth(BEAKER.name)
    assert held is not None
    total = held.capacity * held.temperature
    total += sum(m.capacity * m.temperature(apparatus) for m in exchange.masses)
    supplied, lost, _ = apparatus.memory(exchange)
    return total, supplied, lost


def independent(seconds: np.ndarray) -> np.ndarray:
    """Integrate plate, glass and 100 ml of water; every number is written down again here."""
    radius, height = 0.060, 0.008
    plate_capacity = math.pi * radius**2 * height * 2570.0 * 800.0
    glass_capacity = BEAKER.mass * 830.0
    water_capacity = 100e-6 * 997.0 * 4182.0
    profile = BEAKER.profile
    foot = math.pi * profile.outer[0][0] ** 2
    corners = np.array(profile.outer)
    slant = np.hypot(*np.diff(corners, axis=0).T)
    side = float((math.pi * (corners[1:, 0] + corners[:-1, 0]) * slant).sum())
    level = profile.fill_height(100e-6)
    inner = profile.inner_radius(level)
    wetted = math.pi * inner**2 + 2 * 100e-6 / inner

    def lost(t: float, length: float, c: float, area: float) -> float:
        free = c * (abs(t - ROOM) / length) ** 0.25 * (t - ROOM)
        return area * (free + 0.9 * 5.670e-8 * (t**4 - ROOM**4))

    def vapour(t: float) -> float:
        def density(at: float) -> float:
            c = at - 273.15
            return 610.94 * math.exp(17.625 * c / (c + 243.04)) / (461.5 * at)

        speed = 5.0 / (1.19 * 1007.0 * 0.85 ** (2 / 3))
        return math.pi * inner**2 * max(0.0, speed * 2.43e6 * (density(t) - density(ROOM) / 2))

    def rates(_: float, y: np.ndarray) -> list[float]:
        plate, glass, water, sensed = y
        duty = min(max((300.0 + 273.15 - sensed) / 4.0 + 0.5, 0.0), 1.0)
        into_glass = 115.0 * foot * (plate - glass)
        into_water = 500.0 * wetted * (glass - water)
        plate_loss = lost(plate, radius / 2, 1.32, math.pi * radius**2) + 0.2 * (plate - ROOM)
        return [
            (500.0 * duty - into_glass - plate_loss) / plate_capacity,
            (into_glass - into_water - lost(glass, BEAKER.height, 1.42, side)) / glass_capacity,
            (into_water - vapour(water)) / water_capacity,
            (plate - sensed) / 2.0,
        ]

    answer = solve_ivp(
        rates, (0.0, seconds[-1]), [ROOM] * 4, t_eval=seconds, rtol=1e-6, max_step=0.2
    )
    return np.asarray(answer.y)


def test_100_ml_of_water_warm_up_along_the_curve_that_power_and_losses_give():
    simulation = on_the_plate()
    switch_on(simulation)
    times = np.arange(30.0, 301.0, 30.0)
    curve = []
    for _ in times:
        warm_up(simulation, 30.0)
        curve.append(
            [
                celsius(simulation, f"{BEAKER.name}_temperature"),
                celsius(simulation, HEATER.hot.name),
            ]
        )
    plate, _, water, _ = independent(times) - 273.15
    risen, expected = np.array(curve)[:, 0] - 20.0, water - 20.0
    assert risen[-1] > 30.0
    assert risen == pytest.approx(expected, rel=0.03)
    assert np.array(curve)[:, 1] == pytest.approx(plate, rel=0.03)


def test_what_is_supplied_is_in_the_things_or_was_lost():
    simulation = on_the_plate()
    before, _, _ = energy(simulation)
    switch_on(simulation)
    warm_up(simulation, 120.0)
    after, supplied, lost = energy(simulation)
    assert supplied > 2e4
    assert after - before == pytest.approx(supplied - lost, rel=1e-9)


def test_nothing_changes_while_nothing_heats():
    simulation = on_the_plate()
    warm_up(simulation, 5.0)
    assert celsius(simulation, f"{BEAKER.name}_temperature") == pytest.approx(20.0, abs=1e-12)
    assert energy(simulation)[1:] == (0.0, 0.0)


def test_the_thermostat_holds_the_plate_at_its_set_point():
    simulation = on_the_plate()
    switch_on(simulation)
    warm_up(simulation, 240.0)
    held = []
    for _ in range(60):
        warm_up(simulation, 1.0)
        held.append(celsius(simulation, HEATER.hot.name))
    assert all(abs(t - 300.0) < 4.0 for t in held)


def test_saved_and_restored_it_goes_on_bit_for_bit():
    simulation = on_the_plate(20.0, 60)
    switch_on(simulation)
    warm_up(simulation, 20.0)
    kept = simulation.state()
    ends = []
    for _ in range(2):
        simulation.restore(kept)
        for _ in range(20):
            simulation.step(simulation.command)
        ends.append(simulation.state())
    assert (ends[0] == ends[1]).all()
    assert simulation.liquid is not None
    assert np.ptp(simulation.liquid.temperatures) >= 0.0
    assert simulation.liquid.temperatures.mean() > ROOM


def test_what_mixes_keeps_its_heat():
    simulation = on_the_plate(20.0, 60)
    liquid = simulation.liquid
    assert liquid is not None
    liquid.temperatures[::2] += 40.0
    before = liquid.temperatures.sum()
    spread = np.ptp(liquid.temperatures)
    for _ in range(300):
        liquid.mix(1 / 30)
    assert liquid.temperatures.sum() == pytest.approx(before, rel=1e-9)
    assert np.ptp(liquid.temperatures) < 0.2 * spread
