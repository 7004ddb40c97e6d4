"""A vacuum oven at work: its pump, its vent, its leak, its door and its heat, against formulas."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heat_bench import alone, celsius, turn, warm_up
from instrument_bench import Bench
from labutopia_lerobot.labware.instruments.vacuum_oven import VacuumOven

ROOM = 293.15
VOLUME = 0.520 * 0.420 * 0.440
DOORWAY = 0.420 * 0.440
ATM = 101325.0
OF_AIR = 8.314462618 / 0.028965
"""Specific gas constant [J/kg K]."""


def oven(mbar: float | None = None, on: bool = False) -> Bench:
    """Return an oven whose chamber has some pressure, its taps shut."""
    bench = Bench(VacuumOven("it"))
    bench.put(bench.piece.power, float(on))
    if mbar is not None:
        memory = bench.apparatus.memory(bench.piece.air)
        memory[0] = 100.0 * mbar * VOLUME / (8.314462618 * ROOM)
    return bench


def let_pass(bench: Bench, seconds: float) -> None:
    """Let its processes work alone: nothing moves."""
    for _ in range(round(30 * seconds)):
        bench.apparatus.step()


def pressure(bench: Bench) -> float:
    """Return it [mbar]."""
    return bench.read("it_pressure").value


@pytest.mark.parametrize("seconds", [60, 300])
def test_a_pump_evacuates_it_exponentially_towards_its_end_vacuum(seconds):
    bench = oven(on=True)
    assert pressure(bench) == pytest.approx(1013.25)
    bench.put(bench.piece.outlet, 1.0)
    let_pass(bench, seconds)
    expected = 10.0 + 1003.25 * math.exp(-seconds * 0.5e-3 / VOLUME)
    assert pressure(bench) == pytest.approx(expected, rel=0.005)


def test_without_its_switch_or_with_its_tap_shut_nothing_is_evacuated():
    for on, opened in ((False, 1.0), (True, 0.0)):
        bench = oven(on=on)
        bench.put(bench.piece.outlet, opened)
        let_pass(bench, 30.0)
        assert pressure(bench) == pytest.approx(1013.25)


def test_a_tap_that_is_hardly_open_lets_through_what_a_choked_hole_does():
    bench = oven(on=True)
    bench.put(bench.piece.outlet, 0.13)
    let_pass(bench, 60.0)
    hole = 0.6 * (0.03 / 0.9) * math.pi * 0.004**2
    through = hole * math.sqrt(1.4 * OF_AIR * ROOM) * (2.0 / 2.4) ** 3  # White: V at the throat
    assert through < 0.5e-3
    assert pressure(bench) == pytest.approx(1013.25 * math.exp(-60.0 * through / VOLUME), rel=0.005)


def test_an_opened_vent_fills_it_first_at_the_speed_of_sound_and_then_slower():
    bench = oven(20.0)
    bench.put(bench.piece.vent, 1.0)
    hole = 0.6 * math.pi * 0.004**2

    def rate(_: float, y: np.ndarray) -> list[float]:
        ratio = min(1.0, max(float(y[0]) / ATM, (2 / 2.4) ** 3.5))
        factor = 7.0 * (ratio ** (2 / 1.4) - ratio ** (2.4 / 1.4))
        return [hole * ATM * math.sqrt(factor * OF_AIR * ROOM) / VOLUME]

    expected = solve_ivp(rate, (0.0, 14.0), [2000.0], t_eval=(4.0, 14.0), rtol=1e-7, max_step=0.05)
    let_pass(bench, 4.0)
    assert pressure(bench) == pytest.approx(expected.y[0, 0] / 100.0, rel=0.01)
    let_pass(bench, 10.0)
    assert pressure(bench) == pytest.approx(expected.y[0, 1] / 100.0, rel=0.01)
    let_pass(bench, 20.0)
    assert pressure(bench) == pytest.approx(1013.25)


def test_shut_and_evacuated_it_loses_ten_millibar_an_hour():
    bench = oven(10.0)
    let_pass(bench, 360.0)
    assert pressure(bench) == pytest.approx(11.0, rel=1e-3)


def test_the_air_that_is_left_in_it_expands_with_heat_and_what_is_above_the_room_gets_out():
    bench = oven(500.0)
    air = bench.apparatus.memory(bench.apparatus.processes["it_air"])
    air[0] = 1.2 * ROOM
    let_pass(bench, 1.0)
    assert pressure(bench) == pytest.approx(600.0, rel=1e-3)
    full = oven()
    air = full.apparatus.memory(full.apparatus.processes["it_air"])
    air[0] = 1.2 * ROOM
    let_pass(full, 1.0)
    assert pressure(full) == pytest.approx(1013.25)
    air[0] = ROOM  # cooled down behind its seal
    assert pressure(full) == pytest.approx(1013.25 / 1.2)


def pulled(bench: Bench, torque: float) -> float:
    """Pull at the door [N m] for half a second, its lever turned; return its angle [rad]."""
    bench.wait(0.1)
    bench.put(bench.piece.door.handle, 1.0)
    hinge = bench.data.joint(bench.piece.door.joint)
    hinge.qfrc_applied[:] = torque
    bench.wait(0.5)
    return float(hinge.qpos[0])


def test_the_air_of_the_room_presses_the_door_shut_and_nobody_opens_it():
    bench = oven(100.0)
    bench.wait(0.2)
    newton = (ATM - 1e4) * DOORWAY
    assert bench.read("it_door_load").value == pytest.approx(newton, rel=1e-3)
    assert pulled(bench, 40.0) < bench.piece.door.closed_within  # 100 N at the lever
    assert pressure(bench) == pytest.approx(100.0, abs=0.1)


def test_some_millibar_hold_the_door_against_a_hand_by_their_own_force_only():
    """The torque of 2 mbar about the hinge is 9 N m: a little less does not open it, more does."""
    torque = 200.0 * DOORWAY * (0.46 - 0.21)
    assert pulled(oven(1011.25), 0.8 * torque) < math.radians(0.3)
    assert pulled(oven(1011.25), 1.2 * torque + 0.5) > math.radians(2.0)


def test_once_it_is_vented_the_door_opens_and_an_open_oven_is_not_evacuated():
    bench = oven(100.0, on=True)
    bench.put(bench.piece.vent, 1.0)
    let_pass(bench, 40.0)
    assert bench.read("it_door_load").value == pytest.approx(0.0, abs=1.0)
    assert pulled(bench, 5.0) > math.radians(10.0)
    bench.put(bench.piece.vent, 0.0)
    bench.put(bench.piece.outlet, 1.0)
    let_pass(bench, 10.0)
    assert pressure(bench) == pytest.approx(1013.25)


def test_its_needle_shows_its_pressure_and_its_display_its_temperature():
    for mbar in (10.0, 600.0):
        bench = oven(mbar)
        bench.apparatus.show()
        along = bench.data.geom("it_needle").xmat.reshape(3, 3)[:, 2]
        angle = math.degrees(math.atan2(-along[1], along[2]))
        assert angle == pytest.approx(270.0 * (mbar / 1200.0 - 0.5), abs=0.1)
    assert bench.text("it_thermometer") == "20 \u00b0C"


def test_it_heats_as_its_power_and_its_walls_have_it_and_holds_what_it_is_set_to():
    piece = VacuumOven("it", set_to=60.0)
    simulation = alone(piece)
    turn(simulation, piece.power.joint, piece.power.widest)
    warm_up(simulation, 60.0)
    inside = 2 * (0.52 * 0.42 + 0.42 * 0.44 + 0.44 * 0.52)
    liner, air = inside * 2 * 480.0 * 7900.0 * 0.8e-3, VOLUME * 1.19 * 1007.0

    def rate(_: float, y: np.ndarray) -> list[float]:
        passed = 10.0 * inside * (y[0] - y[1])
        return [(1200.0 - passed - 1.5 * (y[0] - 20.0)) / liner, passed / air]

    expected = solve_ivp(rate, (0.0, 60.0), [20.0, 20.0], rtol=1e-8).y[0, -1]
    assert celsius(simulation, "it_liner") - 20.0 == pytest.approx(expected - 20.0, rel=0.01)
    warm_up(simulation, 1200.0)
    assert celsius(simulation, "it_thermometer") == pytest.approx(60.0, abs=4.0)


def test_a_cold_oven_says_that_it_has_no_pressure():
    with pytest.raises(ValueError, match="set_to"):
        _ = VacuumOven("it", set_to=None).air
