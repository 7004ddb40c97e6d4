"""A push button yields to a finger, clicks, springs back, and works the switch behind it."""

import numpy as np
import pytest

from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation

HEATER = Heater("heater")


@pytest.fixture
def simulation() -> Simulation:
    result = Simulation(compile_scene([HEATER], PANDA, LABORATORY, VESSEL_VIEW))
    result.reset({HEATER: Placement(0.3, 0.0, 0.0)})
    return result


def push(simulation: Simulation, force: float) -> float:
    """Push the button down with a force [N] for half a second; return how far it is in [m]."""
    simulation.data.body(HEATER.button.name).xfrc_applied[2] = -force
    for _ in range(15):
        simulation.step(simulation.command)
    return float(simulation.data.joint(HEATER.button.joint).qpos[0])


def test_a_button_stands_out_when_nobody_pushes_it(simulation):
    assert abs(push(simulation, 0.0)) < 0.0003


def test_two_newtons_do_not_click_it_and_three_and_a_half_do(simulation):
    assert push(simulation, 2.0) < HEATER.button.travel
    assert push(simulation, 3.5) > HEATER.button.travel


def test_it_springs_back_when_let_go(simulation):
    push(simulation, 5.0)
    assert abs(push(simulation, 0.0)) < 0.0003


def test_every_click_toggles_the_heater_and_its_lamp(simulation):
    lamp = simulation.scene.model.geom(HEATER.switch.lamp)
    dark = lamp.rgba.copy()
    for on in (True, False):
        push(simulation, 5.0)
        assert simulation.switched_on(HEATER.switch.name) is on
        push(simulation, 0.0)
        assert simulation.switched_on(HEATER.switch.name) is on
        assert np.array_equal(lamp.rgba, dark) is not on


def test_half_a_press_switches_nothing(simulation):
    push(simulation, 2.3)
    push(simulation, 0.0)
    assert not simulation.switched_on(HEATER.switch.name)


def test_it_clicks_out_later_than_in(simulation):
    name, travel = HEATER.button.name, HEATER.button.travel
    for force, pressed in ((2.62, False), (2.7, True), (2.62, True), (2.5, False)):
        push(simulation, force)
        assert simulation.pressed(name) is pressed
    back = push(simulation, 2.62)
    assert travel - HEATER.button.differential < back < travel
