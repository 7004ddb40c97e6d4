"""Basins drain: Torricelli's law, the account of what has gone, and what stays where it is."""

import math

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import LiquidAccount

BEAKER = glassware("beaker_low", "1000 ml", "beaker")


def beside(kind: str, ml: float, particles: int) -> Simulation:
    """Return a filled beaker far from something with a basin."""
    piece = instrument(kind, "it")
    held = {BEAKER: Filling(ml)}
    scene = compile_scene([piece, BEAKER], PANDA, LABORATORY, DOOR_VIEW, held, particles)
    simulation = Simulation(scene)
    simulation.reset({piece: Placement(2.0, 0.0, 0.0), BEAKER: Placement(0.6, 0.4, 0.0)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def liquid_of(simulation: Simulation) -> Liquid:
    assert simulation.liquid is not None
    return simulation.liquid


def account_of(simulation: Simulation) -> LiquidAccount:
    assert simulation.account is not None
    return simulation.account


def tip_in(simulation: Simulation, wide: tuple[int, int]) -> None:
    """Put all liquid into the basin, in layers of so many particles."""
    liquid, hole = liquid_of(simulation), simulation.data.site("it_drain").xpos
    across, deep = wide
    n = np.arange(len(liquid.positions))
    rows = n % across - (across - 1) / 2, n // across % deep - (deep - 1) / 2
    places = np.column_stack([*rows, 1.0 + n // (across * deep)])
    liquid.positions[:] = hole + liquid.spacing * places
    liquid.velocities[:] = 0.0
    simulation.account = liquid.take_account()


def wait(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


@pytest.mark.parametrize(
    ("kind", "floor", "hole", "wide"),
    [
        ("laboratory_sink", 0.384 * 0.464, 0.040, (20, 20)),
        ("fume_hood", 0.118 * 0.228, 0.030, (6, 12)),
    ],
)
def test_a_basin_empties_as_torricelli_has_it(kind, floor, hole, wide):
    """The root of what is left falls evenly: textbooks' tank with a hole in its floor."""
    simulation = beside(kind, 800.0, 200)
    tip_in(simulation, wide)
    fall = 0.6 * math.pi / 4 * hole**2 * math.sqrt(2 * 9.81 / floor) / 2  # sqrt(m^3) / s
    for seconds in (1.0, 2.0, 3.0):
        wait(simulation, 1.0)
        left = math.sqrt(800e-6) - fall * seconds
        went = account_of(simulation).inside["it_drain"]
        assert went == pytest.approx(800e-6 - left**2, abs=12e-6)  # three particles
    reading = simulation.apparatus.reading("it_drain")
    assert (reading.value, reading.unit) == (pytest.approx(1e6 * went), "ml")


@pytest.mark.parametrize("kind", ["laboratory_sink", "fume_hood", "eyewash", "safety_shower"])
def test_all_that_is_poured_into_a_basin_goes_down_and_none_of_it_is_lost(kind):
    simulation = beside(kind, 60.0, 60)
    tip_in(simulation, (6, 6))
    wait(simulation, 4.0)
    account = account_of(simulation)
    assert account.inside["it_drain"] == pytest.approx(60e-6)
    assert account.from_in("beaker", "it_drain") == pytest.approx(60e-6)
    assert account.counts.sum() == 60


def test_what_is_in_a_vessel_in_the_basin_stays_in_it():
    sink, held = instrument("laboratory_sink", "it"), {BEAKER: Filling(300.0)}
    scene = compile_scene([sink, BEAKER], PANDA, LABORATORY, DOOR_VIEW, held, 60)
    simulation = Simulation(scene)
    low = -LABORATORY.bench.height
    simulation.reset(
        {
            sink: Placement(1.5, 0.0, 0.0, height=low),
            BEAKER: Placement(1.47, 0.13, 0.0, height=low + 0.6545),
        }
    )
    simulation.fill(np.random.default_rng(0))
    wait(simulation, 2.0)
    account = account_of(simulation)
    assert account.inside["beaker"] == pytest.approx(300e-6)
    assert account.inside["it_drain"] == 0.0


def test_a_half_emptied_basin_is_restored_bit_for_bit():
    simulation = beside("fume_hood", 200.0, 60)
    tip_in(simulation, (6, 10))
    wait(simulation, 0.5)
    saved = simulation.state()
    wait(simulation, 0.5)
    first = simulation.state()
    simulation.restore(saved)
    wait(simulation, 0.5)
    assert (simulation.state() == first).all()
    assert 0.0 < account_of(simulation).inside["it_drain"] < 200e-6
