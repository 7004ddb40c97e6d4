"""Heat: a plate warms water as power and losses have it, and nothing is lost on the way."""

import math

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heat_bench import alone, celsius, turn, warm_up
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.predicates import on_hot_surface, temperature_between
from labutopia_lerobot.processes import HeatExchange
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.substances.filling import (
    Filling,
    ImpossibleFillingError,
    require_fillable,
)

HEATER = Heater("heater")
BEAKER = glassware("beaker", "150 ml")
ROOM = 293.15


def on_the_plate(
    ml: float = 100.0, particles: int = 200, celsius: float | None = None
) -> Simulation:
    """Return a beaker of water on a hot plate that is off."""
    held = {BEAKER: Filling(ml, celsius=celsius)}
    scene = compile_scene([HEATER, BEAKER], PANDA, LABORATORY, DOOR_VIEW, held, particles)
    simulation = Simulation(scene)
    top = HEATER.top_height + 0.0005
    simulation.reset(
        {HEATER: Placement(0.2, 0.0, 0.0), BEAKER: Placement(0.2, 0.0, 0.0, height=top)}
    )
    simulation.fill(np.random.default_rng(0))
    return simulation


def switch_on(simulation: Simulation) -> None:
    simulation.apparatus.memory(HEATER.switch)[0] = 1.0


def energy(simulation: Simulation) -> tuple[float, float, float]:
    """Return the heat that is in all things above 0 K, what was supplied and what was lost [J]."""
    apparatus, liquid = simulation.apparatus, simulation.apparatus.liquid
    exchange = apparatus.processes["surface_at_hand"]
    assert isinstance(exchange, HeatExchange)
    assert liquid is not None
    held = liquid.warmth(BEAKER.name)
    assert held is not None
    total = held.capacity * held.temperature
    total += sum(m.capacity * m.temperature(apparatus) for m in exchange.masses)
    supplied, lost, _, evaporated, *_ = apparatus.memory(exchange)
    return total, supplied, lost + evaporated


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
        duty = min(max((300.0 + 273.15 - sensed) / 4.0, 0.0), 1.0)
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


@pytest.mark.slow
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


def test_boiling_water_gets_less_by_its_latent_heat_and_no_heat_is_lost_on_the_way():
    """2.26 MJ/kg (Incropera, table A.6): what the plate gives beyond what warms glass and room."""
    simulation = on_the_plate(60.0, 200, 98.0)
    liquid = simulation.liquid
    assert liquid is not None
    simulation.apparatus.memory(HEATER.hot)[0] = 573.15
    switch_on(simulation)
    warm_up(simulation, 30.0)
    before, supplied, lost = energy(simulation)
    filled, took = liquid.take_account().evaporated, 120.0
    warm_up(simulation, took)
    after, *given = energy(simulation)
    account = liquid.take_account()
    gone = account.evaporated - filled
    assert celsius(simulation, f"{BEAKER.name}_temperature") > 99.0
    assert after - before == pytest.approx(given[0] - supplied - given[1] + lost, rel=1e-9)
    assert 1e-6 < gone < 30e-6
    assert account.total + account.evaporated == pytest.approx(60e-6)
    steam = simulation.apparatus.processes["surface_at_hand"]
    assert isinstance(steam, HeatExchange)
    mass = next(one for one in steam.masses if one.name == f"{BEAKER.name}_temperature")
    watts = steam.vapour(simulation.apparatus, mass)
    assert gone == pytest.approx(watts * took / 2.26e6 / 998.0, rel=0.15)


def test_warm_water_loses_next_to_nothing_in_a_minute():
    simulation = on_the_plate(60.0, 1000, 40.0)
    warm_up(simulation, 60.0)
    assert simulation.liquid is not None
    assert simulation.liquid.take_account().evaporated < 0.1e-6


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
    simulation = on_the_plate(20.0, 60, 95.0)
    simulation.apparatus.memory(HEATER.hot)[0] = 573.15
    switch_on(simulation)
    warm_up(simulation, 60.0)
    assert simulation.liquid is not None
    assert simulation.liquid.take_account().evaporated > 0.0
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
    handling = simulation.apparatus.liquid
    assert handling is not None
    for _ in range(300):
        handling.mix(1 / 30)
    assert liquid.temperatures.sum() == pytest.approx(before, rel=1e-9)
    assert np.ptp(liquid.temperatures) < 0.2 * spread


