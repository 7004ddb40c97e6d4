"""Gas under pressure: cylinders empty as ideal gases do, steam presses as Antoine has it."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

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

ROOM = 293.15
ATM = 1.01325
OF_NITROGEN = 8.314462618 / 0.0280134
"""Specific gas constant [J/kg K]."""


def cylinder(bar: float = 0.0, outlet: float = 0.0) -> Bench:
    """Return an open cylinder whose regulator is set."""
    bench = Bench("gas_cylinder")
    bench.put(bench.piece.valve, 1.0)
    bench.put(bench.piece.pressure, bar / 10.0)
    bench.wait(0.2)
    bench.put(bench.piece.outlet, outlet)
    return bench


def let_pass(bench: Bench, seconds: float) -> None:
    """Let its processes work alone: nothing moves."""
    for _ in range(round(30 * seconds)):
        bench.apparatus.step()


def contents(bench: Bench) -> float:
    return bench.read("gas_cylinder_contents").value


def test_the_first_gauge_reads_the_cylinder_once_its_valve_is_open():
    bench = Bench("gas_cylinder")
    let_pass(bench, 1.0)
    assert contents(bench) == pytest.approx(0.0, abs=1e-9)
    bench.put(bench.piece.valve, 1.0)
    let_pass(bench, 0.1)
    assert contents(bench) == pytest.approx(200.0, abs=0.1)
    assert bench.read("gas_cylinder_outlet_pressure").value == pytest.approx(0.0, abs=1e-9)


def test_the_outlet_flows_as_a_choked_hole_and_stops_with_its_tap():
    bench = cylinder(4.0, outlet=1.0)
    before = (4.0 + ATM) * 1e5
    # White, section 9.4: what goes through a throat at the speed of sound.
    mass = before * math.pi * 0.0005**2 * math.sqrt(1.4 / (OF_NITROGEN * ROOM)) * (2 / 2.4) ** 3
    litres = 60e3 * 0.6 * mass * OF_NITROGEN * ROOM / (ATM * 1e5)
    assert bench.read("gas_cylinder_flow").value == pytest.approx(litres, rel=1e-3)
    bench.put(bench.piece.pressure, 0.05)  # 0.5 bar: slower than sound
    let_pass(bench, 10.0)
    ratio = ATM / (0.5 + ATM)
    factor = 7.0 * (ratio ** (2 / 1.4) - ratio ** (2.4 / 1.4))
    speed = math.sqrt(factor * OF_NITROGEN * ROOM) * 0.6 * math.pi * 0.0005**2
    slow = 60e3 * speed * (0.5 + ATM) / ATM
    assert bench.read("gas_cylinder_flow").value == pytest.approx(slow, rel=1e-3)
    bench.put(bench.piece.outlet, 0.0)
    assert bench.read("gas_cylinder_flow").value == 0.0


def test_a_cylinder_empties_by_what_has_left_it():
    bench = cylinder(10.0, outlet=1.0)
    flow, before = bench.read("gas_cylinder_flow").value, contents(bench)
    let_pass(bench, 120.0)
    assert bench.read("gas_cylinder_flow").value == pytest.approx(flow, rel=1e-6)
    fallen = ATM * 2.0 * flow / 50.0  # p V = n R T, of 50 l
    assert before - contents(bench) == pytest.approx(fallen, rel=0.01)
    assert bench.read("gas_cylinder_outlet_pressure").value == pytest.approx(10.0)


def test_a_shut_valve_leaves_the_regulator_what_it_holds_and_no_more():
    bench = cylinder(5.0)
    bench.put(bench.piece.valve, 0.0)
    let_pass(bench, 5.0)
    assert contents(bench) == pytest.approx(200.0, abs=0.1)
    held = (200.0 * 20e-6 + 5.0 * 50e-6) / ATM * 1e3  # l at the pressure of the room
    bench.put(bench.piece.outlet, 1.0)
    given = 0.0
    for _ in range(30 * 60):
        given += bench.read("gas_cylinder_flow").value / 60.0 / 30.0
        bench.apparatus.step()
    assert given == pytest.approx(held, rel=0.01)
    assert contents(bench) == pytest.approx(0.0, abs=0.01)
    bench.put(bench.piece.valve, 1.0)
    let_pass(bench, 0.1)
    assert contents(bench) > 199.0


def test_a_regulator_that_is_turned_back_keeps_its_pressure_until_its_tap_is_opened():
    bench = cylinder(8.0)
    bench.put(bench.piece.pressure, 0.2)
    let_pass(bench, 5.0)
    assert bench.read("gas_cylinder_outlet_pressure").value == pytest.approx(8.0)
    bench.put(bench.piece.outlet, 1.0)
    let_pass(bench, 5.0)
    assert bench.read("gas_cylinder_outlet_pressure").value == pytest.approx(2.0, abs=0.01)


def needle(bench: Bench, name: str) -> float:
    """Return where the needle of a gauge points, clockwise from the top [rad]."""
    bench.apparatus.show()
    geom = bench.model.geom(name).id
    along = bench.data.geom_xmat[geom].reshape(3, 3)[:, 2]
    return math.atan2(-along[1], along[2])


@pytest.mark.parametrize("bar", [0.0, 2.0, 8.0])
def test_needles_point_where_the_marks_of_their_gauges_are(bar):
    bench = cylinder(bar)
    low, high = (f"gas_cylinder_{gauge}_gauge" for gauge in ("low", "high"))
    assert needle(bench, low) == pytest.approx(math.radians(270.0 * (bar / 16.0 - 0.5)), abs=0.01)
    filled = 270.0 * (contents(bench) / 300.0 - 0.5)
    assert needle(bench, high) == pytest.approx(math.radians(filled), abs=0.01)
    face = np.array(bench.piece.gauges[1].center)
    middle = bench.data.geom_xpos[bench.model.geom(low).id]
    assert np.linalg.norm(middle - face) < 0.026


def hot(degrees: float, valve: float = 0.0) -> Simulation:
    """Return an autoclave with steam of some temperature, and no cycle that heats it."""
    piece = instrument("autoclave", "it")
    simulation = alone(piece)
    apparatus = simulation.apparatus
    apparatus.memory(apparatus.processes["it_steam"])[0] = degrees + 273.15
    turn(simulation, piece.valve.joint, valve * piece.valve.widest)
    return simulation


@pytest.mark.parametrize(
    ("degrees", "bar"), [(105.0, 1.209), (121.0, 2.05), (134.0, 3.04)]
)  # steam tables (IAPWS)
def test_steam_in_an_autoclave_presses_as_steam_tables_have_it(degrees, bar):
    assert celsius(hot(degrees), "it_pressure") == pytest.approx(bar, rel=0.01)


def test_below_its_boiling_point_there_is_the_pressure_of_the_room():
    assert celsius(hot(80.0), "it_pressure") == pytest.approx(ATM)


def test_an_opened_valve_lets_steam_off_which_takes_its_heat_along():
    simulation = hot(121.0, valve=1.0)
    hole, capacity = 0.6 * math.pi * 0.0025**2, 3.0 * 0.997 * 4182.0 + 12.0 * 480.0
    constant, kappa = 8.314462618 / 0.018015, 1.33

    def rate(_: float, y: np.ndarray) -> list[float]:
        pressure = 133.322 * 10 ** (8.14019 - 1810.94 / (244.485 + y[0]))
        ratio = max(101325.0 / pressure, (2 / (kappa + 1)) ** (kappa / (kappa - 1)))
        if ratio >= 1.0:
            return [0.0]
        factor = 2 * kappa / (kappa - 1) * (ratio ** (2 / kappa) - ratio ** (1 + 1 / kappa))
        mass = hole * pressure * math.sqrt(factor / (constant * (y[0] + 273.15)))
        return [-(2.257e6 * mass + 2.0 * (y[0] - 20.0)) / capacity]

    seconds = 40.0
    expected = solve_ivp(rate, (0.0, seconds), [121.0], rtol=1e-7).y[0, -1]
    warm_up(simulation, seconds)
    cooled = 121.0 - celsius(simulation, "it_steam")
    assert 8.0 < cooled == pytest.approx(121.0 - expected, rel=0.02)


def lifted(bench: Bench) -> float:
    """Pull at the lid as 40 N at its edge do, and return how far it has opened [rad]."""
    lid = bench.data.joint(bench.piece.lid.joint)
    lid.qfrc_applied[:] = 16.0
    bench.wait(0.5)
    lid.qfrc_applied[:] = 0.0
    return float(lid.qpos[0])


def test_the_lid_of_an_autoclave_is_locked_under_pressure_and_only_then():
    bench = Bench("autoclave")
    steam = bench.apparatus.memory(bench.apparatus.processes["autoclave_steam"])
    steam[0] = 121.0 + 273.15
    bench.wait(0.1)
    assert bench.read("autoclave_lock").value == 1.0
    assert lifted(bench) < math.radians(1.0)
    steam[0] = 101.0 + 273.15  # 1.05 bar
    bench.wait(0.1)
    assert bench.read("autoclave_lock").value == 0.0
    assert lifted(bench) > math.radians(10.0)
    assert bench.read("autoclave_pressure").value == pytest.approx(ATM)


def test_the_needle_of_an_autoclave_shows_its_pressure():
    bench = Bench("autoclave")
    steam = bench.apparatus.memory(bench.apparatus.processes["autoclave_steam"])
    cold = needle(bench, "autoclave_gauge")
    assert cold == pytest.approx(math.radians(270.0 * (ATM / 4.0 - 0.5)), abs=0.01)
    steam[0] = 121.0 + 273.15
    assert needle(bench, "autoclave_gauge") == pytest.approx(
        math.radians(270.0 * (2.05 / 4.0 - 0.5)), abs=0.01
    )


def test_lamps_heat_a_dish_under_the_hood_and_stop_when_it_is_opened():
    piece, dish = instrument("moisture_analyser", "it"), glassware("evaporating_dish", "63 x 25 mm")
    simulation = Simulation(compile_scene([piece, dish], PANDA, LABORATORY, DOOR_VIEW))
    where = {piece: Placement(0.6, 0.0, 0.0), dish: Placement(0.64, 0.0, 0.0, height=0.085)}
    simulation.reset(where)
    assert celsius(simulation, "it_thermometer") == pytest.approx(20.0)
    turn(simulation, piece.heat.joint, 105.0 / 200.0 * piece.heat.widest)
    warm_up(simulation, 120.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(105.0, abs=5.0)
    assert celsius(simulation, f"{dish.name}_temperature") > 25.0
    turn(simulation, piece.hood.joint, piece.hood.widest)
    before = celsius(simulation, "it_thermometer")
    warm_up(simulation, 20.0)
    assert celsius(simulation, "it_thermometer") < before - 10.0
    apparatus = simulation.apparatus
    assert apparatus.processes["it_thermometer"].text(apparatus) == "HOOD OPEN"


def test_the_liner_under_the_lamps_warms_as_their_power_has_it():
    piece = instrument("moisture_analyser", "it")
    simulation = alone(piece)
    turn(simulation, piece.heat.joint, piece.heat.widest)
    warm_up(simulation, 5.0)
    inside = 2 * (0.11 * 0.11 + 2 * 0.11 * 0.05)
    liner = inside * 2 * 480.0 * 7900.0 * 0.8e-3
    through = 10.0 * inside  # to the air, which hardly holds any
    held = liner + 0.11 * 0.11 * 0.05 * 1.19 * 1007.0

    def rate(_: float, y: np.ndarray) -> list[float]:
        return [(400.0 - (y[0] - 20.0)) / held]

    expected = solve_ivp(rate, (0.0, 5.0), [20.0], rtol=1e-8).y[0, -1]
    assert through > 0.0
    assert celsius(simulation, "it_liner") - 20.0 == pytest.approx(expected - 20.0, rel=0.03)


def test_silica_gel_dries_a_shut_cabinet_and_an_open_door_undoes_it():
    piece = instrument("desiccator_cabinet", "it")
    simulation = alone(piece)
    warm_up(simulation, 600.0)
    dried = 20.0 + 10.0 * math.exp(-600.0 / 1800.0)
    assert celsius(simulation, "it_humidity") == pytest.approx(dried, rel=1e-3)
    turn(simulation, piece.door.joint, math.radians(90.0))
    warm_up(simulation, 10.0)
    assert celsius(simulation, "it_humidity") == pytest.approx(
        50.0 - (50.0 - dried) * math.exp(-1.0), rel=0.02
    )
    turn(simulation, piece.door.joint, 0.0)
    turn(simulation, piece.gel.joint, piece.gel.widest)
    wet = celsius(simulation, "it_humidity")
    warm_up(simulation, 60.0)
    assert celsius(simulation, "it_humidity") == wet  # nothing dries without its gel
