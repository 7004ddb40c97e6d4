"""Things that stand in other things at the start."""

import numpy as np
import pytest

from adversary import begun
from labutopia_lerobot.labware.glass.glass_rod import DIAMETER, GlassRod
from labutopia_lerobot.labware.instruments import test_tube_rack as racks
from labutopia_lerobot.layout import ImpossibleStartError, Inside, OnBench, sample_layout

SOMEWHERE = OnBench(x=(0.2, 0.3), y=(0.2, 0.3))


def test_a_rod_stands_in_the_opening_of_its_rack_wherever_that_is():
    env = begun("level2/stir_glassrod")
    _, rack, rod = env.workcell.task.start
    for seed in range(10):
        env.reset(seed=seed)
        x, y, z = (
            env.workcell.world.pose(rack).inverse() @ env.workcell.world.pose(rod)
        ).position_w
        assert max(abs(x), abs(y)) < (racks.OPENING - DIAMETER) / 2
        assert z == pytest.approx(rack.middle[2], abs=1e-4)
        assert np.degrees(env.workcell.world.pose(rod).tilt) < 1.0


def test_a_place_off_the_middle_turns_with_the_holder():
    rack, rod = racks.TestTubeRack("rack"), GlassRod("rod")
    quarter = OnBench(x=(0.3, 0.3), y=(0.2, 0.2), yaw=(np.pi / 2, np.pi / 2))
    start = {rack: quarter, rod: Inside(rack, at=(0.05, 0.01, 0.02))}
    placement = sample_layout(start, np.random.default_rng(0))[rod]
    assert (placement.x, placement.y) == pytest.approx((0.29, 0.25))
    assert placement.height == 0.02


@pytest.mark.parametrize("holder_comes", ["later", "never"])
def test_a_thing_in_a_holder_that_is_not_there_yet_is_reported(holder_comes):
    rack, rod = racks.TestTubeRack("rack"), GlassRod("rod")
    start = {rod: Inside(rack, at=rack.middle)}
    if holder_comes == "later":
        start[rack] = SOMEWHERE
    with pytest.raises(ImpossibleStartError, match="'rack' holds something"):
        sample_layout(start, np.random.default_rng(0))
