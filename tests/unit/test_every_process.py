"""Every process that remembers something has a test against a formula or a data sheet: a census."""

import ast
import importlib
import pkgutil
from functools import cache
from pathlib import Path

import pytest

import labutopia_lerobot.labware
import labutopia_lerobot.processes
from labutopia_lerobot.labware.instrument_catalogue import catalogue, instrument
from labutopia_lerobot.processes import Process

HERE = Path(__file__).parent

CHECKED_BY = {
    "Balanced": "test_guards_and_timers::test_what_is_uneven_trips_it_and_what_is_even_does_not",
    "CompressedGas": "test_gas_and_pressure::test_a_cylinder_empties_by_what_has_left_it",
    "ConductivityCell": "test_meters_in_solutions::"
    "test_the_conductivity_meter_reads_a_standard_and_dashes_in_air",
    "Conveying": "test_transfer_pump::test_it_moves_two_millilitres_with_every_turn_of_its_head",
    "Countdown": "test_guards_and_timers::test_a_knob_with_a_timer_counts_what_it_is_set_to",
    "Dosing": "test_drives::test_a_syringe_pump_gives_what_its_rate_says_until_it_is_stopped",
    "Drain": "test_drains::test_a_basin_empties_as_torricelli_has_it",
    "Draining": "test_stopcocks::test_it_empties_in_the_time_that_head_and_bore_say",
    "Drawing": "test_bulb_pipettes::"
    "test_what_it_takes_in_is_what_the_bulb_displaced_less_what_the_column_stretches",
    "Drive": "test_drives::test_it_reaches_the_set_speed_along_its_ramp_reads_it_and_stops",
    "Drying": "test_gas_and_pressure::"
    "test_silica_gel_dries_a_shut_cabinet_and_an_open_door_undoes_it",
    "EvacuatedChamber": "test_evacuation::"
    "test_a_pump_evacuates_it_exponentially_towards_its_end_vacuum",
    "Fan": "test_drives::test_a_fan_moves_the_air_as_a_lag_of_three_seconds",
    "HeatExchange": "test_heat::test_what_is_supplied_is_in_the_things_or_was_lost",
    "IndicatorPaper": "test_meters_in_solutions::"
    "test_a_strip_of_ph_paper_keeps_the_colour_of_the_last_drop_on_it",
    "Latched": "test_drives::test_a_syringe_pump_gives_what_its_rate_says_until_it_is_stopped",
    "LiquidNitrogen": "test_liquid_nitrogen::"
    "test_open_it_boils_off_by_what_the_room_radiates_down_its_neck_as_well",
    "Lock": "test_guards_and_timers::"
    "test_a_shut_centrifuge_opens_only_after_its_latch_is_pressed_at_a_standstill",
    "MagneticStirring": "test_drives::test_a_bar_on_a_stirrer_turns_the_water_around_it",
    "PhElectrode": "test_electrodes::"
    "test_after_three_time_constants_it_shows_95_percent_of_a_change",
    "Photometer": "test_meters_in_solutions::test_absorbance_is_proportional_to_concentration",
    "Prisms": "test_meters_in_solutions::test_a_drop_is_read_once_the_prisms_are_shut_on_it",
    "Probe": "test_heat::test_a_probe_follows_what_it_is_in_as_a_lag_of_two_seconds",
    "PushButton": "test_push_buttons::test_two_newtons_do_not_click_it_and_three_and_a_half_do",
    "Reactions": "test_layers::test_reactions_go_on_almost_four_times_in_a_second",
    "Rocking": "test_drives::test_a_rocking_platform_goes_to_and_fro_as_often_as_it_says",
    "SolutionSensor": "test_electrodes::"
    "test_after_three_time_constants_it_shows_95_percent_of_a_change",
    "Squeezing": "test_soft_bodies::test_each_further_stroke_gives_more_and_nothing_returns",
    "Stopwatch": "test_guards_and_timers::test_a_stopwatch_starts_stops_and_is_set_to_zero",
    "Supply": "test_water_of_taps::"
    "test_a_tap_lets_through_what_its_opening_and_the_rest_of_its_line_do",
    "Switch": "test_push_buttons::test_every_click_toggles_the_switch_and_its_lamp",
    "TemperatureSensor": "test_meters_in_solutions::"
    "test_the_thermometer_reads_the_layer_that_its_tip_is_in_and_in_air_the_room",
    "ThermalMass": "test_heat_of_instruments::"
    "test_a_muffle_furnace_heats_as_4500_watts_and_its_insulation_have_it",
    "Thermostat": "test_heat_of_instruments::"
    "test_a_melting_point_block_heats_with_all_its_power_and_holds_what_its_knob_sets",
    "Vacuum": "test_drives::test_a_vacuum_falls_exponentially_to_what_is_set_and_air_comes_back",
    "Weighing": "test_weighing::test_it_reads_the_mass_on_its_pan_to_three_of_its_digits",
}
"""Process that remembers something -> the test of what it does; a new one is added here."""

UNSLOTTED = Process.slots


def remembering() -> set[str]:
    """Return the names of all process classes of the package that have slots."""
    for package in (labutopia_lerobot.labware, labutopia_lerobot.processes):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            importlib.import_module(module.name)
    kinds, left = set(), [Process]
    while left:
        left += (below := left.pop().__subclasses__())
        kinds |= set(below)
    pieces = ("labutopia_lerobot.labware.", "labutopia_lerobot.processes.")
    return {
        kind.__name__
        for kind in kinds
        if kind.__module__.startswith(pieces) and kind.slots is not UNSLOTTED
    }


@cache
def quick_tests(module: str) -> set[str]:
    """Return the tests of a module that pytest collects and `make test` does not leave out."""
    functions = [
        node
        for node in ast.parse((HERE / f"{module}.py").read_text()).body
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_")
    ]
    marks = ("pytest.mark.slow", "pytest.mark.skip", "pytest.mark.xfail")
    return {
        node.name
        for node in functions
        if not any(ast.unparse(mark).startswith(marks) for mark in node.decorator_list)
    }


def test_every_process_that_remembers_something_has_a_test_of_what_it_does():
    assert remembering() == set(CHECKED_BY)


@pytest.mark.parametrize("kind", sorted(CHECKED_BY))
def test_that_test_exists_and_is_run(kind):
    module, _, name = CHECKED_BY[kind].partition("::")
    assert name in quick_tests(module)


@pytest.mark.parametrize("kind", catalogue())
def test_all_that_an_instrument_remembers_is_checked(kind):
    remembered = {type(process).__name__ for process in instrument(kind).processes if process.slots}
    assert remembered <= set(CHECKED_BY)
