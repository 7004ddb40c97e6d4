"""Steam stands over hot water, the denser the more of it leaves, and is only seen."""

import numpy as np
import pytest

from heat_bench import warm_up
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.instruments.heater import Heater
from labutopia_lerobot.layout import Placement
from labutopia_lerobot.processes import HeatExchange
from labutopia_lerobot.robots import PANDA
from labutopia_lerobot.scenes import LABORATORY
from labutopia_lerobot.scenes.views import DOOR_VIEW, CameraPose, View
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.scene import compile_scene
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling

HEATER, BEAKER = Heater("heater"), glassware("beaker", "150 ml")
NEAR = View(
    front=CameraPose((0.55, 0.75, 1.1), (-0.42, -0.9, -0.22), (0.0, 0.0, 1.0), 32.0),
    top=DOOR_VIEW.top,
)


def water(celsius: float | None, particles: int = 200) -> Simulation:
    """Return a beaker of water on a hot plate."""
    held = {BEAKER: Filling(100.0, celsius=celsius)}
    scene = compile_scene([HEATER, BEAKER], PANDA, LABORATORY, NEAR, held, particles)
    simulation, top = Simulation(scene), HEATER.top_height + 0.0005
    simulation.reset(
        {HEATER: Placement(0.2, 0.0, 0.0), BEAKER: Placement(0.2, 0.0, 0.0, height=top)}
    )
    simulation.fill(np.random.default_rng(0))
    warm_up(simulation, 1.0)
    return simulation


def boiling() -> Simulation:
    simulation = water(99.9)
    simulation.apparatus.memory(HEATER.switch)[0] = 1.0
    warm_up(simulation, 400.0)
    return simulation


def vapour(simulation: Simulation) -> float:
    """Return the power that leaves the beaker with vapour [W]."""
    exchange = simulation.apparatus.processes["surface_at_hand"]
    assert isinstance(exchange, HeatExchange)
    (glass,) = (mass for mass in exchange.masses if mass.wall is not None)
    return exchange.vapour(simulation.apparatus, glass)


def densest(simulation: Simulation) -> float:
    """Return the opacity of its densest puff."""
    simulation.apparatus.show()
    model = simulation.scene.model
    puffs = [model.geom(n).name for n in range(model.ngeom) if "_steam_" in model.geom(n).name]
    return max(float(model.geom(puff).rgba[3]) for puff in puffs)


@pytest.mark.slow
def test_cold_water_has_none_and_hot_water_the_more_the_hotter():
    cold, warm, hot, boils = (
        densest(s) for s in (water(None), water(60.0), water(80.0), boiling())
    )
    assert cold == 0.0
    assert 0.0 < warm < hot < boils


@pytest.mark.slow
def test_what_boils_away_is_what_the_plate_gives_and_the_glass_does_not_lose():
    simulation = boiling()
    exchange = simulation.apparatus.processes["surface_at_hand"]
    before = simulation.apparatus.memory(exchange)[:2].copy()
    power = vapour(simulation)
    warm_up(simulation, 10.0)
    _, lost = (simulation.apparatus.memory(exchange)[:2] - before) / 10.0
    masses = [mass for mass in exchange.masses if mass.body in (BEAKER.name, HEATER.name)]
    room = simulation.apparatus.ambient
    dry = sum(
        mass.loss(simulation.apparatus) * (mass.temperature(simulation.apparatus) - room)
        for mass in masses
    )
    assert power == pytest.approx(lost - dry, rel=0.05)


@pytest.mark.slow
def test_it_is_seen_over_the_mouth_and_neither_depth_nor_segments_show_it():
    simulation = boiling()
    renderer = ClassicRenderer(
        simulation.scene.model, 96, 96, (simulation.scene.liquid,), simulation.apparatus
    )
    simulation.draw_liquid()
    draws = renderer.color, renderer.depth, renderer.segmentation
    steaming = [draw(simulation.data, "front") for draw in draws]
    simulation.apparatus.liquid.warm_to(simulation.apparatus.ambient)
    cold = [draw(simulation.data, "front") for draw in draws]
    renderer.close()
    changed = np.abs(steaming[0].astype(int) - cold[0]).max(axis=2) > 8
    assert changed[:45].sum() > 60
    assert (steaming[1] == cold[1]).all()
    assert (steaming[2] == cold[2]).all()
