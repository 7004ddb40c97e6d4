"""What leaves a spout or a tip ends at glass or a bench before it, however near that is."""

import numpy as np
import pytest

from labutopia_lerobot.labware.glass.catalogue import glassware
from labutopia_lerobot.labware.soft.wash_bottle import WashBottle
from labutopia_lerobot.liquids.handling import Handling
from labutopia_lerobot.liquids.liquid import Liquid
from labutopia_lerobot.substances.filling import Filling
from labutopia_lerobot.world import Pose
from liquid_experiments import world

BEAKER, BOTTLE = glassware("beaker", "250 ml", "beaker"), WashBottle("bottle")
HALF_WAY = 0.05
SIDE = BEAKER.profile.outer_radius(HALF_WAY)
ALONG_X = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
DOWN = np.diag([1.0, -1.0, -1.0])
SETTLES = 60


def squeezed(spout: Pose, ml: float = 2.0) -> Liquid:
    """Squeeze so much out of a bottle in a control step, faster than the spout lets through."""
    model, data = world(BEAKER)
    liquid = Liquid(model, data, [BEAKER, BOTTLE], [Filling(20.0)], 1000)
    liquid.fill({BOTTLE: Filling(20.0)}, np.random.default_rng(0))
    liquid.dispense(BOTTLE, ml * 1e-6, spout, 1 / 30)
    assert len(liquid.positions) > 5
    return liquid


def inside(liquid: Liquid) -> list[int]:
    """How many particles are in the beaker, at once and once they have come to rest."""
    before = int((liquid.inside() == 0).sum())
    for _ in range(SETTLES):
        liquid.step()
    assert not liquid.diverged
    return [before, int((liquid.inside() == 0).sum())]


@pytest.mark.parametrize("gap", [0.04, 0.01, 0.002, 0.0, -0.0003])
def test_a_bottle_that_is_squeezed_at_a_wall_fills_nothing(gap: float) -> None:
    beside = np.array([-SIDE - gap, 0.0, HALF_WAY])
    assert inside(squeezed(Pose(beside, ALONG_X))) == [0, 0]


@pytest.mark.parametrize("gap", [0.04, 0.01, 0.002, 0.0, -0.0003])
def test_a_bottle_that_is_squeezed_onto_a_bottom_loses_nothing(gap: float) -> None:
    over = np.array([0.003, 0.002, BEAKER.profile.bottom + gap])
    liquid = squeezed(Pose(over, DOWN))
    assert inside(liquid) == [len(liquid.positions)] * 2


@pytest.mark.parametrize("gap", [0.012, 0.003, 0.0, -0.0003])
def test_a_tip_near_a_bottom_gives_all_into_the_vessel(gap: float) -> None:
    liquid = squeezed(Pose(np.array([0.003, 0.002, HALF_WAY]), DOWN))
    count = len(liquid.positions)
    tip = Pose(np.array([0.003, 0.002, BEAKER.profile.bottom + gap]), DOWN)
    assert Handling(liquid).let_out("beaker", tip.position_w, count, tip, 1.0) == count
    assert inside(liquid) == [count, count]


@pytest.mark.parametrize("height", [0.05, 0.02, 0.005, 0.0, -0.0003])
def test_a_bottle_that_is_squeezed_at_the_bench_makes_a_puddle(height: float) -> None:
    liquid = squeezed(Pose(np.array([-SIDE - 0.05, 0.0, height]), DOWN))
    highest = max(height, 0.0) + 0.002
    for _ in range(SETTLES):
        assert liquid.positions[:, 2].max() < highest + 0.001
        assert liquid.positions[:, 2].min() > -0.001
        liquid.step()
    assert liquid.positions[:, 2].max() < liquid.spacing


def test_a_stream_that_meets_nothing_goes_as_far_as_it_is_fast() -> None:
    away = np.array([-SIDE - 0.01, 0.0, HALF_WAY])
    liquid = squeezed(Pose(away, -ALONG_X @ np.diag([1.0, -1.0, 1.0])))
    speed, far = -liquid.velocities[0, 0], away[0] - liquid.positions[:, 0]
    assert speed > 1.0
    assert far.max() == pytest.approx(speed / 30, rel=0.1)
    assert np.diff(np.sort(far)) == pytest.approx(speed / 30 / len(far))
