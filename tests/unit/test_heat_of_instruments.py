"""Instruments that heat: each against what its power, its mass and its losses give."""

import math

import mujoco
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heat_bench import alone, celsius, turn, warm_up
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.labware.instruments.muffle_furnace import MuffleFurnace
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

ROOM = 20.0
BEAKER = glassware("beaker", "150 ml")


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


def furnace(set_to: float, celsius_inside: float) -> Simulation:
    """Return a muffle furnace that is on, lining and air at a temperature."""
    piece = MuffleFurnace("it", set_to=set_to)
    simulation = alone(piece)
    turn(simulation, piece.power.joint, piece.power.widest)
    for name in ("it_lining", "it_air", "it_thermometer"):
        apparatus = simulation.apparatus
        apparatus.memory(apparatus.processes[name])[0] = celsius_inside + 273.15
    return simulation


def test_a_muffle_furnace_heats_as_4500_watts_and_its_insulation_have_it():
    simulation = furnace(1100.0, ROOM)
    warm_up(simulation, 300.0)
    air = 0.30 * 0.24 * 0.36 * 1.19 * 1007.0
    full = 4500.0 / 1.5  # where power and leak would balance [K]
    expected = full * -math.expm1(-300.0 * 1.5 / (19_000.0 + air))
    assert celsius(simulation, "it_lining") - ROOM == pytest.approx(expected, rel=0.02)
    to_1100 = -(19_000.0 + air) / 1.5 * math.log(1.0 - 1080.0 / full)
    assert to_1100 / 60.0 == pytest.approx(95.0, rel=0.05)  # what makers state


