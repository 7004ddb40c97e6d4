"""Solutions: what is poured together mixes, reacts, and nothing of it is lost."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from labutopia_lerobot.chemistry.inventory import Inventory, Solute
from labutopia_lerobot.chemistry.portions import WATER_PER_VOLUME
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.liquids.looks import looks
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.settling import let_sink, sinking_speeds
from labutopia_lerobot.liquids.solutions import Solutions
from labutopia_lerobot.predicates import colour_turned, concentration, dissolved, ph_between
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from solution_bench import (
    ACID,
    BARIUM,
    BASE,
    COPPER,
    GIVER,
    SODA,
    TAKER,
    atoms,
    bench,
    bring,
    energy,
    liquid_of,
    mix,
    pour,
    swirl,
    world,
)


def everything(simulation: Simulation) -> dict[str, float]:
    liquid = liquid_of(simulation)
    assert liquid.solutions is not None
    total = liquid.what.contents.sum(axis=0) + liquid.solutions.given_off.sum(axis=0)
    return atoms(liquid.solutions.inventory.species, total)


@pytest.mark.parametrize(("giver", "taker"), [(ACID, BASE), (BARIUM, COPPER), (ACID, SODA)])
def test_a_pour_keeps_atoms_charge_mass_and_energy(giver: Filling, taker: Filling) -> None:
    simulation = bench(giver, taker)
    before, ions = everything(simulation), 0.1 * 50e-3
    pour(simulation, 0.9, 60)
    # Glass and room exchange heat with what has been poured; reactions alone keep all of it.
    warm = energy(simulation)
    mix(simulation, 60.0)
    after = everything(simulation)
    assert energy(simulation) == pytest.approx(warm, abs=1e-9 * abs(warm))
    for name, amount in before.items():
        assert after[name] == pytest.approx(amount, rel=1e-9, abs=1e-9 * ions)


_compounds = st.sampled_from(
    [
        "hydrochloric acid",
        "sodium hydroxide",
        "acetic acid",
        "ammonia",
        "copper(II) sulfate",
        "barium chloride",
        "sodium carbonate",
        "silver nitrate",
        "potassium permanganate",
        "iron(II) sulfate",
        "bromothymol blue",
    ]
)
_solutions = st.lists(
    st.builds(Solute, _compounds, st.sampled_from([1e-4, 5e-3, 2e-2])),
    max_size=2,
    unique_by=lambda s: s.of,
)


@settings(
    max_examples=25, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
@given(st.lists(_solutions, min_size=2, max_size=2), st.integers(0, 1000))
def test_any_vessel_keeps_atoms_charge_and_energy(held: list[list[Solute]], seed: int) -> None:
    fillings = [Filling(50.0, dissolved=tuple(solutes)) for solutes in held]
    solutions, rng = Solutions(fillings, ("vessel",), 1e-7), np.random.default_rng(seed)
    contents = solutions.contents([fillings[i] for i in rng.integers(0, 2, 40)])
    what = Portion(
        np.zeros(40, int), np.zeros(40, int), np.full(40, 298.0), np.ones((40, 1)), contents
    )
    weights, inside = np.full(40, 0.417), rng.integers(-1, 1, 40)
    heights = rng.uniform(0.0, 0.03, 40)

    def totals() -> tuple[dict[str, float], float]:
        amounts = contents.sum(axis=0) + solutions.given_off.sum(axis=0)
        heat = weights @ what.temperatures + amounts @ solutions.inventory.enthalpies
        return atoms(solutions.inventory.species, amounts), float(heat)

    before, warm = totals()
    for _ in range(40):
        solutions.react(what, heights, heights, weights, inside, np.array([0.05]), 1.0)
    after, later = totals()
    assert later == pytest.approx(warm, rel=1e-9)
    assert (contents >= 0.0).all()
    for name, amount in before.items():
        assert after[name] == pytest.approx(amount, rel=1e-9, abs=1e-9 * 40 * 1e-7)


def test_what_has_been_poured_in_is_seen_until_it_has_mixed() -> None:
    simulation = bench(BARIUM, COPPER)
    pour(simulation, 0.5, 25)
    young = world(simulation).solution(TAKER)
    swirl(simulation)
    old = world(simulation).solution(TAKER)
    assert young is not None
    assert old is not None
    assert young.mixed < 0.9 < old.mixed == pytest.approx(1.0, abs=1e-9)


def test_what_stirs_mixes_faster() -> None:
    fillings = [ACID, BASE]
    for speed, wanted in ((0.0, -np.expm1(-0.2)), (0.05, -np.expm1(-1.2))):
        solutions = Solutions(fillings, ("vessel",), 1e-7)
        contents = solutions.contents([ACID, BASE])
        what = Portion(*(np.zeros(2, int),) * 2, np.full(2, 293.15), np.ones((2, 1)), contents)
        sodium = solutions.inventory.species.index("Na^+(aq)")
        at_first = contents[1, sodium]
        solutions.react(
            what, np.zeros(2), np.zeros(2), np.ones(2), np.zeros(2, int), np.array([speed]), 1.0
        )
        assert contents[0, sodium] == pytest.approx(0.5 * wanted * at_first)


def test_an_acid_and_as_much_base_are_neutral_and_warm() -> None:
    simulation = bench(ACID, BASE, particles=400)
    assert ph_between(TAKER, low=13.0, high=13.3).holds(world(simulation))
    pour(simulation, 1.0, 80)
    mix(simulation, 120.0)
    solution = world(simulation).solution(TAKER)
    assert solution is not None
    assert solution.ph == pytest.approx(7.0, abs=0.2)
    # 55.8 kJ/mol into 4.17 kJ/(l K); what went into the glass meanwhile is missing.
    assert 0.4 < solution.temperature - 293.15 < 0.68


def test_barium_sulfate_falls_out_of_a_solution_that_stays_blue() -> None:
    simulation = bench(BARIUM, COPPER)
    view = world(simulation)
    assert colour_turned(TAKER, to="blue").holds(view)
    pour(simulation, 1.0, 45)
    mix(simulation, 60.0)
    solution = view.solution(TAKER)
    assert solution is not None
    assert solution.solids == {"BaSO4(s)": pytest.approx(4e-3, rel=1e-3)}
    assert solution.concentrations["Cu^2+(aq)"] == pytest.approx(60.0, rel=0.01)
    assert concentration(TAKER, species="Cu^2+(aq)", low=0.059, high=0.061).holds(view)
    assert colour_turned(TAKER, to="blue").holds(view)
    assert not dissolved(TAKER).holds(view)
    assert dissolved(GIVER).holds(view) is False  # it is empty


def test_grains_sink_as_stokes_has_it() -> None:
    """Barium sulfate: 4500 kg/m^3 in water of 0.89 mPa s, 10 micrometres: 0.21 mm/s."""
    speeds = sinking_speeds(("BaSO4(s)", "Cl^-(aq)", "H2O(l)"))
    assert speeds == pytest.approx([0.21e-3, 0.0, 0.0], abs=0.01e-3)


def test_a_precipitate_settles_and_is_stirred_up_and_none_of_it_is_lost() -> None:
    heights = np.repeat(np.arange(6.0), 5) * 0.005 + 0.001
    cloud = np.full((30, 1), 2e-6)
    for _ in range(300):
        let_sink(cloud, heights, np.array([2e-4]), 0.005, 0.005, 1.0)
    assert cloud.sum() == pytest.approx(30 * 2e-6, rel=1e-12)
    assert cloud[:5].sum() > 0.98 * cloud.sum()
    assert (cloud[25:] < 1e-9).all()
    for _ in range(30):
        let_sink(cloud, heights, np.array([2e-4]), 0.005, 0.2, 1.0)
    assert cloud.sum() == pytest.approx(30 * 2e-6, rel=1e-12)
    assert cloud.max() < 1.3 * cloud.min()


def test_what_has_settled_leaves_a_clear_blue_solution_above() -> None:
    simulation = bench(BARIUM, COPPER)
    pour(simulation, 1.0, 45)
    handling, liquid = simulation.apparatus.liquid, liquid_of(simulation)
    assert handling is not None
    assert liquid.solutions is not None
    liquid.stirring[:] = 0.0
    for _ in range(300):
        handling.react(1.0)
    grains = liquid.what.contents[:, liquid.solutions.inventory.species.index("BaSO4(s)")]
    here = liquid.accounted == liquid.names.index(TAKER.name)
    heights = liquid.positions[here, 2] - liquid.positions[here, 2].min()
    assert grains[here][heights < 0.006].sum() > 0.9 * grains.sum()
    red, _, blue, opacity = looks(liquid, np.ones((1, 4)))[here][heights.argmax()]
    assert blue > red + 0.2
    assert opacity < 0.9 < looks(liquid, np.ones((1, 4)))[here][heights.argmin(), 3]


def test_gas_leaves_and_is_counted_where_it_left() -> None:
    strong = Filling(50.0, dissolved=(Solute("hydrochloric acid", 0.4),))
    simulation = bench(strong, SODA)
    pour(simulation, 1.0, 50)
    mix(simulation, 120.0)
    solution = world(simulation).solution(TAKER)
    assert solution is not None
    assert 0.9 * 5e-3 - 1e-3 < solution.gas["CO2(g)"] < 5e-3  # 0.1 bar of it stay dissolved
    assert "CO2(g)" not in solution.solids


@pytest.mark.parametrize("giver", [BARIUM, ACID])
def test_an_episode_goes_on_bit_for_bit_from_a_state(giver: Filling) -> None:
    simulation = bench(giver, SODA if giver is ACID else COPPER)
    pour(simulation, 0.5, 20)
    middle = simulation.state()
    ends = []
    for _ in range(2):
        for _ in range(10):
            simulation.step(simulation.command)
        ends.append(simulation.state())
        simulation.restore(middle)
    assert (ends[0] == ends[1]).all()
    assert (simulation.state() == middle).all()


def test_another_simulation_goes_on_from_the_state_with_the_gas_that_has_left() -> None:
    first, other = bench(ACID, SODA), bench(ACID, SODA)
    pour(first, 0.9, 30)
    mix(first, 20.0)
    other.restore(first.state())
    here, there = world(first).solution(TAKER), world(other).solution(TAKER)
    assert here == there


def test_water_evaporates_and_what_was_dissolved_in_it_stays() -> None:
    simulation = bench(COPPER, BARIUM)
    liquid, handling = liquid_of(simulation), simulation.apparatus.liquid
    assert handling is not None
    before, weight = everything(simulation), liquid.solute_masses(liquid.what)
    heat = handling.evaporate(GIVER.name, 20)
    assert heat == pytest.approx(20 * liquid.volume * 998.0 * 4182.0 * 293.15, rel=0.01)
    after, water = everything(simulation), 20 * liquid.volume * WATER_PER_VOLUME
    assert {name: before[name] - after[name] for name in ("Cu", "S", "Cl", "charge")} == (
        pytest.approx(dict.fromkeys(("Cu", "S", "Cl", "charge"), 0.0), abs=1e-15)
    )
    assert before["O"] - after["O"] == pytest.approx(water, rel=1e-9)
    assert np.sum(liquid.solute_masses(liquid.what)) == pytest.approx(np.sum(weight), rel=1e-9)
    simulation.account = liquid.take_account()
    solution = world(simulation).solution(GIVER)
    assert solution is not None
    left = solution.volume / COPPER.volume
    assert solution.concentrations["SO4^2-(aq)"] == pytest.approx(100.0 / left, rel=0.02)
    handling.evaporate(GIVER.name, 10_000)
    assert liquid.take_account().inside[GIVER.name] == pytest.approx(liquid.volume)


def test_being_carried_stirs_nothing() -> None:
    simulation = bench(ACID, BASE)
    liquid = liquid_of(simulation)
    liquid.velocities[:] += (0.3, -0.2, 0.1)
    account = liquid.take_account()
    assert account.speeds.min() > 0.3
    assert liquid.stirring.max() < 0.01
    liquid.velocities[::2] -= (0.6, -0.4, 0.2)
    liquid.take_account()
    assert liquid.stirring.min() > 0.3


def test_a_state_has_why_something_was_left_unreacted() -> None:
    simulation = bench(ACID, BASE)
    solutions = liquid_of(simulation).solutions
    assert solutions is not None
    before = simulation.state()
    solutions.unreacted = said = ("no equilibrium was found", "Größe of a model's answer")
    after = simulation.state()
    simulation.restore(before)
    assert solutions.unreacted == ()
    simulation.restore(after)
    assert solutions.unreacted == said
    assert (simulation.state() == after).all()


def test_what_waits_in_a_wash_bottle_is_a_solution_too() -> None:
    bottle = WashBottle("bottle")
    held = {bottle: COPPER, TAKER: BARIUM}
    scene = compile_scene([bottle, TAKER], PANDA, LABORATORY, WIDE_VESSEL_VIEW, held, 200)
    simulation = Simulation(scene)
    simulation.reset({bottle: Placement(0.3, 0.12, 0.0), TAKER: Placement(0.3, -0.1, 0.0)})
    simulation.fill(np.random.default_rng(0))
    solution = world(simulation).solution(bottle)
    assert solution is not None
    assert solution.volume == pytest.approx(COPPER.volume, rel=0.01)
    assert solution.concentrations["Cu^2+(aq)"] == pytest.approx(100.0, rel=0.01)


@pytest.mark.parametrize("share", [0.5, 0.3, 0.7, 1 / 3, 0.9])
def test_copper_and_iodide_come_to_an_end_whatever_their_ratio(share: float) -> None:
    """2 Cu^2+ + 4 I^- -> 2 CuI + I2: at some ratio one of them is gone but for rounding."""
    parts = (Solute("copper(II) sulfate", 0.1),), (Solute("potassium iodide", 0.1),)
    inventory = Inventory.of(parts)
    copper, iodide = (inventory.filled(one, 1e-6) for one in parts)
    after, why = inventory.settled(share * copper + (1.0 - share) * iodide, 1e-6, 293.15)
    assert why == ""
    mol = inventory.amounts(after)
    iodine = sum(mol.get(key, 0.0) for key in ("I2(aq)", "I2(s)", "I3^-(aq)"))
    assert iodine == pytest.approx(1e-4 * min(share / 2.0, (1.0 - share) / 4.0), rel=0.01)
    assert mol["CuI(s)"] == pytest.approx(2.0 * iodine, rel=0.01)


def test_its_numbers_have_every_species() -> None:
    simulation = bench(BARIUM, COPPER)
    bring(simulation, GIVER.name, TAKER.name, 40.0)
    here = world(simulation).solution(TAKER)
    assert here is not None
    assert here.numbers["molar_Cu^2+(aq)"] == pytest.approx(0.06, rel=0.05)
    assert (
        here.numbers["mol_BaSO4(s)"] == here.numbers["mol_solid"] == pytest.approx(4e-3, rel=0.02)
    )


def test_what_is_in_no_vessel_keeps_what_it_holds() -> None:
    simulation = bench(ACID, BASE)
    liquid = liquid_of(simulation)
    liquid.accounted[:] = -1
    before = liquid.what.contents.copy()
    mix(simulation, 10.0)
    assert (liquid.what.contents == before).all()


def test_what_is_calm_is_not_touched() -> None:
    simulation = bench(ACID, BASE)
    liquid = liquid_of(simulation)
    before = liquid.what.contents.copy()
    for _ in range(3):
        simulation.step(simulation.command)
    assert (liquid.what.contents == before).all()
    assert (liquid.temperatures == 293.15).all()


def test_an_inventory_has_every_species_that_mixtures_of_its_solutions_become() -> None:
    fillings = [
        (Solute("potassium permanganate", 0.01),),
        (Solute("iron(II) sulfate", 0.05), Solute("sulfuric acid", 0.5)),
    ]
    inventory = Inventory.of(fillings)
    for share in (0.1, 0.5, 0.9, 0.99):
        held = zip(fillings, (share, 1.0 - share), strict=True)
        row = sum((inventory.filled(f, 1e-4 * part) for f, part in held), start=0.0)
        after, why = inventory.settled(np.asarray(row), 1e-4, 293.15)
        assert not why
        assert inventory.amounts(after)["Fe^3+(aq)"] > 0.0


def test_a_green_salt_makes_an_acid_look_neutral_and_no_meter_is_deceived() -> None:
    """Attack on `level2/neutralise`: another dye instead of the base."""
    yellow = Solute("bromothymol blue", 1.2e-4)
    acid = Filling(50.0, dissolved=(Solute("hydrochloric acid", 0.1), yellow))
    simulation = bench(Filling(50.0, dissolved=(Solute("nickel(II) chloride", 1.0),)), acid)
    assert not colour_turned(TAKER, to="green").holds(world(simulation))
    bring(simulation, GIVER.name, TAKER.name, 45.0)
    assert colour_turned(TAKER, to="green").holds(world(simulation))
    assert not ph_between(TAKER, low=5.8, high=7.0).holds(world(simulation))
