"""What has precipitated is seen as a cloud, and then as a layer on the bottom."""

import numpy as np
import pytest

from labutopia_lerobot.chemistry.inventory import Solute
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.drawing.sediment import Sediment, sediment_surface
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.liquids.looks import looks, sediments
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from solution_bench import TAKER, bench, liquid_of, mix, put

BEAKER = glassware("beaker", "250 ml")
HERE = np.array([0.3, 0.1, 0.8])
STANDING = VesselPose(BEAKER.profile, HERE, np.eye(3))
SALT = Filling(60.0, dissolved=(Solute("sodium chloride", 0.1),))


def mixed(silver: float) -> Simulation:
    """Return a bench with so much silver nitrate [mol/l] poured into salt water, just mixed."""
    simulation = bench(Filling(20.0, dissolved=(Solute("silver nitrate", silver),)), SALT)
    liquid = liquid_of(simulation)
    put(simulation, liquid.take(np.flatnonzero(liquid.origins == 0)), TAKER.name)
    simulation.account = liquid.take_account()
    liquid.stirring[:] = 0.05
    mix(simulation, 8.0)
    liquid.stirring[:] = 0.0
    return simulation


def drawn(simulation: Simulation) -> list[Sediment]:
    """Return the sediments of a bench; where its vessels are makes no difference."""
    liquid = liquid_of(simulation)
    return sediments(liquid, [VesselPose(one.profile, HERE, np.eye(3)) for one in liquid.vessels])


def test_it_covers_the_bottom_within_the_walls() -> None:
    there = sediment_surface(Sediment(STANDING, np.ones(4))).vertices_w - HERE
    assert there[:, 2] == pytest.approx(BEAKER.profile.bottom + 1e-3, abs=1e-4)
    wide = BEAKER.profile.inner_radius(BEAKER.profile.bottom + 1e-3)
    assert 0.9 * wide < np.hypot(there[:, 0], there[:, 1]).max() < wide


def test_a_cloud_hides_the_bottom_and_what_has_settled_is_seen_through_clear_liquid() -> None:
    simulation = mixed(0.1)
    liquid, tints = liquid_of(simulation), np.ones((1, 4))
    (fresh,) = drawn(simulation)
    assert fresh.color[3] < 0.1
    mix(simulation, 600.0)
    (settled,) = drawn(simulation)
    assert settled.color[3] > 0.8
    assert settled.color[:3].min() > 0.8  # white
    held = np.flatnonzero(liquid.accounted == 1)
    top = held[np.argsort(liquid.positions[held, 2])[len(held) // 2 :]]
    assert np.median(looks(liquid, tints, heaped=True)[top, 3]) < 0.5


def test_little_hides_little() -> None:
    much, little = mixed(0.1), mixed(0.0005)
    for simulation in (much, little):
        mix(simulation, 600.0)
    assert drawn(little)[0].color[3] < 0.5 * drawn(much)[0].color[3]


def test_where_nothing_has_precipitated_there_is_none() -> None:
    assert drawn(bench(SALT, SALT)) == []


def test_a_camera_sees_it() -> None:
    simulation = mixed(0.1)
    assert simulation.scene.liquid is not None
    mix(simulation, 600.0)
    renderer = ClassicRenderer(simulation.scene.model, 256, 256, [simulation.scene.liquid])
    white = []
    for _ in range(2):
        simulation.draw_liquid()
        white.append((renderer.color(simulation.data, "top").min(axis=-1) > 220).sum())
        liquid_of(simulation).what.contents[:] = 0.0
    renderer.close()
    assert white[0] > white[1] + 100
