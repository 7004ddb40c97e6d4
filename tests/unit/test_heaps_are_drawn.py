"""Crystals on a bottom are drawn as a heap, which a camera sees shrink as they dissolve."""

import numpy as np
import pytest

from labutopia_lerobot.chemistry.crystals import Crystals
from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.liquids.drawing.heap import Heap, heap_colors, heap_surface
from labutopia_lerobot.liquids.drawing.surface import VesselPose
from labutopia_lerobot.liquids.looks import heaps, looks
from labutopia_lerobot.sim.classic_renderer import ClassicRenderer
from labutopia_lerobot.sim.simulation import Simulation
from labutopia_lerobot.substances.filling import Filling
from solution_bench import bench, liquid_of, mix

WATER = Filling(60.0)
BEAKER = glassware("beaker", "250 ml")
HERE = np.array([0.3, 0.1, 0.8])
STANDING = VesselPose(BEAKER.profile, HERE, np.eye(3))


def with_crystals(of: str, grams: float, grain_mm: float = 0.5) -> Simulation:
    """Return two beakers of water, with crystals in one."""
    return bench(WATER, Filling(60.0, crystals=(Crystals(of, grams, grain_mm),)))


def drawn(simulation: Simulation) -> list[Heap]:
    """Return the heaps of a bench; where its vessels are makes no difference."""
    liquid = liquid_of(simulation)
    return heaps(liquid, [VesselPose(one.profile, HERE, np.eye(3)) for one in liquid.vessels])


@pytest.mark.parametrize("ml", [0.05, 1.0, 60.0])
def test_it_lies_on_the_bottom_and_within_the_walls(ml: float) -> None:
    heap = Heap(STANDING, ml * 1e-6, np.array([0.1, 0.4, 0.8, 1.0]))
    surface = heap_surface(heap)
    there = surface.vertices_w - HERE
    assert there[:, 2].min() > BEAKER.profile.bottom
    assert np.hypot(there[:, 0], there[:, 1]).max() < BEAKER.profile.inner_radius(0.02)
    assert len(heap_colors(heap)) == len(surface.quads)


def test_eight_times_the_volume_is_twice_as_wide() -> None:
    small, large = (heap_surface(Heap(STANDING, v * 1e-6, np.ones(4))) for v in (0.1, 0.8))
    widths = [np.ptp(one.vertices_w[:, 0]) for one in (small, large)]
    assert widths[1] == pytest.approx(2 * widths[0], rel=0.02)


def test_two_grams_of_salt_are_a_millilitre_and_a_half() -> None:
    (heap,) = drawn(with_crystals("sodium chloride", 2.0))
    assert heap.volume == pytest.approx(2.0 / 2.17 / 0.6 * 1e-6, rel=0.02)


def test_water_above_a_heap_is_clear_and_there_is_none_where_all_has_dissolved() -> None:
    simulation = with_crystals("sodium chloride", 1.0)
    liquid, tints = liquid_of(simulation), np.ones((1, 4))
    assert looks(liquid, tints, heaped=True)[:, 3].max() < 0.5
    assert looks(liquid, tints)[:, 3].max() > 0.6
    liquid.stirring[:] = 0.05
    mix(simulation, 120.0)
    assert drawn(simulation) == []


def test_fine_grains_that_are_stirred_up_cloud_the_water_and_leave_the_heap() -> None:
    """Silver chloride does not dissolve meanwhile."""
    simulation = with_crystals("silver chloride", 1.0, grain_mm=0.02)
    liquid = liquid_of(simulation)
    (before,) = drawn(simulation)
    liquid.stirring[:] = 0.15
    mix(simulation, 5.0)
    (after,) = drawn(simulation)
    assert after.volume < 0.5 * before.volume
    there = liquid.accounted == 1
    assert np.median(looks(liquid, np.ones((1, 4)), heaped=True)[there, 3]) > 0.9


def test_a_camera_sees_blue_crystals_through_glass_and_water() -> None:
    simulation = with_crystals("copper(II) sulfate pentahydrate", 3.0)
    assert simulation.scene.liquid is not None
    renderer = ClassicRenderer(simulation.scene.model, 256, 256, [simulation.scene.liquid])
    blue = []
    for _ in range(2):
        simulation.draw_liquid()
        color = renderer.color(simulation.data, "top").astype(int)
        blue.append((color[..., 2] - color[..., 0] > 60).sum())
        liquid_of(simulation).what.contents[:] = 0.0
    renderer.close()
    assert blue[0] > 5
    assert blue[1] == 0
