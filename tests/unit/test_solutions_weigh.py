"""What is dissolved weighs, and gas that has left weighs no more."""

import numpy as np
import pytest

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.poured_together import density
from labutopia_lerobot.labware.glass.catalogue import glassware, ware
from labutopia_lerobot.labware.instrument_catalogue import instrument
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.substances.substance import WATER
from solution_bench import COPPER, TAKER, bench, bring, liquid_of, world

BALANCE = instrument("precision_balance", "balance")
BEAKER = ware("beaker_low", "250 ml", "beaker")
FLASK = glassware("beaker", "250 ml", "flask")

HCL, SODIUM_CARBONATE, SODIUM_CHLORIDE, CARBON_DIOXIDE = 36.46, 105.99, 58.44, 44.01
"""Molar masses [g/mol] (CRC Handbook, "Physical constants of inorganic compounds")."""


def weighed(held: Filling, beside: Filling) -> Simulation:
    """Return a balance with a filled beaker on its pan, and a flask beside it.

    50 and 12.5 ml are 160 and 40 of its particles.
    """
    contents = {BEAKER: held, FLASK: beside}
    scene = compile_scene([BALANCE, BEAKER, FLASK], PANDA, LABORATORY, DOOR_VIEW, contents, 200)
    simulation = Simulation(scene)
    far = {FLASK: Placement(0.5, -0.35, 0.0), BALANCE: Placement(0.3, 0.3, 0.0)}
    simulation.reset(far | {BEAKER: Placement(0.9, -0.3, 0.0)})
    x, y, z = simulation.data.site(BALANCE.pan.place.name).xpos
    height = z - LABORATORY.bench.height + 0.0005
    simulation.reset(far | {BEAKER: Placement(x, y, 0.0, height=height)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def read(simulation: Simulation) -> float:
    """Return what the balance shows in the mean of some seconds, when it has settled [g]."""
    shown = []
    for step in range(150):
        simulation.step(simulation.command)
        if step >= 60:
            shown.append(simulation.apparatus.reading(BALANCE.weighing.name).value)
    return float(np.mean(shown))


def test_a_balance_reads_water_and_all_that_is_dissolved_in_it() -> None:
    salt = Filling(50.0, dissolved=(Solute("sodium chloride", 1.0),))
    empty = 1e3 * BEAKER.mass
    wanted = empty + 50.0 * 1e-3 * WATER.density + 0.05 * SODIUM_CHLORIDE
    assert read(weighed(salt, Filling(12.5))) == pytest.approx(wanted, abs=0.03)


def test_acid_on_carbonate_loses_the_mass_of_the_gas_that_has_left() -> None:
    soda = Filling(50.0, dissolved=(Solute("sodium carbonate", 0.4),))
    acid = Filling(12.5, dissolved=(Solute("hydrochloric acid", 4.8),))
    simulation = weighed(soda, acid)
    before = read(simulation)
    assert before == pytest.approx(
        1e3 * BEAKER.mass + 0.05 * WATER.density + 0.02 * SODIUM_CARBONATE, abs=0.03
    )
    bring(simulation, FLASK.name, BEAKER.name, 12.5)
    after = read(simulation)
    solution = world(simulation).solution(BEAKER)
    assert solution is not None
    gas = solution.gas["CO2(g)"]
    assert 0.016 < gas < 0.02  # some of it stays dissolved
    added = 0.0125 * WATER.density + 0.06 * HCL
    assert after - before == pytest.approx(added - gas * CARBON_DIOXIDE, abs=0.03)
    assert gas * CARBON_DIOXIDE > 0.7  # far more than what trembles


def test_the_weight_on_a_vessel_is_that_of_its_particles() -> None:
    simulation = bench(COPPER, Filling(40.0, crystals=(Crystals("sodium chloride", 8.0, 0.5),)))
    liquid, handling = liquid_of(simulation), simulation.apparatus.liquid
    assert handling is not None
    _, masses = handling.masses()
    inside = liquid.accounted == liquid.names.index(TAKER.name)
    wanted = 40e-6 * WATER.density + 8e-3
    assert masses[inside].sum() == pytest.approx(wanted, rel=1e-4)
    body, pushed = simulation.data.body(TAKER.name).id, []
    for _ in range(60):
        simulation.step(simulation.command)
        pushed.append(-simulation.data.xfrc_applied[body, 2] / 9.81)
    assert np.mean(pushed) == pytest.approx(wanted, rel=0.02)


def test_the_stock_of_a_solution_is_as_dense_as_it_weighs() -> None:
    simulation = bench(COPPER, Filling(40.0))
    handling = simulation.apparatus.liquid
    assert handling is not None
    for name, molar in (("giver", 0.1), ("taker", 0.0)):
        stock = handling.stock(name, simulation.data.body(name).xpos.copy())
        assert stock is not None
        assert stock.density == pytest.approx(WATER.density + molar * 159.61, abs=0.2)


def test_the_density_of_a_solution_is_that_of_its_water_and_its_salt() -> None:
    """997.05 kg/m^3 of water at 25 C (CRC Handbook), and 58.44 g of salt in a litre of it."""
    assert density(()) == pytest.approx(997.05, abs=0.05)
    assert density((Solute("sodium chloride", 1.0),)) == pytest.approx(1055.49, abs=0.05)