@pytest.mark.parametrize(
    ("kind", "share", "set_to", "seconds"),
    [
        ("stirring_hot_plate", 0.5, 170.0, 400),
        ("water_bath", 0.25, 40.0, 700),
        ("dry_block_heater", 0.5, 75.0, 300),
        ("incubator", 0.34, 37.0, 1500),
        ("rotary_evaporator", 0.5, 60.0, 700),
    ],
)
def test_it_reaches_what_its_knob_sets_and_shows_what_it_has(kind, share, set_to, seconds):
    piece = instrument(kind, "it")
    simulation = alone(piece)
    shown = "it_thermometer"
    turn(simulation, piece.heat.joint, share * piece.heat.widest)
    power = getattr(piece, "power", None)
    if power is not None:
        warm_up(simulation, 20.0)
        assert celsius(simulation, shown) == 20.0  # it is switched off
        turn(simulation, power.joint, power.widest)
    warm_up(simulation, 10.0)
    assert celsius(simulation, shown) < set_to - 5.0
    warm_up(simulation, seconds - 10.0)
    assert celsius(simulation, shown) == pytest.approx(set_to, abs=4.0)
    assert shown in simulation.apparatus.displayed
    warm_up(simulation, 60.0)
    assert celsius(simulation, shown) == pytest.approx(set_to, abs=4.0)


def test_an_oven_heats_and_cools_with_its_door_open():
    oven = DryingOven("oven", button_color="green")
    simulation = alone(oven)
    simulation.apparatus.memory(oven.switch)[0] = 1.0
    warm_up(simulation, 1500.0)
    assert celsius(simulation, "oven_thermometer") == pytest.approx(105.0, abs=4.0)
    simulation.apparatus.memory(oven.switch)[0] = 0.0
    kept = simulation.state()
    cooled = []
    for position in (0.0, math.pi / 2):
        simulation.restore(kept)
        turn(simulation, oven.door.joint, position)
        warm_up(simulation, 60.0)
        cooled.append(celsius(simulation, "oven_thermometer"))
    assert cooled[0] > 98.0
    assert cooled[1] < cooled[0] - 20.0


@pytest.mark.parametrize(
    ("kind", "degrees", "way", "warmer"),
    [("refrigerator", 4.0, "upper", 2.0), ("ultra_low_freezer", -80.0, "lid", 2.0)],
)
def test_what_is_cold_stays_cold_and_warms_with_its_door_open(kind, degrees, way, warmer):
    piece = instrument(kind, "it")
    simulation = alone(piece)
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(degrees, abs=2.0)
    turn(simulation, getattr(piece, way).joint, math.radians(80.0))
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_thermometer") > degrees + warmer


def test_ice_cools_a_beaker_and_stays_at_0_while_it_melts():
    bucket = instrument("ice_bucket", "bucket")
    scene = compile_scene(
        [bucket, BEAKER], PANDA, LABORATORY, DOOR_VIEW, {BEAKER: Filling(50.0)}, 100
    )
    simulation = Simulation(scene)
    simulation.reset(
        {bucket: Placement(0.3, 0.2, 0.0), BEAKER: Placement(0.3, 0.2, 0.0, height=0.175)}
    )
    simulation.fill(np.random.default_rng(0))
    warm_up(simulation, 300.0)
    assert celsius(simulation, f"{BEAKER.name}_temperature") < 16.0
    assert celsius(simulation, "bucket_ice_temperature") == pytest.approx(0.0, abs=1e-9)
    melted = simulation.apparatus.memory(simulation.apparatus.processes["bucket_ice_temperature"])
    assert melted[2] > 1000.0


