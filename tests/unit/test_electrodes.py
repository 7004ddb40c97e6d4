"""pH electrodes: dashes in air, the pH around the tip in a solution, and a lag in between."""

import math

import numpy as np
import pytest

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.measuring.ph_meter import PhMeter
from labutopia_lerobot.labware.piece import Piece
from labutopia_lerobot.layout import Inside, OnBench, Start, sample_layout
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import WIDE_VESSEL_VIEW
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.sim.view import SimulatedWorld
from labutopia_lerobot.substances.filling import Filling

ACID = Filling(60.0, dissolved=(Solute("acetic acid", 0.1),))
BASE = Filling(60.0, dissolved=(Solute("sodium hydroxide", 0.1),))
BEAKER, OTHER = glassware("beaker", "150 ml", "beaker"), glassware("beaker", "150 ml", "other")


def dipped(filling: Filling, lowered: float = 0.113) -> Simulation:
    """Return a beaker below the electrode of a meter, and another one, of a base, beside it."""
    meter = PhMeter("meter", lowered=lowered)
    held: dict[Piece, Filling] = {BEAKER: filling, OTHER: BASE}
    pieces: list[Piece] = [meter, BEAKER, OTHER]
    scene = compile_scene(pieces, PANDA, LABORATORY, WIDE_VESSEL_VIEW, held, 800)
    simulation, there = Simulation(scene), OnBench((0.3, 0.3), (0.1, 0.1), (0.0, 0.0))
    aside = OnBench((0.0, 0.0), (-0.1, -0.1))
    below = Inside(meter, (0.060, -0.287, 0.0))
    start: dict[Piece, Start] = {meter: there, BEAKER: below, OTHER: aside}
    rng = np.random.default_rng(0)
    simulation.reset(sample_layout(start, rng), rng=rng)
    simulation.fill(rng)
    return simulation


def wait(simulation: Simulation, seconds: float) -> None:
    for _ in range(round(30 * seconds)):
        simulation.step(simulation.command)


def test_it_reads_the_ph_of_a_weak_acid() -> None:
    """Of acetic acid of c = 0.1 mol/l: x^2 / (c - x) = K = 10^-4.756 (CRC Handbook)."""
    simulation = dipped(ACID)
    k, c = 10**-4.756, 0.1
    computed = -math.log10((math.sqrt(k * k + 4 * k * c) - k) / 2)
    wait(simulation, 1.0)
    reading = SimulatedWorld(simulation).reading("meter_ph")
    assert reading.shown == pytest.approx(computed, abs=0.02)
    assert reading.settled
    assert reading.text == f"{reading.shown:.2f} pH"


def test_in_air_it_shows_dashes() -> None:
    simulation = dipped(ACID, lowered=0.05)
    wait(simulation, 0.5)
    reading = SimulatedWorld(simulation).reading("meter_ph")
    assert math.isnan(reading.shown)
    assert not reading.settled
    assert reading.text == "--.-- pH"


def test_after_three_time_constants_it_shows_95_percent_of_a_change() -> None:
    simulation = dipped(ACID)
    world, liquid = SimulatedWorld(simulation), simulation.liquid
    assert liquid is not None
    before = world.reading("meter_ph").value
    of_base = np.flatnonzero(liquid.origins == liquid.names.index("other"))[0]
    liquid.what.contents[:] = liquid.what.contents[of_base]
    after = 14.17 + math.log10(0.1)  # water of 20 degrees C (CRC Handbook)
    wait(simulation, 4.5)
    reading = world.reading("meter_ph")
    assert reading.value == pytest.approx(before + 0.95 * (after - before), abs=0.2)
    assert not reading.settled
    wait(simulation, 12.0)
    assert world.reading("meter_ph").value == pytest.approx(after, abs=0.05)
    assert world.reading("meter_ph").settled


def test_water_without_chemistry_has_no_reading() -> None:
    meter = PhMeter("meter", lowered=0.110)
    held: dict[Piece, Filling] = {BEAKER: Filling(60.0)}
    scene = compile_scene([meter, BEAKER], PANDA, LABORATORY, WIDE_VESSEL_VIEW, held, 100)
    simulation = Simulation(scene)
    simulation.step(simulation.command)
    assert math.isnan(SimulatedWorld(simulation).reading("meter_ph").value)
