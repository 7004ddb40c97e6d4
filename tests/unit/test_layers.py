"""What lies in layers in a vessel stays so until something stirs it."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from labutopia_lerobot.liquids.layers import Layers, exchange
from labutopia_lerobot.liquids.looks import looks
from labutopia_lerobot.liquids.mixing import exchanged_between_layers, mixed_share
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import CONTROL_HZ
from solution_bench import COPPER, TAKER, bench, liquid_of, world

COPPER_ION = "Cu^2+(aq)"


def layered(particles: int = 200) -> Simulation:
    """Return a beaker of copper sulfate whose upper half is water."""
    simulation = bench(Filling(60.0), COPPER, particles)
    liquid = liquid_of(simulation)
    held = liquid.accounted == liquid.names.index(TAKER.name)
    water = liquid.what.contents[~held][0]
    upper = held & (liquid.positions[:, 2] > np.median(liquid.positions[held, 2]))
    liquid.what.contents[upper] = water
    liquid.weigh()
    return simulation


def copper(simulation: Simulation, *, upper: bool) -> float:
    """Return what a particle of the upper or lower quarter holds, by the mean of all."""
    liquid = liquid_of(simulation)
    assert liquid.solutions is not None
    held = liquid.accounted == liquid.names.index(TAKER.name)
    heights = liquid.positions[held, 2]
    amounts = liquid.what.contents[held, liquid.solutions.inventory.species.index(COPPER_ION)]
    low, high = np.quantile(heights, [0.25, 0.75])
    return float(amounts[heights > high if upper else heights < low].mean() / amounts.mean())


def wait(simulation: Simulation, seconds: float, stirred: float = 0.0) -> None:
    """Let time pass; stirred means a vortex so fast [rad/s]."""
    handling = simulation.apparatus.liquid
    assert handling is not None
    middle = simulation.data.body(TAKER.name).xpos + np.array([0.0, 0.0, 0.01])
    for _ in range(round(seconds * CONTROL_HZ)):
        if stirred:
            handling.stir(middle, stirred, 0.02, 1.0 / CONTROL_HZ)
        simulation.step(simulation.command)


def contrast(simulation: Simulation) -> float:
    """Return by how much the lower half is drawn in another colour than the upper one, 0 to 1."""
    liquid = liquid_of(simulation)
    held = liquid.accounted == liquid.names.index(TAKER.name)
    drawn, heights = looks(liquid, np.ones((1, 4)))[held], liquid.positions[held, 2]
    upper = heights > np.median(heights)
    return float(np.abs(drawn[upper].mean(axis=0) - drawn[~upper].mean(axis=0)).max())


def test_a_layer_at_rest_is_seen_for_seconds_and_is_gone_when_stirred() -> None:
    simulation = layered()
    wait(simulation, 2.0)
    assert copper(simulation, upper=True) < 0.4
    assert copper(simulation, upper=False) > 1.6
    assert contrast(simulation) > 0.2
    wait(simulation, 3.0, stirred=20.0)
    assert copper(simulation, upper=True) > 0.9
    assert contrast(simulation) < 0.05
    solution = world(simulation).solution(TAKER)
    assert solution is not None
    assert solution.mixed > 0.95


def test_a_mode_of_diffusion_decays_as_its_equation_has_it() -> None:
    """The slowest one between closed ends: cos(pi z / H) falls off as exp(-D (pi / H)^2 t)."""
    layers, reach, steps = 8, 0.05, 200
    wave = np.cos(math.pi * (np.arange(layers) + 0.5) / layers)
    means = 1.0 + wave[:, None]
    for _ in range(steps):
        means = exchange(means, np.full(layers, 100), reach)
    decay = math.exp(-reach * (math.pi / layers) ** 2 * steps)
    assert means[:, 0] - 1.0 == pytest.approx(decay * wave, rel=0.03)


@given(
    st.lists(st.integers(1, 300), min_size=2, max_size=8), st.floats(0.0, 1e6), st.integers(0, 9)
)
def test_nothing_is_lost_between_layers_and_nothing_becomes_negative(
    counts: list[int], reach: float, seed: int
) -> None:
    means = np.random.default_rng(seed).uniform(0.0, 1e-6, (len(counts), 3))
    means[::2, 1] = 0.0
    number = np.array(counts)
    after = exchange(means, number, reach)
    assert number @ after == pytest.approx(number @ means, rel=1e-12)
    assert (after >= 0.0).all()
    assert after.max() <= means.max() * (1.0 + 1e-12)


def test_faster_liquid_exchanges_more_between_layers() -> None:
    """Eddies of speed u over l = 5 mm: D = u l; at rest a beaker of 35 mm takes 12 s."""
    height, layer = 0.035, 0.005
    times = []
    for speed in (0.0, 0.05, 0.2):
        passed = mixed_share(speed, 1e-3) / 1e-3 * exchanged_between_layers(speed, layer)
        times.append(height**2 / (math.pi**2 * passed * layer**2))
    assert times[0] == pytest.approx(12.4, rel=0.1)
    assert times[1] == pytest.approx(height**2 / math.pi**2 / (5e-3 * 0.046), rel=0.1)
    assert times[0] > times[1] > times[2]


def test_layers_are_by_height_and_what_falls_in_is_in_the_top_one() -> None:
    heights = np.array([0.0, 0.02, 0.001, 0.021, 0.1])
    layers = Layers.by_height(heights, 0.005)
    assert layers.of.tolist() == [0, 1, 0, 1, 1]
    assert layers.counts.tolist() == [2, 3]
    assert layers.height == 0.005
    assert layers.means(heights[:, None])[:, 0] == pytest.approx([0.0005, 0.047])


def test_reactions_go_on_almost_four_times_in_a_second() -> None:
    simulation = layered(100)
    liquid, changed = liquid_of(simulation), 0
    for _ in range(2 * CONTROL_HZ):
        before = liquid.what.contents.copy()
        simulation.step(simulation.command)
        changed += int((before != liquid.what.contents).any())
    assert changed == 2 * CONTROL_HZ // 8


def test_layers_go_on_bit_for_bit_from_a_state() -> None:
    simulation = layered(100)
    wait(simulation, 0.5)
    middle, ends = simulation.state(), []
    for _ in range(2):
        wait(simulation, 0.5)
        ends.append(simulation.state())
        simulation.restore(middle)
    assert (ends[0] == ends[1]).all()