def test_a_muffle_furnace_holds_what_it_is_set_to_and_shows_it():
    simulation = furnace(600.0, 590.0)
    warm_up(simulation, 300.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(600.0, abs=5.0)
    apparatus = simulation.apparatus
    text = apparatus.processes["it_thermometer"].text(apparatus)
    assert text == f"{celsius(simulation, 'it_thermometer'):.0f} \u00b0C"


def test_through_the_open_door_of_a_hot_furnace_goes_what_radiates_and_what_the_air_takes_along():
    piece = MuffleFurnace("it", set_to=20.0)
    simulation = furnace(20.0, 1000.0)
    turn(simulation, piece.door.joint, math.pi / 2)
    warm_up(simulation, 60.0)
    area, room = 0.30 * 0.24, ROOM + 273.15
    walls = 2 * (0.30 * 0.24 + 0.24 * 0.36 + 0.36 * 0.30)

    def rate(_: float, y: np.ndarray) -> list[float]:
        lining, air = y
        flow = 1.19 * 1007.0 * 0.61 / 3 * area
        flow *= math.sqrt(9.81 * 0.24 * (air - room) / ((air + room) / 2))
        given = 25.0 * walls * (lining - air)
        radiated = 0.9 * 5.670e-8 * area * (lining**4 - room**4)
        lost = 1.5 * (lining - room) + radiated
        capacity = 0.30 * 0.24 * 0.36 * 1.19 * 1007.0
        return [-(lost + given) / 19_000.0, (given - flow * (air - room)) / capacity]

    start = [1273.15, 1273.15]
    end = solve_ivp(rate, (0.0, 60.0), start, method="LSODA", rtol=1e-7).y[0, -1]
    cooled = 1000.0 - celsius(simulation, "it_lining")
    assert cooled == pytest.approx(1273.15 - end, rel=0.03)
    shut = furnace(20.0, 1000.0)
    warm_up(shut, 60.0)
    assert 1000.0 - celsius(shut, "it_lining") < 0.2 * cooled


def test_the_coils_of_a_furnace_glow_from_500_degrees_on():
    simulation = furnace(1000.0, 400.0)
    coil = simulation.scene.model.geom("it_coil_left_0")
    simulation.apparatus.show()
    dark = coil.rgba.copy()
    memory = simulation.apparatus.memory(simulation.apparatus.processes["it_lining"])
    memory[0] = 1000.0 + 273.15
    simulation.apparatus.show()
    assert coil.rgba[0] > dark[0] + 0.3


def test_a_cold_furnace_has_neither_switch_nor_temperature():
    piece = MuffleFurnace("it", set_to=None)
    assert piece.processes == ()
    assert piece.joints == (piece.door.joint,)


def flame_under_a_beaker(kind: str) -> Simulation:
    """Return 100 ml of water in a beaker on a tripod, a burner below it that burns fully."""
    burner, tripod = instrument(kind, "burner"), instrument("tripod", "tripod")
    pieces = [burner, tripod, BEAKER]
    scene = compile_scene(pieces, PANDA, LABORATORY, DOOR_VIEW, {BEAKER: Filling(100.0)}, 200)
    simulation = Simulation(scene)
    gauze = tripod.gauze.at[2] + 0.0005
    simulation.reset(
        {
            burner: Placement(0.4, 0.0, 0.0),
            tripod: Placement(0.4, 0.0, 0.0),
            BEAKER: Placement(0.4, 0.0, 0.0, height=gauze),
        }
    )
    simulation.fill(np.random.default_rng(0))
    for part in burner.mechanisms:
        turn(simulation, part.joint, part.widest)
    mujoco.mj_kinematics(simulation.scene.model, simulation.data)
    return simulation


@pytest.mark.parametrize(("kind", "watt"), [("bunsen_burner", 1200.0), ("alcohol_lamp", 250.0)])
def test_a_flame_heats_what_stands_above_it_as_its_power_and_its_gases_have_it(kind, watt):
    simulation = flame_under_a_beaker(kind)
    warm_up(simulation, 60.0)
    assert celsius(simulation, "burner_flame") == watt
    foot = math.pi * BEAKER.profile.outer[0][0] ** 2
    inner = BEAKER.profile.inner_radius(BEAKER.profile.fill_height(100e-6))
    wetted = math.pi * inner**2 + 2 * 100e-6 / inner
    outside = 2 * math.pi * BEAKER.profile.outer[0][0] * BEAKER.height

    def rates(_: float, y: np.ndarray) -> list[float]:
        gases, glass, water = y
        onto, into = 80.0 * foot * (gases - glass), 500.0 * wetted * (glass - water)
        lost = 10.0 * outside * (glass - ROOM)  # a wall that is a little warm
        return [
            (watt - watt / 1930.0 * (gases - ROOM) - onto) / 5.0,
            (onto - into - lost) / (BEAKER.mass * 830.0),
            into / (100e-6 * 997.0 * 4182.0),
        ]

    expected = solve_ivp(rates, (0.0, 60.0), [ROOM] * 3, rtol=1e-6, max_step=0.5).y[2, -1]
    now = celsius(simulation, f"{BEAKER.name}_temperature")
    assert now - ROOM == pytest.approx(expected - ROOM, rel=0.03)
    assert 0.10 < (now - ROOM) * 417.0 / (60.0 * watt) < 0.35  # a burner heats the room as well


def test_a_flame_is_seen_where_it_burns_and_its_colour_tells_whether_it_gets_air():
    simulation, burner = alone(instrument("bunsen_burner", "it")), instrument("bunsen_burner", "it")
    flame = simulation.scene.model.geom("it_flame")
    simulation.apparatus.show()
    assert flame.rgba[3] == 0.0
    turn(simulation, burner.gas.joint, burner.gas.widest)
    simulation.apparatus.show()
    assert flame.rgba[3] > 0.3
    assert flame.rgba[0] > flame.rgba[2]
    turn(simulation, burner.air.joint, burner.air.widest)
    simulation.apparatus.show()
    assert flame.rgba[2] > flame.rgba[0]


def test_the_cap_puts_an_alcohol_lamp_out():
    simulation, lamp = alone(instrument("alcohol_lamp", "it")), instrument("alcohol_lamp", "it")
    assert celsius(simulation, "it_flame") == 0.0
    turn(simulation, lamp.cap.joint, lamp.cap.widest)
    assert celsius(simulation, "it_flame") == pytest.approx(0.3 * 250.0)
    turn(simulation, lamp.cap.joint, 0.0)
    assert celsius(simulation, "it_flame") == 0.0


def test_an_ultrasonic_bath_is_heated_by_its_heater_and_by_its_sound():
    simulation, bath = alone(instrument("ultrasonic_bath", "it")), instrument("ultrasonic_bath")
    water = 0.158 * 0.278 * 0.080 * 997.0 * 4182.0
    running = simulation.apparatus.processes["it_left"]
    simulation.apparatus.memory(running)[0] = 300.0
    warm_up(simulation, 300.0)
    by_sound = celsius(simulation, "it_water") - ROOM
    assert by_sound == pytest.approx(80.0 * 300.0 / water, rel=0.03)
    turn(simulation, f"it_{bath.heat.joint.removeprefix('ultrasonic_bath_')}", bath.heat.widest)
    warm_up(simulation, 300.0)
    by_both = celsius(simulation, "it_water") - ROOM - by_sound
    assert by_both == pytest.approx(200.0 * 300.0 / water, rel=0.05)


def test_a_current_follows_ohm_heats_the_buffer_and_stops_when_the_lid_is_lifted():
    tank, simulation = (
        instrument("electrophoresis_tank", "it"),
        alone(instrument("electrophoresis_tank", "it")),
    )
    turn(simulation, tank.voltage.joint, 0.5 * tank.voltage.widest)
    assert celsius(simulation, "it_current") == 0.0
    turn(simulation, tank.power.joint, tank.power.widest)
    assert celsius(simulation, "it_current") == pytest.approx(125.0)  # 150 V over 1200 ohm
    warm_up(simulation, 600.0)
    capacity, watt = 1.2 * 0.997 * 4182.0, 150.0**2 / 1200.0
    rise = celsius(simulation, "it_buffer") - ROOM
    assert rise == pytest.approx(watt * 600.0 / capacity, rel=0.05)
    turn(simulation, tank.lid.joint, 0.02)
    assert celsius(simulation, "it_current") == 0.0


def test_a_freezer_is_cold_below_a_refrigerator_and_only_its_own_door_warms_it():
    piece = instrument("refrigerator", "it")
    simulation = alone(piece)
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_freezer_thermometer") == pytest.approx(-18.0, abs=2.0)
    turn(simulation, piece.lower.joint, math.radians(80.0))
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_freezer_thermometer") > -15.0
    assert celsius(simulation, "it_thermometer") == pytest.approx(4.0, abs=2.0)


@pytest.mark.parametrize(
    ("kind", "part"), [("microscope", "light"), ("laminar_flow_bench", "light")]
)
def test_a_lamp_shines_as_its_knob_or_its_switch_says(kind, part):
    piece = instrument(kind, "it")
    simulation = alone(piece)
    lamp, control = simulation.scene.model.geom("it_lamp"), getattr(piece, part)
    simulation.apparatus.show()
    dark = lamp.rgba[:3].sum()
    turn(simulation, control.joint, control.widest)
    simulation.apparatus.show()
    assert celsius(simulation, "it_lamp") == 1.0
    assert lamp.rgba[:3].sum() > 1.5 * dark
