"""Balances weigh: what stands on the pan, what is poured, tare, draught, overload, settling."""

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import ware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import Reading

BALANCE = instrument("precision_balance", "balance")
FINE = instrument("analytical_balance", "fine")
BEAKER = ware("beaker_low", "100 ml", "beaker")
BOAT = ware("weighing_boat", "85 x 85 x 24 mm", "boat")


def on_the_pan(balance, load, contents=None) -> Simulation:
    """Return a balance with something on its pan, come to rest."""
    scene = compile_scene([balance, load], PANDA, LABORATORY, DOOR_VIEW, contents)
    simulation = Simulation(scene)
    layout = {balance: Placement(0.3, 0.3, 0.0), load: Placement(0.9, -0.3, 0.0)}
    simulation.reset(layout)
    x, y, z = simulation.data.site(balance.pan.place.name).xpos
    layout[load] = Placement(x, y, 0.0, height=z - LABORATORY.bench.height + 0.0005)
    simulation.reset(layout)
    simulation.fill(np.random.default_rng(0))
    return simulation


def wait(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def read(simulation: Simulation, balance) -> Reading:
    return simulation.apparatus.reading(balance.weighing.name)


def press(simulation: Simulation, balance, force: float = 5.0) -> None:
    slide = simulation.data.joint(balance.tare.joint)
    for push in (force, 0.0):
        slide.qfrc_applied[:] = push
        wait(simulation, 0.5)


@pytest.mark.parametrize("balance", [BALANCE, FINE], ids=lambda b: b.name)
def test_it_reads_the_mass_on_its_pan_to_three_of_its_digits(balance):
    simulation = on_the_pan(balance, BOAT)
    wait(simulation, 3.0)
    reading = read(simulation, balance)
    assert reading.unit == "g"
    assert reading.settled
    assert abs(reading.value - 1e3 * BOAT.mass) < 3 * balance.weighing.resolution


@pytest.mark.slow
def test_poured_water_reads_as_the_account_has_it():
    simulation = on_the_pan(BALANCE, BEAKER, {BEAKER: Filling(ml=50.0)})
    wait(simulation, 5.0)
    account = simulation.account
    assert account is not None
    water = Filling(ml=50.0).substance.density * account.inside[BEAKER.name]
    assert read(simulation, BALANCE).settled
    shown = []
    for _ in range(8):  # the liquid trembles by a digit: what one writes down is the mean
        wait(simulation, 1.0)
        shown.append(read(simulation, BALANCE).shown)
    assert shown == pytest.approx([1e3 * (BEAKER.mass + water)] * 8, abs=0.02)
    assert np.mean(shown) == pytest.approx(1e3 * (BEAKER.mass + water), abs=0.01)


def test_the_tare_button_counts_what_is_there_as_nothing_and_a_lifted_pan_reads_negative():
    simulation = on_the_pan(BALANCE, BOAT)
    press(simulation, BALANCE)
    wait(simulation, 2.0)
    assert abs(read(simulation, BALANCE).value) < 0.03
    kept = simulation.state()
    simulation.data.joint("boat_free").qpos[2] += 0.5
    wait(simulation, 0.2)
    simulation.data.joint("boat_free").qpos[:2] += 0.5
    wait(simulation, 3.0)
    assert read(simulation, BALANCE).value == pytest.approx(-1e3 * BOAT.mass, abs=0.03)
    simulation.restore(kept)
    assert abs(read(simulation, BALANCE).value) < 0.03
    simulation.data.xfrc_applied[simulation.data.body(BALANCE.pan.name).id][2] = 5.0
    wait(simulation, 3.0)
    pull = 5.0 / 9.81 * 1e3
    assert read(simulation, BALANCE).value == pytest.approx(-pull, rel=0.01)


def test_more_than_its_capacity_is_an_error_until_it_is_taken_off():
    simulation = on_the_pan(FINE, BOAT)
    pan = simulation.data.body(FINE.pan.name).id
    simulation.data.xfrc_applied[pan][2] = -3.0  # 306 g; it weighs 220
    wait(simulation, 3.0)
    assert read(simulation, FINE).text == "Err"
    assert not read(simulation, FINE).settled
    simulation.data.xfrc_applied[pan][2] = 0.0
    wait(simulation, 4.0)
    assert read(simulation, FINE).value == pytest.approx(1e3 * BOAT.mass, abs=1e-3)


def test_it_settles_between_one_and_four_seconds_after_a_load():
    simulation = on_the_pan(BALANCE, BOAT)
    wait(simulation, 2.0)
    pan = simulation.data.body(BALANCE.pan.name).id
    simulation.data.xfrc_applied[pan][2] = -1.0
    settled = []
    for _ in range(120):
        wait(simulation, 1 / 30)
        settled.append(read(simulation, BALANCE).settled)
    assert not any(settled[:30])
    assert all(settled[-5:])


def test_an_analytical_balance_does_not_settle_in_a_draught():
    simulation = on_the_pan(FINE, BOAT)
    wait(simulation, 2.0)
    assert read(simulation, FINE).settled
    for share, calm in ((1.0, False), (0.0, True)):
        door = FINE.doors[0]
        simulation.data.joint(door.joint).qpos[:] = share * door.widest
        settled = []
        for _ in range(240):
            wait(simulation, 1 / 30)
            settled.append(read(simulation, FINE).settled)
        assert all(settled[-30:]) if calm else not any(settled[60:])


def test_the_numbers_are_those_of_the_episode_and_repeat():
    values = []
    for seed in (0, 0, 1):
        simulation = on_the_pan(BALANCE, BOAT)
        simulation.apparatus.start(np.random.default_rng(seed))
        wait(simulation, 1.0)
        values.append(read(simulation, BALANCE).value)
    assert values[0] == values[1] != values[2]
