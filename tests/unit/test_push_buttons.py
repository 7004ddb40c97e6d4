"""A push button yields to a finger, clicks, springs back, and works the switch behind it."""

import numpy as np
import pytest

from labutopia_lerobot.labware.instruments.drying_oven import DryingOven
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation

INSTRUMENTS = Heater("heater"), DryingOven("oven", button_color="green")
"""One whose button is pressed down, and one whose button is pressed level."""


@pytest.fixture(params=INSTRUMENTS, ids=lambda instrument: instrument.name)
def instrument(request):
    return request.param


@pytest.fixture
def simulation(instrument) -> Simulation:
    result = Simulation(compile_scene([instrument], PANDA, LABORATORY, VESSEL_VIEW))
    result.reset({instrument: Placement(0.8, 0.0, 0.0)})
    return result


def push(simulation: Simulation, force: float) -> float:
    """Push the button in for half a second; return how far it is in [m].

    The force [N] is what its spring feels: weight helps one that is pressed down.
    """
    (instrument,) = simulation.scene.pieces
    button = simulation.data.body(instrument.button.name)
    weight = simulation.scene.model.body(button.id).mass[0] * simulation.scene.model.opt.gravity
    button.xfrc_applied[:3] = force * button.xmat.reshape(3, 3)[:, 2] - weight
    for _ in range(15):
        simulation.step(simulation.command)
    return float(simulation.data.joint(instrument.button.joint).qpos[0])


def value(simulation: Simulation, name: str) -> float:
    return simulation.apparatus.reading(name).value


def test_a_button_stands_out_when_nobody_pushes_it(simulation):
    assert abs(push(simulation, 0.0)) < 0.0003


def test_two_newtons_do_not_click_it_and_three_and_a_half_do(simulation, instrument):
    button = instrument.button
    assert push(simulation, 2.0) < button.travel
    assert push(simulation, 3.5) > button.travel


def test_it_springs_back_when_let_go(simulation):
    push(simulation, 5.0)
    assert abs(push(simulation, 0.0)) < 0.0003


def test_every_click_toggles_the_switch_and_its_lamp(simulation, instrument):
    lamp = simulation.scene.model.geom(instrument.switch.lamp)
    dark = lamp.rgba.copy()
    for on in (True, False):
        push(simulation, 5.0)
        assert value(simulation, instrument.switch.name) == on
        push(simulation, 0.0)
        assert value(simulation, instrument.switch.name) == on
        simulation.apparatus.show()
        assert np.array_equal(lamp.rgba, dark) is not on


def test_half_a_press_switches_nothing(simulation, instrument):
    push(simulation, 2.3)
    push(simulation, 0.0)
    assert not value(simulation, instrument.switch.name)


def test_it_clicks_out_later_than_in(simulation, instrument):
    name, travel = instrument.button.name, instrument.button.travel
    for force, pressed in ((2.77, False), (2.85, True), (2.77, True), (2.65, False)):
        push(simulation, force)
        assert value(simulation, name) == pressed
    back = push(simulation, 2.77)
    assert travel - instrument.button.differential < back < travel


def test_an_oven_without_a_button_says_so():
    oven = DryingOven("oven")
    assert not oven.buttons
    assert not oven.processes
    with pytest.raises(ValueError, match="oven has no button: give it a `button_color`"):
        _ = oven.button