def test_a_hand_on_the_hot_plate_is_a_breach_and_one_on_the_cold_plate_is_none():
    simulation = on_the_plate(20.0, 60)
    world = SimulatedWorld(simulation)
    model, data = simulation.scene.model, simulation.data
    burnt = on_hot_surface(above_c=60.0)
    pad = model.geom(simulation.scene.robot.gripper.pads[0]).id
    plate = model.geom(HEATER.hot.surfaces[0]).id
    met = data.geom_xpos[plate] - data.geom_xpos[pad]
    for celsius_now, expected in ((20.0, False), (59.0, False), (80.0, True)):
        simulation.apparatus.memory(HEATER.hot)[0] = celsius_now + 273.15
        model.body(HEATER.name).pos = model.body(HEATER.name).pos - met
        mujoco.mj_step1(model, data)
        simulation.apparatus.step()
        model.body(HEATER.name).pos = model.body(HEATER.name).pos + met
        assert burnt.holds(world) is expected
    mujoco.mj_step1(model, data)
    simulation.apparatus.step()
    assert not burnt.holds(world)


def test_a_probe_follows_what_it_is_in_as_a_lag_of_two_seconds():
    heater = Heater("heater", probe_in=BEAKER.name)
    simulation = Simulation(
        compile_scene([heater, BEAKER], PANDA, LABORATORY, DOOR_VIEW, {BEAKER: Filling(100.0)}, 60)
    )
    simulation.reset({heater: Placement(0.2, 0.0, 0.0), BEAKER: Placement(0.5, 0.0, 0.0)})
    simulation.fill(np.random.default_rng(0))
    warm_up(simulation, 1.0)
    assert celsius(simulation, "heater_probe") == pytest.approx(20.0)
    liquid = simulation.apparatus.liquid
    assert liquid is not None
    warmed = 40.0
    liquid.warm_to(273.15 + warmed)
    simulation.apparatus.memory(simulation.apparatus.processes["heater_probe"])[:] = 20.0, 1.0
    for seconds in (1.0, 2.0, 4.0):
        warm_up(simulation, seconds)
        total = {1.0: 1.0, 2.0: 3.0, 4.0: 7.0}[seconds]
        expected = warmed - (warmed - 20.0) * math.exp(-total / 2.0)
        # The cold beaker takes some of the water's heat meanwhile.
        assert celsius(simulation, "heater_probe") == pytest.approx(expected, abs=1.0)


def test_a_task_can_ask_how_warm_a_vessel_is():
    simulation = on_the_plate(20.0, 60)
    world = SimulatedWorld(simulation)
    assert temperature_between(BEAKER, low_c=19.0, high_c=21.0).holds(world)
    assert simulation.liquid is not None
    simulation.liquid.warm_to(308.15)
    assert not temperature_between(BEAKER, low_c=19.0, high_c=21.0).holds(world)
    assert temperature_between(BEAKER, low_c=33.0, high_c=37.0).holds(world)


def test_a_cold_filling_begins_cold_with_its_glass_and_warms_up_in_a_warm_room():
    simulation = on_the_plate(20.0, 60, celsius=5.0)
    apparatus = simulation.apparatus
    assert celsius(simulation, f"{BEAKER.name}_temperature") == pytest.approx(5.0)
    glass = apparatus.processes[f"{BEAKER.name}_temperature"]
    assert apparatus.memory(glass)[0] == pytest.approx(278.15)
    assert celsius(simulation, HEATER.hot.name) == pytest.approx(20.0)
    total = energy(simulation)[0]
    warm_up(simulation, 60.0)
    now, _, lost = energy(simulation)
    assert 5.2 < celsius(simulation, f"{BEAKER.name}_temperature") < 20.0
    assert now - total == pytest.approx(-lost, rel=1e-9)


def test_water_that_would_boil_is_refused():
    with pytest.raises(
        ImpossibleFillingError, match="120 degrees C: it is liquid from 0 to below 100"
    ):
        require_fillable({BEAKER: Filling(20.0, celsius=120.0)}, {BEAKER: None})
