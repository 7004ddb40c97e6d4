"""Two beakers of solutions, and pouring without a robot: what the tests of solutions share."""

from collections.abc import Callable

import numpy as np

from labutopia_lerobot.chemistry.formula import parse
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.chemistry.kept_answers import KeptAnswers
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.liquids.portion import Portion
from labutopia_lerobot.liquids.temperature import capacities
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import FloatArray

GIVER, TAKER = glassware("beaker", "250 ml", "giver"), glassware("beaker", "250 ml", "taker")

ACID = Filling(50.0, dissolved=(Solute("hydrochloric acid", 0.1),))
BASE = Filling(50.0, dissolved=(Solute("sodium hydroxide", 0.1),))
COPPER = Filling(60.0, dissolved=(Solute("copper(II) sulfate", 0.1),))
BARIUM = Filling(40.0, dissolved=(Solute("barium chloride", 0.1),))
SODA = Filling(50.0, dissolved=(Solute("sodium carbonate", 0.1),))


def bench(
    giver: Filling, taker: Filling, particles: int = 200, answers: KeptAnswers | None = None
) -> Simulation:
    """Return two filled beakers, side by side; with `answers`, these decide what reacts."""
    held, view = {GIVER: giver, TAKER: taker}, WIDE_VESSEL_VIEW
    scene = compile_scene([GIVER, TAKER], PANDA, LABORATORY, view, held, particles, answers=answers)
    simulation = Simulation(scene)
    simulation.reset({GIVER: Placement(0.3, 0.12, 0.0), TAKER: Placement(0.3, -0.1, 0.0)})
    simulation.fill(np.random.default_rng(0))
    return simulation


def liquid_of(simulation: Simulation) -> Liquid:
    """Return the liquid of a bench."""
    assert simulation.liquid is not None
    return simulation.liquid


def pour(
    simulation: Simulation,
    share: float,
    steps: int,
    each: Callable[[], None] = lambda: None,
) -> None:
    """Let a share of what the giver holds fall into the taker, some at each step, and wait."""
    liquid, rng = liquid_of(simulation), np.random.default_rng(1)
    flowing = np.flatnonzero(liquid.origins == 0)
    flowing = flowing[: round(share * len(flowing))]
    for step in range(steps):
        now = flowing[4 * step : 4 * step + 4]
        above = simulation.data.body(TAKER.name).xpos + np.array([0.0, 0.0, 0.12])
        liquid.positions[now] = above + rng.uniform(-0.008, 0.008, (len(now), 3))
        liquid.velocities[now] = (0.0, 0.0, -0.5)
        simulation.step(simulation.command)
        each()


def mix(simulation: Simulation, seconds: float) -> None:
    """Let what the vessels hold mix and react for a time, without stepping anything else."""
    handling = simulation.apparatus.liquid
    assert handling is not None
    for _ in range(round(seconds)):
        handling.react(1.0)


def swirl(simulation: Simulation) -> None:
    """Let what the vessels hold mix as if they were swirled, until no layers are left."""
    handling = simulation.apparatus.liquid
    assert handling is not None
    liquid_of(simulation).stirring[:] = 0.03  # too slow to stir up what has settled
    for _ in range(120):
        handling.react(5.0)


def world(simulation: Simulation) -> SimulatedWorld:
    """Return the view of a bench."""
    return SimulatedWorld(simulation)


def energy(simulation: Simulation) -> float:
    """Return the heat in the liquid and the enthalpy of all species, gas that left with it [J]."""
    liquid = liquid_of(simulation)
    assert liquid.solutions is not None
    what, enthalpies = liquid.what, liquid.solutions.inventory.enthalpies
    heat = capacities(what.amounts, liquid.substances, liquid.volume) @ what.temperatures
    formed = (what.contents.sum(axis=0) + liquid.solutions.given_off.sum(axis=0)) @ enthalpies
    return float(heat + formed)


def bring(simulation: Simulation, origin: str, into: str | None, ml: float) -> None:
    """Put some of what a vessel holds into another one, or away, and swirl it.

    Args:
        simulation: What it is in.
        origin: The vessel it is taken from; a burette too.
        into: The vessel it is put into; None for away.
        ml: How much, at most.
    """
    liquid, handling = liquid_of(simulation), simulation.apparatus.liquid
    assert handling is not None
    holder, count = liquid.names.index(origin), round(1e-6 * ml / liquid.volume)
    if liquid.kept.count(holder):
        portion = liquid.kept.take(holder, count, last=False)
    else:
        portion = liquid.take(np.flatnonzero(liquid.origins == holder)[:count])
    if into is not None:
        put(simulation, portion, into)
    simulation.account = liquid.take_account()
    swirl(simulation)


def put(simulation: Simulation, portion: Portion, into: str) -> None:
    """Put liquid that has been taken from somewhere into a vessel."""
    grid = np.arange(len(portion.origins))
    places = np.column_stack([grid % 5 - 2, grid // 5 % 5 - 2, 10 + grid // 25 / 2])
    positions = simulation.data.body(into).xpos + 0.004 * places
    liquid_of(simulation).add(positions, np.zeros_like(positions), portion)


def atoms(species: tuple[str, ...], amounts: FloatArray) -> dict[str, float]:
    """Return how much of every element there is, the charge and the mass [mol, kg]."""
    totals: dict[str, float] = {"charge": 0.0, "mass": 0.0}
    for key, mol in zip(species, amounts.tolist(), strict=True):
        formula = parse(key[: key.rindex("(")])
        totals["charge"] += mol * formula.charge
        totals["mass"] += mol * formula.molar_mass
        for element, n in formula.atoms.items():
            totals[element] = totals.get(element, 0.0) + n * mol
    return totals
