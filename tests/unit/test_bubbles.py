"""Bubbles and foam show that gas leaves a solution, as much as does, and nothing feels them."""

import numpy as np
import pytest

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.sim.bubbles import Bubbles
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from solution_bench import ACID, BARIUM, BASE, COPPER, SODA, TAKER, bench, mix, pour, world

STRONG = Filling(50.0, dissolved=(Solute("hydrochloric acid", 1.0),))


def foaming() -> Simulation:
    simulation = bench(STRONG, SODA)
    pour(simulation, 0.5, 30)
    return simulation


def shown(simulation: Simulation) -> dict[str, float]:
    """Return the opacity of every bubble in the taker, those of the foam last."""
    simulation.apparatus.show()
    model = simulation.scene.model
    names = [model.geom(number).name for number in range(model.ngeom)]
    return {
        name: float(model.geom(name).rgba[3])
        for name in names
        if name.startswith(f"{TAKER.name}_bubbles")
    }


def bubbles(simulation: Simulation) -> Bubbles:
    process = simulation.apparatus.processes[f"{TAKER.name}_bubbles"]
    assert isinstance(process, Bubbles)
    return process


def test_an_acid_on_soda_bubbles_and_foams_and_then_stops():
    simulation = bench(STRONG, SODA)
    assert not any(shown(simulation).values())
    pour(simulation, 0.5, 30)
    assert sum(opacity > 0.0 for opacity in shown(simulation).values()) > 20
    mix(simulation, 60.0)
    for _ in range(300):
        simulation.step(simulation.command)
    assert not any(shown(simulation).values())


def test_what_bubbles_is_the_gas_that_leaves():
    simulation = bench(STRONG, SODA)
    process, gas = bubbles(simulation), 0.0

    def add() -> None:
        nonlocal gas
        gas += simulation.apparatus.memory(process)[1] * simulation.apparatus.period

    pour(simulation, 0.5, 30, add)
    mix(simulation, 60.0)
    for _ in range(60):
        simulation.step(simulation.command)
        add()
    solution = world(simulation).solution(TAKER)
    assert gas > 1e-3
    assert gas == pytest.approx(sum(solution.gas.values()), rel=0.01)


@pytest.mark.parametrize(("giver", "taker"), [(ACID, BASE), (COPPER, BARIUM)])
def test_where_no_gas_can_form_there_is_nothing_to_see(giver, taker):
    assert not any("bubbles" in name for name in bench(giver, taker).apparatus.processes)


def test_soda_that_lies_in_an_acid_as_crystals_bubbles_too():
    chalk = Filling(50.0, crystals=(Crystals("calcium carbonate", 0.5),))
    assert any("bubbles" in name for name in bench(STRONG, chalk).apparatus.processes)


def test_they_are_within_the_glass_and_only_foam_lies_on_the_liquid():
    simulation = foaming()
    opacities, data = shown(simulation), simulation.data
    base, profile = data.body(TAKER.name).xpos, TAKER.profile
    level = profile.fill_height(world(simulation).solution(TAKER).volume)
    seen = [data.geom(name).xpos - base for name, opacity in opacities.items() if opacity > 0.0]
    assert all(profile.bottom < place[2] < profile.height for place in seen)
    assert all(np.hypot(*place[:2]) < profile.inner_radius(place[2]) for place in seen)
    rising = len([place for place in seen if place[2] < level])
    assert 20 < rising < len(seen)


@pytest.mark.slow
def test_a_picture_shows_them_and_neither_depth_nor_segments_do():
    simulation = foaming()
    renderer = ClassicRenderer(
        simulation.scene.model, 96, 96, (simulation.scene.liquid,), simulation.apparatus
    )
    simulation.draw_liquid()
    draws = renderer.color, renderer.depth, renderer.segmentation
    bubbling = [draw(simulation.data, "front") for draw in draws]
    simulation.apparatus.memory(bubbles(simulation))[1:] = 0.0
    calm = [draw(simulation.data, "front") for draw in draws]
    renderer.close()
    assert (np.abs(bubbling[0].astype(int) - calm[0]).max(axis=2) > 8).sum() > 10
    # Another number of transparent things is sorted otherwise: some edges of glass change.
    assert (np.abs(bubbling[1] - calm[1]) < 1e-3).mean() > 0.999
    assert (bubbling[2] == calm[2]).mean() > 0.999
